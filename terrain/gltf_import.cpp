#include "terrain/gltf_import.h"

#include "core/error.h"
#include "core/mapped_file.h"
#include "terrain/gltf_check.h"
#include "terrain/gltf_container.h"
#include "terrain/gltf_files.h"
#include "terrain/gltf_materials.h"
#include "terrain/gltf_nodes.h"
#include "terrain/gltf_primitive.h"

#include <glm/mat3x3.hpp>
#include <nlohmann/json.hpp>
#include <tiny_gltf.h>

#include <cmath>
#include <map>

namespace sward::terrain {
namespace {

// More than any ground that fits into memory; a small file may ask for more by instancing.
constexpr std::size_t triangleLimit = std::size_t(1) << 28;

// Names node, mesh and vertex of a position that leaves the numbers.
void requireFinite(const Soup& soup, const GltfPlacement& placement, const std::string& place)
{
    for (std::size_t i = 0; i < soup.positions.size(); ++i) {
        const glm::dvec3& p = soup.positions[i];
        if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
            fail(ErrorKind::input,
                 "{}: node \"{}\" puts vertex {} of mesh {} at no finite position", place,
                 placement.path, i, placement.mesh);
    }
}

void appendPlaced(const Soup& mesh, const GltfPlacement& placement, const glm::dmat4& worldFromFile,
                  const std::string& place, Soup& soup)
{
    if (mesh.triangles.size() > triangleLimit - soup.triangles.size() ||
        mesh.positions.size() > 3 * triangleLimit - soup.positions.size())
        fail(ErrorKind::input, "{}: more than {} triangles", place, triangleLimit);

    Soup placed = mesh;
    transform(placed, worldFromFile * placement.transform);
    requireFinite(placed, placement, place);

    const auto firstVertex = static_cast<std::uint32_t>(soup.positions.size());
    const auto take = [](auto& to, const auto& from) {
        to.insert(to.end(), from.begin(), from.end());
    };
    take(soup.positions, placed.positions);
    take(soup.normals, placed.normals);
    take(soup.uvs, placed.uvs);
    take(soup.colors, placed.colors);
    take(soup.materialOf, placed.materialOf);
    for (const glm::uvec3& triangle : placed.triangles)
        soup.triangles.push_back(triangle + firstVertex);
    soup.hasColors = soup.hasColors || placed.hasColors;

    // Instances of one node share its name.
    if (soup.nodes.empty() || soup.nodes.back() != placement.path || !placement.repeats)
        soup.nodes.push_back(placement.path);
    soup.nodeOf.resize(soup.triangles.size(), static_cast<std::uint32_t>(soup.nodes.size() - 1));
}

// Leaves out the material for primitives without one, if every primitive has one.
void dropUnusedDefault(Soup& soup)
{
    const auto last = static_cast<std::uint32_t>(soup.materials.size() - 1);
    for (const std::uint32_t material : soup.materialOf)
        if (material == last)
            return;
    soup.materials.pop_back();
}

} // namespace

Soup importGltf(const std::filesystem::path& path, const ImportSettings& settings,
                const glm::dmat4& worldFromFile, Diagnostics& diagnostics)
{
    const std::string place = path.string();
    const tinygltf::Model model = readGltfModel(path, diagnostics);

    Soup soup;
    soup.copyright = model.asset.copyright;
    const std::vector<GltfUvSource> uvs = importGltfMaterials(model, place, soup, diagnostics);

    // Read each mesh once, however many nodes show it.
    std::map<int, Soup> meshes;
    const auto placements = placeGltfMeshes(model, settings.scene, place);
    for (const GltfPlacement& placement : placements) {
        auto found = meshes.find(placement.mesh);
        if (found == meshes.end())
            found = meshes
                        .emplace(placement.mesh,
                                 readGltfMesh(model, static_cast<std::size_t>(placement.mesh), uvs,
                                              place, diagnostics))
                        .first;
        appendPlaced(found->second, placement, worldFromFile, place, soup);
    }
    if (soup.triangles.empty())
        fail(ErrorKind::input, "{}: no triangles: its scene shows {} meshes with none among them",
             place, placements.size());
    dropUnusedDefault(soup);
    return soup;
}

} // namespace sward::terrain
