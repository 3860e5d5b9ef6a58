#include "terrain/ground_mesh.h"

#include "core/error.h"
#include "core/expect.h"
#include "terrain/blocks.h"
#include "terrain/reach.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace sward::terrain {
namespace {

bool isFinite(const glm::vec2& v)
{
    return std::isfinite(v.x) && std::isfinite(v.y);
}

bool isFinite(const glm::vec3& v)
{
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

bool isFinite(const glm::vec4& v)
{
    return isFinite(glm::vec3(v)) && std::isfinite(v.w);
}

template <typename Vec>
void requireFinite(const std::vector<Vec>& values, const char* what, const std::string& place)
{
    if (holdsForAll(values.size(), [&](std::size_t i) { return isFinite(values[i]); }))
        return;
    for (std::size_t i = 0; i < values.size(); ++i)
        if (!isFinite(values[i]))
            fail(ErrorKind::input, "{}: the {} of vertex {} is not a finite number", place, what,
                 i);
}

void requireLength(std::size_t length, std::size_t expected, const char* what,
                   const std::string& place)
{
    if (length != expected)
        fail(ErrorKind::input, "{}: {} {} where {} are needed", place, length, what, expected);
}

// Vector along the normal; its length is twice the area.
glm::dvec3 areaVector(const GroundMesh& mesh, std::size_t index)
{
    const glm::uvec3 t = mesh.triangles[index];
    const glm::dvec3 a(mesh.positions[t.x]);
    return glm::cross(glm::dvec3(mesh.positions[t.y]) - a, glm::dvec3(mesh.positions[t.z]) - a);
}

// Checks that every per-triangle index is in range.
void validateTriangles(const GroundMesh& mesh, const std::string& place)
{
    const std::size_t vertices = mesh.positions.size();
    const auto isSound = [&](std::size_t i) {
        const glm::uvec3 t = mesh.triangles[i];
        return t.x < vertices && t.y < vertices && t.z < vertices &&
               mesh.materialOf[i] < mesh.materials.size() && mesh.nodeOf[i] < mesh.nodes.size();
    };
    if (holdsForAll(mesh.triangles.size(), isSound))
        return;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const glm::uvec3 t = mesh.triangles[i];
        if (t.x >= vertices || t.y >= vertices || t.z >= vertices)
            fail(ErrorKind::input, "{}: triangle {} names vertex {}, but there are {}", place, i,
                 std::max({t.x, t.y, t.z}), vertices);
        if (mesh.materialOf[i] >= mesh.materials.size())
            fail(ErrorKind::input, "{}: triangle {} names material {}, but there are {}", place, i,
                 mesh.materialOf[i], mesh.materials.size());
        if (mesh.nodeOf[i] >= mesh.nodes.size())
            fail(ErrorKind::input, "{}: triangle {} names node {}, but there are {}", place, i,
                 mesh.nodeOf[i], mesh.nodes.size());
    }
}

// Appends the attributes of `other` to those of `mesh`, before its vertices are appended.
void appendAttributes(GroundMesh& mesh, const GroundMesh& other)
{
    // What is no entry of its own is held by uvs or colors.
    const auto valueAt = [](const GroundMesh& from, const std::string& name, std::size_t vertex) {
        if (const VertexAttribute* const own = from.attributes.find(name))
            return own->values[vertex];
        if (name.starts_with("TEXCOORD_"))
            return glm::vec4(from.uvs[vertex], 0.0f, 0.0f);
        return name == "COLOR_0" ? from.colors[vertex] : glm::vec4(1.0f);
    };
    for (const VertexAttribute& one : other.attributes.list)
        if (mesh.attributes.find(one.name) == nullptr) {
            std::vector<glm::vec4> before;
            for (std::size_t v = 0; v < mesh.positions.size(); ++v)
                before.push_back(valueAt(mesh, one.name, v));
            mesh.attributes.entry(one.name).values = std::move(before);
        }
    for (VertexAttribute& one : mesh.attributes.list) {
        if (const VertexAttribute* const own = other.attributes.find(one.name))
            one.components = std::min(one.components, own->components);
        for (std::size_t v = 0; v < other.positions.size(); ++v)
            one.values.push_back(valueAt(other, one.name, v));
    }
    mesh.attributes.appendGaps(other.attributes, mesh.triangles.size());
}

} // namespace

Aabb GroundMesh::bounds() const
{
    Aabb box;
    for (const glm::vec3& position : positions)
        box.add(position);
    return box;
}

double GroundMesh::area(std::size_t index) const
{
    return 0.5 * glm::length(areaVector(*this, index));
}

glm::dvec3 GroundMesh::faceNormal(std::size_t index) const
{
    const glm::dvec3 normal = areaVector(*this, index);
    const double length = glm::length(normal);
    return length > 0.0 ? normal / length : glm::dvec3(0.0);
}

void validate(const GroundMesh& mesh, const std::string& place)
{
    const std::size_t vertices = mesh.positions.size();
    const std::size_t triangles = mesh.triangles.size();
    if (triangles == 0)
        fail(ErrorKind::input, "{}: no triangles", place);
    requireLength(mesh.normals.size(), vertices, "normals", place);
    requireLength(mesh.uvs.size(), vertices, "texture coordinates", place);
    requireLength(mesh.colors.size(), vertices, "colours", place);
    for (const VertexAttribute& one : mesh.attributes.list)
        requireLength(one.values.size(), vertices, one.name.c_str(), place);
    requireLength(mesh.materialOf.size(), triangles, "material indices", place);
    requireLength(mesh.nodeOf.size(), triangles, "node indices", place);
    requireLength(mesh.bears.size(), triangles, "roles", place);
    validateTriangles(mesh, place);

    requireFinite(mesh.positions, "position", place);
    requireFinite(mesh.normals, "normal", place);
    requireFinite(mesh.uvs, "texture coordinate", place);
    requireFinite(mesh.colors, "colour", place);
    for (const VertexAttribute& one : mesh.attributes.list)
        requireFinite(one.values, one.name.c_str(), place);
    const Aabb bounds = mesh.bounds();
    requireReach({mesh.origin + glm::dvec3(bounds.low), mesh.origin + glm::dvec3(bounds.high)},
                 place);

    for (std::size_t i = 0; i < triangles; ++i)
        if (mesh.area(i) > 0.0)
            return;
    fail(ErrorKind::input, "{}: none of the {} triangles has an area", place, triangles);
}

void append(GroundMesh& mesh, const GroundMesh& other)
{
    expect(mesh.positions.size() + other.positions.size() <= 0xffffffffU, "too many vertices");
    if (mesh.positions.empty()) {
        mesh.origin = other.origin;
        mesh.hasNormals = other.hasNormals;
        mesh.copyright = other.copyright;
    } else {
        mesh.hasNormals = mesh.hasNormals && other.hasNormals;
        if (mesh.copyright.empty())
            mesh.copyright = other.copyright;
        else if (!other.copyright.empty() && other.copyright != mesh.copyright)
            mesh.copyright += "; " + other.copyright;
    }
    if (mesh.mapSystem.empty())
        mesh.mapSystem = other.mapSystem;
    mesh.heightCells =
        mesh.positions.empty() && mesh.origin == other.origin ? other.heightCells : nullptr;
    mesh.hasPlace = mesh.hasPlace || other.hasPlace;
    mesh.hasColors = mesh.hasColors || other.hasColors;
    mesh.precision = std::max(mesh.precision, other.precision);

    const auto firstVertex = static_cast<std::uint32_t>(mesh.positions.size());
    const auto firstMaterial = static_cast<std::uint32_t>(mesh.materials.size());
    const auto firstImage = static_cast<std::uint32_t>(mesh.images.size());
    const auto firstNode = static_cast<std::uint32_t>(mesh.nodes.size());

    appendAttributes(mesh, other);

    // Bring the positions to the origin of `mesh` before they are rounded.
    const glm::dvec3 shift = other.origin - mesh.origin;
    for (const glm::vec3& position : other.positions)
        mesh.positions.emplace_back(glm::dvec3(position) + shift);
    mesh.normals.insert(mesh.normals.end(), other.normals.begin(), other.normals.end());
    mesh.uvs.insert(mesh.uvs.end(), other.uvs.begin(), other.uvs.end());
    mesh.colors.insert(mesh.colors.end(), other.colors.begin(), other.colors.end());

    for (const glm::uvec3& triangle : other.triangles)
        mesh.triangles.push_back(triangle + firstVertex);
    for (const std::uint32_t material : other.materialOf)
        mesh.materialOf.push_back(material + firstMaterial);
    for (const std::uint32_t node : other.nodeOf)
        mesh.nodeOf.push_back(node + firstNode);
    mesh.bears.insert(mesh.bears.end(), other.bears.begin(), other.bears.end());

    for (GroundMaterial material : other.materials) {
        if (material.image != GroundMaterial::noImage)
            material.image += firstImage;
        mesh.materials.push_back(std::move(material));
    }
    mesh.images.insert(mesh.images.end(), other.images.begin(), other.images.end());
    mesh.nodes.insert(mesh.nodes.end(), other.nodes.begin(), other.nodes.end());
}

glm::dvec3 originFor(const DAabb& worldBounds)
{
    constexpr double step = 32.0; // [m] the width of a leaf cell of the patch tree
    const glm::dvec3 centre = worldBounds.centre();
    // Adding 0 turns −0 into +0, so that equal origins have equal bytes.
    return {std::round(centre.x / step) * step + 0.0, std::round(centre.y / step) * step + 0.0,
            std::round(centre.z / step) * step + 0.0};
}

} // namespace sward::terrain
