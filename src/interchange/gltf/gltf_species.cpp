#include "interchange/gltf/gltf_species.h"

#include "core/bounds.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace sward::interchange {
namespace {

using nlohmann::ordered_json;

// Largest difference between two levels of detail that is allowed on the screen [pixels].
constexpr float levelError = 0.25f;

std::size_t addBladeMesh(GltfDocument& document, const BladeMesh& mesh, const std::string& name,
                         std::size_t material, const ordered_json& extras = nullptr)
{
    Aabb bounds;
    for (const glm::vec3& position : mesh.positions)
        bounds.add(position);
    const GltfAccessor vec3{.type = "VEC3"};
    const ordered_json attributes = {
        {"POSITION", document.addArray(std::span(mesh.positions),
                                       {.type = "VEC3", .bounds = bounds}, gltfVertices)},
        {"NORMAL", document.addArray(std::span(mesh.normals), vec3, gltfVertices)},
        {"TEXCOORD_0", document.addArray(std::span(mesh.uvs), {.type = "VEC2"}, gltfVertices)},
        {"COLOR_0", document.addArray(std::span(mesh.colors), vec3, gltfVertices)}};
    const std::size_t indices =
        document.addArray(std::span(mesh.indices), {.componentType = 5125}, gltfIndices);
    ordered_json entry = {{"name", name},
                          {"primitives", ordered_json::array({{{"attributes", attributes},
                                                               {"indices", indices},
                                                               {"material", material}}})}};
    if (!extras.is_null())
        entry["extras"] = extras;
    return document.add("meshes", std::move(entry));
}

std::size_t addMaterial(GltfDocument& document, const field::Species& species,
                        const BladeMesh& mesh)
{
    const ordered_json pbr = {
        {"baseColorFactor", {mesh.baseColor.x, mesh.baseColor.y, mesh.baseColor.z, 1.0}},
        {"metallicFactor", 0.0},
        {"roughnessFactor", 1.0 - double(species.look.gloss)}};
    return document.add(
        "materials",
        {{"name", species.name}, {"pbrMetallicRoughness", pbr}, {"doubleSided", true}});
}

// How high a blade is drawn at most when its coarse mesh is as good as the full one [pixels].
ordered_json lodExtras(const BladeMesh& mesh, std::size_t coarse)
{
    const float chords = coarseSegments;
    const float error = 0.25f * mesh.largestBend / (chords * chords);
    return {{"lod", {{"mesh", coarse}, {"below_pixels", std::floor(levelError / error)}}}};
}

} // namespace

void addSpecies(GltfDocument& document, const field::FieldView& field,
                const std::vector<MeanBlade>& means, SpeciesLevels levels)
{
    const std::size_t count = field.species.size();
    const bool isFull = levels != SpeciesLevels::coarse;
    for (std::size_t s = 0; s < count; ++s) {
        const field::Species& species = field.species[s];
        const BladeMesh mesh = bladeMesh(species, *field.defaults, means[s],
                                         isFull ? BladeDetail::full : BladeDetail::coarse);
        const std::size_t material = addMaterial(document, species, mesh);
        addBladeMesh(document, mesh, species.name, material,
                     levels == SpeciesLevels::both ? lodExtras(mesh, count + s) : nullptr);
    }
    if (levels != SpeciesLevels::both)
        return;
    for (std::size_t s = 0; s < count; ++s)
        addBladeMesh(document,
                     bladeMesh(field.species[s], *field.defaults, means[s], BladeDetail::coarse),
                     fmt::format("{} coarse", field.species[s].name), s);
}

} // namespace sward::interchange
