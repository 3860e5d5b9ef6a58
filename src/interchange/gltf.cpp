#include "interchange/gltf.h"

#include "core/error.h"
#include "core/files/atomic_file.h"
#include "interchange/blade_groups.h"
#include "interchange/blade_mesh.h"
#include "interchange/engine/drawn_look.h"
#include "interchange/engine/engine_extras.h"
#include "interchange/gltf_document.h"
#include "interchange/gltf_ground.h"
#include "interchange/instance_attributes.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <limits>
#include <optional>
#include <utility>

namespace sward::interchange {
namespace {

using nlohmann::ordered_json;

constexpr const char* extension = "EXT_mesh_gpu_instancing";

// The container's header and two chunk headers.
constexpr std::uint64_t headerBytes = 12 + 2 * 8;

std::size_t addBladeMesh(GltfDocument& document, const BladeMesh& mesh, const std::string& name,
                         std::size_t material)
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
    return document.add("meshes",
                        {{"name", name},
                         {"primitives", ordered_json::array({{{"attributes", attributes},
                                                              {"indices", indices},
                                                              {"material", material}}})}});
}

// Mesh and material of species i have index i.
void addSpecies(GltfDocument& document, const field::FieldView& field,
                const std::vector<MeanBlade>& means)
{
    for (std::size_t s = 0; s < field.species.size(); ++s) {
        const field::Species& species = field.species[s];
        const BladeMesh mesh = bladeMesh(species, *field.defaults, means[s]);
        const ordered_json pbr = {
            {"baseColorFactor", {mesh.baseColor.x, mesh.baseColor.y, mesh.baseColor.z, 1.0}},
            {"metallicFactor", 0.0},
            {"roughnessFactor", 1.0 - double(species.look.gloss)}};
        const std::size_t material = document.add(
            "materials",
            {{"name", species.name}, {"pbrMetallicRoughness", pbr}, {"doubleSided", true}});
        addBladeMesh(document, mesh, species.name, material);
    }
}

// The instances of a group, by species. `looks` are null unless they are for engines.
std::vector<std::vector<Instance>> bySpecies(const field::FieldView& field, const BladeGroup& group,
                                             const std::string& source, const DrawnLooks* looks)
{
    std::vector<Instance> instances = instancesOf(field, group, source);
    if (looks != nullptr) {
        orderByRank(instances);
        for (Instance& instance : instances)
            instance.look = looks->of(instance.blade);
    }
    std::vector<std::vector<Instance>> result(field.species.size());
    for (const Instance& instance : instances)
        result[instance.blade.species].push_back(instance);
    return result;
}

// Adds the node for one species in one group; reserves its bytes.
std::size_t addInstances(GltfDocument& document, const BladeGroup& group, const std::string& name,
                         std::uint32_t species, std::span<const Instance> instances,
                         bool forEngines)
{
    Aabb places;
    for (const Instance& instance : instances)
        places.add(instance.place);
    ordered_json attributes;
    for (const InstanceAttribute& attribute : instanceAttributes(forEngines)) {
        GltfAccessor accessor{.componentType = attribute.componentType,
                              .type = attribute.type,
                              .count = instances.size(),
                              .normalized = attribute.normalized};
        accessor.view = document.reserveView(instances.size() * attribute.bytes);
        if (attributes.empty())
            accessor.bounds = places;
        attributes[attribute.name] = document.addAccessor(accessor);
    }
    return document.add("nodes", {{"name", name},
                                  {"mesh", species},
                                  {"translation", {group.place.x, group.place.y, group.place.z}},
                                  {"extensions", {{extension, {{"attributes", attributes}}}}}});
}

// Builds the JSON in a first pass over the blades.
void describe(GltfDocument& document, const field::FieldView& field,
              const std::vector<BladeGroup>& groups, const ExportSettings& settings,
              const DrawnLooks* looks, Progress& progress)
{
    const std::vector<MeanBlade> means = meanBlades(field);
    addSpecies(document, field, means);
    ordered_json children = ordered_json::array();
    if (settings.withGround)
        if (const std::optional<std::size_t> ground = addGround(document, *field.ground, looks))
            children.push_back(*ground);

    if (!groups.empty())
        document.require(extension);
    for (std::size_t g = 0; g < groups.size(); ++g) {
        const auto species = bySpecies(field, groups[g], settings.source, looks);
        for (std::uint32_t s = 0; s < species.size(); ++s)
            if (!species[s].empty())
                children.push_back(addInstances(
                    document, groups[g], fmt::format("group {} {}", g, field.species[s].name), s,
                    species[s], looks != nullptr));
        progress.advance(groups[g].bladeCount);
    }

    // Store the origin again in extras, in double precision.
    const ordered_json origin = {field.origin.x, field.origin.y, field.origin.z};
    ordered_json root = {{"name", "field"}, {"translation", origin}};
    if (!children.empty())
        root["children"] = std::move(children);
    root["extras"] = {{"origin_m", origin}, {"blades", field::rootedBlades(field)}};
    if (looks != nullptr)
        root["extras"]["sward"] = engineExtras(field, *looks, means);
    document.setScene(document.add("nodes", std::move(root)));
}

void writeWords(AtomicFile& file, std::initializer_list<std::uint32_t> words)
{
    file.write(std::as_bytes(std::span(words.begin(), words.size())));
}

} // namespace

void refuseLargeGlb(const std::filesystem::path& path, std::uint64_t blades, std::uint64_t bytes,
                    std::uint64_t perBlade)
{
    // Lengths in the file have 32 bits.
    constexpr std::uint64_t largest = std::numeric_limits<std::uint32_t>::max();
    if (bytes > largest)
        fail(ErrorKind::unsupported,
             "{}: {} blades need {} bytes, a .glb holds at most {} (some {} million blades); .ply "
             "and .usda have no such limit",
             path.string(), blades, bytes, largest, largest / perBlade / 1'000'000);
}

void writeGlb(const field::FieldView& field, const std::filesystem::path& path,
              const ExportSettings& settings, Progress& progress)
{
    // Check the size of the blades before any work.
    const std::uint64_t blades = field.blades.size();
    const std::uint64_t perBlade = settings.forEngines ? glbBytesPerEngineBlade : glbBytesPerBlade;
    refuseLargeGlb(path, blades, headerBytes + blades * perBlade, perBlade);

    progress.begin("export", 2 * blades);
    const std::vector<BladeGroup> groups = groupBlades(field);
    GltfDocument document(settings.generator, *field.copyright);
    const std::optional<DrawnLooks> looks =
        settings.forEngines ? std::optional<DrawnLooks>(field) : std::nullopt;
    const DrawnLooks* const drawn = looks ? &*looks : nullptr;
    describe(document, field, groups, settings, drawn, progress);
    const std::string text = document.text();
    const std::uint64_t bytes = headerBytes + text.size() + document.binaryBytes();
    refuseLargeGlb(path, blades, bytes, perBlade);

    const auto word = [](std::uint64_t value) { return static_cast<std::uint32_t>(value); };
    AtomicFile file(path, settings.overwrite);
    writeWords(file, {0x46546c67U /* glTF */, 2, word(bytes)});
    writeWords(file, {word(text.size()), 0x4e4f534aU /* JSON */});
    file.write(text);
    writeWords(file, {word(document.binaryBytes()), 0x004e4942U /* BIN */});
    file.write(document.fixedBytes());
    for (const BladeGroup& group : groups) {
        for (const std::vector<Instance>& instances :
             bySpecies(field, group, settings.source, drawn))
            file.write(attributeBytes(instances, settings.forEngines));
        progress.advance(group.bladeCount);
    }
    file.commit();
}

} // namespace sward::interchange
