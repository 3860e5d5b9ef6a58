#include "terrain/topology/soup.h"

#include "core/error.h"
#include "terrain/blocks.h"
#include "terrain/reach.h"
#include "terrain/topology/topology.h"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace sward::terrain {
namespace {

constexpr std::uint32_t unused = 0xffffffffU;
constexpr std::size_t blockSize = 4096; // vertices or triangles that a thread takes at a time

bool isFinite(const glm::dvec3& v)
{
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

// Unit vector along `v`, or 0 if it has no usable direction. A unit vector keeps its bits, so that
// a file of exportGltf() is reproduced exactly.
glm::vec3 direction(const glm::dvec3& v)
{
    const double length = std::sqrt(glm::dot(v, v));
    if (!std::isfinite(length) || length < 1e-12)
        return glm::vec3(0.0f);
    return glm::vec3(std::fabs(length - 1.0) < 1e-6 ? v : v / length);
}

// Numbers the used vertices in their old order.
std::vector<std::uint32_t> numberUsedVertices(const std::vector<glm::uvec3>& triangles,
                                              std::size_t vertices, const std::string& place)
{
    std::vector<std::uint32_t> newIndex(vertices, unused);
    for (std::size_t i = 0; i < triangles.size(); ++i)
        for (glm::length_t corner = 0; corner < 3; ++corner) {
            const std::uint32_t vertex = triangles[i][corner];
            if (vertex >= vertices)
                fail(ErrorKind::input, "{}: triangle {} names vertex {}, but there are {}", place,
                     i, vertex, vertices);
            newIndex[vertex] = 0;
        }
    std::uint32_t next = 0;
    for (std::uint32_t& index : newIndex)
        if (index != unused)
            index = next++;
    return newIndex;
}

template <typename Value>
void keepUsed(std::vector<Value>& values, const std::vector<std::uint32_t>& newIndex)
{
    std::size_t kept = 0;
    for (std::size_t i = 0; i < values.size(); ++i)
        if (newIndex[i] != unused)
            values[kept++] = values[i];
    values.resize(kept);
}

void renumber(std::vector<glm::uvec3>& triangles, const std::vector<std::uint32_t>& newIndex)
{
    for (glm::uvec3& triangle : triangles)
        triangle = {newIndex[triangle.x], newIndex[triangle.y], newIndex[triangle.z]};
}

void dropUnusedVertices(GroundMesh& mesh)
{
    const auto newIndex = numberUsedVertices(mesh.triangles, mesh.positions.size(), "ground");
    keepUsed(mesh.positions, newIndex);
    keepUsed(mesh.normals, newIndex);
    keepUsed(mesh.uvs, newIndex);
    keepUsed(mesh.colors, newIndex);
    mesh.attributes.keep(newIndex, unused);
    renumber(mesh.triangles, newIndex);
}

// Computes normals, then restores those of the file.
void completeNormals(GroundMesh& mesh)
{
    const std::vector<glm::vec3> given = mesh.normals;
    const std::vector<glm::uvec3> triangles = mesh.triangles;
    constexpr double creaseAngle = 0.7853981633974483; // [rad], 45 degrees
    computeNormals(mesh, analyse(mesh, creaseAngle, Seams::withoutTJunctions));

    bool someGiven = false;
    for (std::size_t i = 0; i < triangles.size(); ++i)
        for (glm::length_t corner = 0; corner < 3; ++corner) {
            const std::uint32_t vertex = triangles[i][corner];
            if (given[vertex] != glm::vec3(0.0f)) {
                mesh.triangles[i][corner] = vertex;
                mesh.normals[vertex] = given[vertex];
                someGiven = true;
            }
        }
    if (someGiven)
        dropUnusedVertices(mesh);
}

// Bounding box of the used vertices.
DAabb boundsOf(const Soup& soup, const std::vector<std::uint32_t>& newIndex,
               const std::string& place)
{
    const auto isSound = [&](std::size_t i) {
        return newIndex[i] == unused || isFinite(soup.positions[i]);
    };
    if (!holdsForAll(newIndex.size(), isSound))
        for (std::size_t i = 0; i < newIndex.size(); ++i)
            if (!isSound(i))
                fail(ErrorKind::input, "{}: the position of vertex {} is not a finite number",
                     place, i);
    DAabb bounds;
    for (std::size_t i = 0; i < newIndex.size(); ++i)
        if (newIndex[i] != unused)
            bounds.add(soup.positions[i]);
    requireReach(bounds, place);
    return bounds;
}

// Copies the used vertices, recentred in double precision before rounding.
void takeVertices(Soup& soup, const std::vector<std::uint32_t>& newIndex, std::size_t used,
                  const std::string& place, GroundMesh& mesh)
{
    mesh.origin = originFor(boundsOf(soup, newIndex, place));
    const auto fill = [&](auto& values, const auto& valueOf) {
        values.resize(used);
        forEachBlock(newIndex.size(), blockSize, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i)
                if (newIndex[i] != unused)
                    values[newIndex[i]] = valueOf(i);
        });
    };
    fill(mesh.positions, [&](std::size_t i) { return glm::vec3(soup.positions[i] - mesh.origin); });
    soup.positions = {};
    fill(mesh.normals, [&](std::size_t i) {
        return i < soup.normals.size() ? direction(glm::dvec3(soup.normals[i])) : glm::vec3(0.0f);
    });
    soup.normals = {};
    fill(mesh.uvs,
         [&](std::size_t i) { return i < soup.uvs.size() ? soup.uvs[i] : glm::vec2(0.0f); });
    soup.uvs = {};
    fill(mesh.colors,
         [&](std::size_t i) { return i < soup.colors.size() ? soup.colors[i] : glm::vec4(1.0f); });
    soup.colors = {};
}

} // namespace

Soup soupOf(const GroundMesh& mesh)
{
    Soup soup;
    soup.positions.reserve(mesh.positions.size());
    for (const glm::vec3& position : mesh.positions)
        soup.positions.push_back(mesh.origin + glm::dvec3(position));
    soup.normals = mesh.normals;
    soup.uvs = mesh.uvs;
    soup.colors = mesh.colors;
    soup.attributes = mesh.attributes;
    soup.triangles = mesh.triangles;
    soup.materialOf = mesh.materialOf;
    soup.nodeOf = mesh.nodeOf;
    soup.materials = mesh.materials;
    soup.images = mesh.images;
    soup.nodes = mesh.nodes;
    soup.copyright = mesh.copyright;
    soup.hasColors = mesh.hasColors;
    soup.precision = mesh.precision;
    return soup;
}

void transform(Soup& soup, const glm::dmat4& matrix, std::size_t firstVertex,
               std::size_t firstTriangle)
{
    if (matrix == glm::dmat4(1.0))
        return;
    const glm::dmat3 linear(matrix);
    const glm::dvec3 translation(matrix[3]);
    const bool mirrors = glm::determinant(linear) < 0.0;

    forEachBlock(soup.positions.size() - firstVertex, blockSize,
                 [&](std::size_t begin, std::size_t end) {
                     for (std::size_t i = firstVertex + begin; i < firstVertex + end; ++i)
                         soup.positions[i] = linear * soup.positions[i] + translation;
                 });

    // Cofactors: inverse transpose times |determinant|; direction() normalises the result.
    const double sign = mirrors ? -1.0 : 1.0;
    const glm::dmat3 cofactors(sign * glm::cross(linear[1], linear[2]),
                               sign * glm::cross(linear[2], linear[0]),
                               sign * glm::cross(linear[0], linear[1]));
    if (soup.normals.size() > firstVertex)
        forEachBlock(soup.normals.size() - firstVertex, blockSize,
                     [&](std::size_t begin, std::size_t end) {
                         for (std::size_t i = firstVertex + begin; i < firstVertex + end; ++i)
                             soup.normals[i] = direction(cofactors * glm::dvec3(soup.normals[i]));
                     });
    if (mirrors)
        for (std::size_t i = firstTriangle; i < soup.triangles.size(); ++i)
            std::swap(soup.triangles[i].y, soup.triangles[i].z);
}

GroundMesh settle(Soup&& soup, const std::string& place)
{
    if (soup.triangles.empty())
        fail(ErrorKind::input, "{}: no triangles", place);

    GroundMesh mesh;
    const auto newIndex = numberUsedVertices(soup.triangles, soup.positions.size(), place);
    const std::size_t used =
        newIndex.size() -
        static_cast<std::size_t>(std::count(newIndex.begin(), newIndex.end(), unused));
    const bool allUsed = used == newIndex.size();
    takeVertices(soup, newIndex, used, place, mesh);
    mesh.attributes = std::move(soup.attributes);
    mesh.attributes.resize(newIndex.size());
    mesh.triangles = std::move(soup.triangles);
    if (!allUsed) {
        renumber(mesh.triangles, newIndex);
        mesh.attributes.keep(newIndex, unused);
    }

    mesh.materialOf = std::move(soup.materialOf);
    mesh.nodeOf = std::move(soup.nodeOf);
    mesh.materialOf.resize(mesh.triangles.size(), 0);
    mesh.nodeOf.resize(mesh.triangles.size(), 0);
    mesh.bears.assign(mesh.triangles.size(), 1);
    mesh.materials = std::move(soup.materials);
    mesh.images = std::move(soup.images);
    mesh.nodes = std::move(soup.nodes);
    mesh.copyright = std::move(soup.copyright);
    mesh.hasColors = soup.hasColors;
    // Positions are rounded once more.
    if (soup.precision > 0.0) {
        const glm::vec3 size = mesh.bounds().size();
        mesh.precision = soup.precision + 0x1p-23 * double(std::max({size.x, size.y, size.z}));
    }
    if (mesh.materials.empty())
        mesh.materials.push_back({.name = "ground"});
    if (mesh.nodes.empty())
        mesh.nodes.emplace_back("ground");
    soup = {};

    mesh.hasNormals = holdsForAll(
        mesh.normals.size(), [&](std::size_t i) { return mesh.normals[i] != glm::vec3(0.0f); });
    // Validate all indices before topology uses them.
    validate(mesh, place);
    if (!mesh.hasNormals)
        completeNormals(mesh);
    return mesh;
}

} // namespace sward::terrain
