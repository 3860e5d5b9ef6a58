#include "terrain/loading/arrays.h"

#include "core/error.h"
#include "terrain/heightmap/height_samples.h"
#include "terrain/heightmap/heightmap.h"
#include "terrain/loading/placement.h"
#include "terrain/loading/rounding.h"
#include "terrain/mesh_files/mesh_import.h"
#include "terrain/topology/soup.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace sward::terrain {
namespace {

constexpr float farthestHeight = 1e6f; // [m] above or below 0, of heights

void requirePerVertex(std::size_t count, std::size_t vertices, const std::string& what,
                      const std::string& name)
{
    if (count != vertices)
        fail(ErrorKind::input, "{}: {} {} for {} vertices; there must be one for each", name, count,
             what, vertices);
}

// Notes what masks read and the arrays lack.
void noteGapsOf(const MeshArrays& mesh, const MaskInputs& read, const std::string& name, Soup& soup)
{
    const auto isThere = [&](const std::string& attribute) {
        if (attribute == "COLOR_0")
            return !mesh.colors.empty();
        if (attribute == "TEXCOORD_0" || attribute == materialCoordinates)
            return !mesh.uvs.empty();
        return std::ranges::any_of(
            mesh.attributes, [&](const VertexAttribute& one) { return one.name == attribute; });
    };
    for (const std::string& attribute : read.attributes)
        if (!isThere(attribute))
            soup.attributes.addGap(attribute, 0, mesh.triangles.size(), name);
}

} // namespace

GroundMesh load(MeshArrays&& mesh, const std::string& name, const ImportSettings& settings,
                Diagnostics& diagnostics)
{
    const glm::dmat4 matrix = worldFromFile(settings);
    const std::size_t vertices = mesh.vertices.size();
    if (!mesh.colors.empty())
        requirePerVertex(mesh.colors.size(), vertices, "colours", name);
    if (!mesh.uvs.empty())
        requirePerVertex(mesh.uvs.size(), vertices, "texture coordinates", name);
    Soup soup;
    noteGapsOf(mesh, settings.masks, name, soup);
    for (VertexAttribute& one : mesh.attributes) {
        requirePerVertex(one.values.size(), vertices, "values of " + one.name, name);
        // Only what a mask reads is kept.
        if (std::ranges::find(settings.masks.attributes, one.name) !=
            settings.masks.attributes.end())
            soup.attributes.list.push_back(std::move(one));
    }
    soup.hasColors = !mesh.colors.empty();
    soup.positions = std::move(mesh.vertices);
    soup.triangles = std::move(mesh.triangles);
    soup.colors = std::move(mesh.colors);
    soup.uvs = std::move(mesh.uvs);
    soup.normals.resize(vertices, glm::vec3(0.0f));
    soup.uvs.resize(vertices, glm::vec2(0.0f));
    soup.colors.resize(vertices, glm::vec4(1.0f));
    soup.materialOf.resize(soup.triangles.size(), 0);
    soup.nodeOf.resize(soup.triangles.size(), 0);
    soup.materials.push_back({.name = "ground"});
    soup.nodes.push_back(name);
    showColors(soup);
    for (std::size_t i = 0; i < soup.triangles.size(); ++i)
        for (glm::length_t corner = 0; corner < 3; ++corner)
            if (soup.triangles[i][corner] >= vertices)
                fail(ErrorKind::input, "{}: triangle {} names vertex {}, but there are {}", name, i,
                     soup.triangles[i][corner], vertices);

    const double metresPerUnit = glm::length(glm::dvec3(matrix[0]));
    if (mesh.isSingle)
        warnOfCoarseness(soup.positions, metresPerUnit, name, diagnostics);
    soup.precision = metresPerUnit * coordinateStep(soup.positions, false);
    transform(soup, matrix);
    warnOfRounding(soup, name, diagnostics);
    GroundMesh ground = settle(std::move(soup), name);
    assignRoles(ground, settings, name, diagnostics);
    return ground;
}

GroundMesh load(HeightArray&& heights, const std::string& name, const ImportSettings& settings,
                Diagnostics& diagnostics)
{
    requireHeightmapSize(heights.size.x, heights.size.y, name);
    HeightSamples samples;
    samples.size = heights.size;
    samples.values = std::move(heights.values);
    samples.isMetric = true;
    for (std::size_t i = 0; i < samples.values.size(); ++i)
        if (std::fabs(samples.values[i]) > farthestHeight)
            fail(ErrorKind::input,
                 "{}: {} m at row {}, column {}; heights are within ±{} m, or NaN", name,
                 samples.values[i], i / samples.size.x, i % samples.size.x, farthestHeight);
    GroundMesh ground = groundOf(std::move(samples), settings.heightmap, name, diagnostics);
    ground.nodes[0] = name;
    ground.attributes.addGeneratedGaps(settings.masks, ground.triangles.size(), name);
    ground = placed(std::move(ground), worldFromFile(settings), name);
    assignRoles(ground, settings, name, diagnostics);
    return ground;
}

} // namespace sward::terrain
