#include "terrain/gltf_import.h"

#include "core/error.h"
#include "terrain/gltf_materials.h"
#include "terrain/gltf_model.h"
#include "terrain/gltf_nodes.h"
#include "terrain/gltf_primitive.h"

#include <cmath>
#include <map>

namespace sward::terrain {
namespace {

// What the soup of a scene may cost [bytes]: a small file may ask for much by instancing. 20
// million triangles on 10 million vertices are 1 GB.
constexpr std::uint64_t soupLimit = std::uint64_t(5) << 29;
constexpr std::uint64_t vertexCost = 60;
constexpr std::uint64_t triangleCost = 20;

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

// Makes room for everything that the scene shows, if it may cost that much.
void reserve(const GltfModel& model, const std::vector<GltfPlacement>& placements,
             const std::string& place, Soup& soup)
{
    std::vector<GltfMeshSize> sizes;
    for (std::size_t i = 0; i < model.structure.meshes.size(); ++i)
        sizes.push_back(sizeOfGltfMesh(model, i));
    GltfMeshSize sum;
    for (const GltfPlacement& placement : placements) {
        sum.vertices += sizes.at(static_cast<std::size_t>(placement.mesh)).vertices;
        sum.triangles += sizes.at(static_cast<std::size_t>(placement.mesh)).triangles;
        if (vertexCost * sum.vertices + triangleCost * sum.triangles > soupLimit)
            fail(ErrorKind::input,
                 "{}: its scene shows at least {} vertices and {} triangles, more than {} bytes of "
                 "ground",
                 place, sum.vertices, sum.triangles, soupLimit);
    }
    soup.positions.reserve(sum.vertices);
    soup.normals.reserve(sum.vertices);
    soup.uvs.reserve(sum.vertices);
    soup.colors.reserve(sum.vertices);
    soup.triangles.reserve(sum.triangles);
    soup.materialOf.reserve(sum.triangles);
    soup.nodeOf.reserve(sum.triangles);
}

void appendPlaced(Soup&& placed, const GltfPlacement& placement, const glm::dmat4& worldFromFile,
                  const std::string& place, Soup& soup)
{
    transform(placed, worldFromFile * placement.transform);
    requireFinite(placed, placement, place);

    const auto firstVertex = static_cast<std::uint32_t>(soup.positions.size());
    // Each array goes as soon as it has been taken.
    const auto take = [](auto& to, auto& from) {
        to.insert(to.end(), from.begin(), from.end());
        from = {};
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
    const GltfModel model = readGltfModel(path, diagnostics);
    const auto placements = placeGltfMeshes(model, settings.scene, place);
    Soup soup;
    reserve(model, placements, place, soup);
    soup.copyright = model.structure.asset.copyright;
    const std::vector<GltfUvSource> uvs = importGltfMaterials(model, place, soup, diagnostics);

    // Read each mesh once, however many nodes show it, and keep it no longer than that.
    std::map<int, std::size_t> uses;
    for (const GltfPlacement& placement : placements)
        ++uses[placement.mesh];
    std::map<int, Soup> meshes;
    for (const GltfPlacement& placement : placements) {
        auto found = meshes.find(placement.mesh);
        if (found == meshes.end())
            found = meshes
                        .emplace(placement.mesh,
                                 readGltfMesh(model, static_cast<std::size_t>(placement.mesh), uvs,
                                              place, diagnostics))
                        .first;
        const bool isLast = --uses[placement.mesh] == 0;
        appendPlaced(isLast ? std::move(found->second) : Soup(found->second), placement,
                     worldFromFile, place, soup);
        if (isLast)
            meshes.erase(found);
    }
    if (soup.triangles.empty())
        fail(ErrorKind::input, "{}: no triangles: its scene shows {} meshes with none among them",
             place, placements.size());
    dropUnusedDefault(soup);
    return soup;
}

} // namespace sward::terrain
