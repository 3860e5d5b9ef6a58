#include "terrain/gltf/import.h"

#include "core/error.h"
#include "terrain/blocks.h"
#include "terrain/gltf/materials.h"
#include "terrain/gltf/model.h"
#include "terrain/gltf/nodes.h"
#include "terrain/gltf/primitive.h"
#include "terrain/reach.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <map>

namespace sward::terrain {
namespace {

// Memory limit of a scene's soup [bytes]. A small file can expand by instances and by accessors of
// zeros; a large file adds its size. 20 million triangles on 10 million vertices take 1 GB. A file
// has its own bound besides: an instance of many vertices has few bytes.
constexpr std::uint64_t soupLimit = std::uint64_t(3) << 29;
constexpr std::uint64_t vertexCost = 60;
constexpr std::uint64_t triangleCost = 20;
constexpr std::uint64_t triangleLimit = 25'000'000;
constexpr std::uint64_t costOfByte = 6; // of the file
constexpr std::uint64_t bytesOfTriangle = 18;
constexpr std::uint64_t freeSoup = std::uint64_t(1) << 22;
constexpr std::uint64_t soupGain = 1024; // of each byte of the file

// The matrix of a placement, column by column.
std::string matrixText(const glm::dmat4& matrix)
{
    std::string text;
    for (glm::length_t column = 0; column < 4; ++column)
        for (glm::length_t row = 0; row < 3; ++row)
            text += fmt::format("{}{:.6g}", text.empty() ? "" : " ", matrix[column][row]);
    return text;
}

// Throws naming node, mesh, vertex and matrix of a position that is not finite or out of reach.
void requirePlaces(const Soup& soup, std::size_t first, const GltfPlacement& placement,
                   bool isSkinned, const std::string& place)
{
    const auto isSound = [&](std::size_t i) { return isWithinReach(soup.positions[first + i]); };
    const std::size_t count = soup.positions.size() - first;
    if (holdsForAll(count, isSound))
        return;
    for (std::size_t i = 0; i < count; ++i) {
        const glm::dvec3& p = soup.positions[first + i];
        if (!isSound(i))
            fail(ErrorKind::input,
                 "{}: node \"{}\" puts vertex {} of mesh {} at ({:.6g}, {:.6g}, {:.6g}) m, outside "
                 "±{} m; {}",
                 place, placement.path, i, placement.mesh, p.x, p.y, p.z, farthestCoordinate,
                 isSkinned ? "its skin moves it"
                           : "its matrix by columns is " + matrixText(placement.transform));
    }
}

// Reserves memory for the whole scene, within the limit.
void reserve(const GltfModel& model, const std::vector<GltfPlacement>& placements,
             const std::string& place, Soup& soup)
{
    std::vector<GltfMeshSize> sizes;
    for (std::size_t i = 0; i < model.structure.meshes.size(); ++i)
        sizes.push_back(sizeOfGltfMesh(model, i));
    const std::uint64_t bytes = model.size;
    const std::uint64_t costs =
        std::min(std::max(soupLimit, costOfByte * bytes), freeSoup + soupGain * bytes);
    const std::uint64_t triangles = std::max(triangleLimit, bytes / bytesOfTriangle);
    GltfMeshSize sum;
    for (const GltfPlacement& placement : placements) {
        sum.vertices += sizes.at(static_cast<std::size_t>(placement.mesh)).vertices;
        sum.triangles += sizes.at(static_cast<std::size_t>(placement.mesh)).triangles;
        if (sum.triangles > triangles ||
            vertexCost * sum.vertices + triangleCost * sum.triangles > costs)
            fail(ErrorKind::input,
                 "{}: its scene shows {} vertices and {} triangles or more, too many for {} bytes",
                 place, sum.vertices, sum.triangles, bytes);
    }
    soup.positions.reserve(sum.vertices);
    soup.normals.reserve(sum.vertices);
    soup.uvs.reserve(sum.vertices);
    soup.colors.reserve(sum.vertices);
    soup.triangles.reserve(sum.triangles);
    soup.materialOf.reserve(sum.triangles);
    soup.nodeOf.reserve(sum.triangles);
}

// Appends an already read mesh.
void append(const Soup& mesh, Soup& soup)
{
    const std::size_t first = soup.positions.size();
    const auto take = [first](auto& to, const auto& from, const auto& otherwise) {
        if (from.empty())
            return;
        to.resize(first, otherwise);
        to.insert(to.end(), from.begin(), from.end());
    };
    take(soup.normals, mesh.normals, glm::vec3(0.0f));
    take(soup.uvs, mesh.uvs, glm::vec2(0.0f));
    take(soup.colors, mesh.colors, glm::vec4(1.0f));
    soup.positions.insert(soup.positions.end(), mesh.positions.begin(), mesh.positions.end());
    soup.materialOf.insert(soup.materialOf.end(), mesh.materialOf.begin(), mesh.materialOf.end());
    for (const glm::uvec3& triangle : mesh.triangles)
        soup.triangles.push_back(triangle + static_cast<std::uint32_t>(first));
    soup.hasColors = soup.hasColors || mesh.hasColors;
    for (const VertexAttribute& one : mesh.attributes.list) {
        VertexAttribute& kept = soup.attributes.entry(one.name);
        kept.components = std::min(kept.components, one.components);
        take(kept.values, one.values, glm::vec4(1.0f));
    }
    soup.attributes.appendGaps(mesh.attributes, soup.triangles.size() - mesh.triangles.size());
}

// Drops sets of texture coordinates that the ground has anyway, since its materials show them.
void dropShownSets(Soup& soup)
{
    const auto isShown = [&](VertexAttribute& one) {
        if (!one.name.starts_with("TEXCOORD_"))
            return false;
        one.values.resize(soup.positions.size(), glm::vec4(0.0f));
        soup.uvs.resize(soup.positions.size(), glm::vec2(0.0f));
        return holdsForAll(one.values.size(),
                           [&](std::size_t i) { return glm::vec2(one.values[i]) == soup.uvs[i]; });
    };
    std::erase_if(soup.attributes.list, isShown);
}

// The step of a mesh's coordinates after it is placed. Exporters write transforms in single
// precision, so that a place in the scene has no more.
double placedPrecision(const Soup& soup, std::size_t firstVertex, double scale)
{
    double farthest = 0.0;
    for (std::size_t v = firstVertex; v < soup.positions.size(); ++v) {
        const glm::dvec3 size = glm::abs(soup.positions[v]);
        farthest = std::max({farthest, size.x, size.y, size.z});
    }
    return soup.precision * scale + 0x1p-23 * farthest;
}

// Reads the meshes of a scene at their placements.
class SceneReader {
public:
    SceneReader(const GltfModel& model, const std::vector<GltfPlacement>& placements,
                const MaskInputs& read, const std::string& place, Diagnostics& diagnostics)
        : model_(model)
        , read_(read)
        , place_(place)
        , diagnostics_(diagnostics)
        , poser_(model, place)
    {
        for (const GltfPlacement& placement : placements)
            if (!isPosed(placement))
                ++uses_[placement.mesh];
    }

    void show(const GltfPlacement& placement, const std::vector<GltfUvSource>& uvs,
              const glm::dmat4& worldFromFile, Soup& soup)
    {
        const std::size_t firstVertex = soup.positions.size();
        const std::size_t firstTriangle = soup.triangles.size();
        const auto mesh = static_cast<std::size_t>(placement.mesh);
        const double before = soup.precision;
        soup.precision = 0.0;
        const GltfPose pose = poser_.poseOf(placement.node, placement.transform);
        if (isPosed(placement) || uses_[placement.mesh] == 1) {
            readGltfMesh(model_, mesh, pose, uvs, read_, place_, soup, diagnostics_);
        } else {
            // Read a repeated mesh once, into a separate soup.
            const auto [found, isNew] = meshes_.try_emplace(placement.mesh);
            if (isNew)
                readGltfMesh(model_, mesh, pose, uvs, read_, place_, found->second, diagnostics_);
            append(found->second, soup);
            soup.precision = found->second.precision;
        }
        transform(soup, pose.isSkinned() ? worldFromFile : worldFromFile * placement.transform,
                  firstVertex, firstTriangle);
        requirePlaces(soup, firstVertex, placement, pose.isSkinned(), place_);
        const double scale = pose.scale() * glm::length(glm::dvec3(worldFromFile[0]));
        soup.precision = std::max(before, placedPrecision(soup, firstVertex, scale));

        // Instances of one node share its name.
        if (soup.nodes.empty() || soup.nodes.back() != placement.path || !placement.repeats)
            soup.nodes.push_back(placement.path);
        soup.nodeOf.resize(soup.triangles.size(),
                           static_cast<std::uint32_t>(soup.nodes.size() - 1));
    }

private:
    // Whether its node poses its mesh otherwise than other nodes may.
    bool isPosed(const GltfPlacement& placement) const
    {
        const GltfNode& node = model_.structure.nodes.at(static_cast<std::size_t>(placement.node));
        return node.skin != noEntry || !node.weights.empty();
    }

    const GltfModel& model_;
    const MaskInputs& read_;
    const std::string& place_;
    Diagnostics& diagnostics_;
    GltfPoser poser_;
    std::map<int, std::size_t> uses_; // of meshes that are not posed
    std::map<int, Soup> meshes_;      // those that are read once
};

// Removes the material for primitives without one, if every primitive has one.
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
    const auto placements = placeGltfMeshes(model, settings.scene, place, diagnostics);
    Soup soup;
    reserve(model, placements, place, soup);
    soup.copyright = model.structure.copyright;
    const std::vector<GltfUvSource> uvs =
        importGltfMaterials(model, settings.masks.imageChannels, place, soup, diagnostics);

    SceneReader scene(model, placements, settings.masks, place, diagnostics);
    for (const GltfPlacement& placement : placements)
        scene.show(placement, uvs, worldFromFile, soup);
    if (soup.triangles.empty())
        fail(ErrorKind::input, "{}: no triangles: {}", place,
             placements.empty() ? std::string("no node shows a mesh")
                                : fmt::format("its scene shows {} meshes with none among them",
                                              placements.size()));
    dropUnusedDefault(soup);
    dropShownSets(soup);
    return soup;
}

} // namespace sward::terrain
