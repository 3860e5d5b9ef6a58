#include "terrain/mesh_files/openmesh_soup.h"

#include "core/error.h"
#include "terrain/unit_colors.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace sward::terrain {
namespace {

glm::vec3 toGlm(const OpenMesh::Vec3f& v)
{
    return {v[0], v[1], v[2]};
}

// The formats of OpenMesh's readers count v from the lower edge of an image. Invalid numbers become
// 0.
glm::vec2 imageUv(float u, float v)
{
    return {std::isfinite(u) ? u : 0.0f, std::isfinite(v) ? 1.0f - v : 0.0f};
}

} // namespace

std::size_t OpenMeshSoup::indexOf(OpenMesh::VertexHandle vertex) const
{
    if (vertex.idx() < 0 || static_cast<std::size_t>(vertex.idx()) >= soup_.positions.size())
        fail(ErrorKind::input, "{}: a face names vertex {}, but there are {}", place_, vertex.idx(),
             soup_.positions.size());
    return static_cast<std::size_t>(vertex.idx());
}

OpenMesh::VertexHandle OpenMeshSoup::add_vertex(const OpenMesh::Vec3f& point)
{
    const OpenMesh::VertexHandle vertex = add_vertex();
    set_point(vertex, point);
    return vertex;
}

OpenMesh::VertexHandle OpenMeshSoup::add_vertex()
{
    soup_.positions.emplace_back(0.0);
    return OpenMesh::VertexHandle(static_cast<int>(soup_.positions.size() - 1));
}

void OpenMeshSoup::set_point(OpenMesh::VertexHandle vertex, const OpenMesh::Vec3f& point)
{
    soup_.positions[indexOf(vertex)] = glm::dvec3(toGlm(point));
}

OpenMesh::FaceHandle OpenMeshSoup::add_face(const VHandles& corners)
{
    corners_.clear();
    for (const OpenMesh::VertexHandle corner : corners)
        corners_.push_back(static_cast<std::uint32_t>(indexOf(corner)));
    firstTriangle_ = soup_.triangles.size();
    places_.clear();
    for (const std::uint32_t corner : corners_)
        places_.push_back(soup_.positions[corner]);
    bool crosses = false;
    parts_ = triangulate(places_, crosses);
    if (crosses && crossedFaces_++ == 0)
        firstCrossed_ = faces_;
    for (const PolygonTriangle& part : parts_) {
        soup_.triangles.emplace_back(corners_[part[0]], corners_[part[1]], corners_[part[2]]);
        faceOf_.push_back(static_cast<std::uint32_t>(faces_));
    }
    const std::size_t face = faces_++;
    if (face < faceUvs_.size() && !faceUvs_[face].empty()) {
        std::vector<OpenMesh::Vec2f> uvs;
        for (const glm::vec2& uv : faceUvs_[face])
            uvs.emplace_back(uv.x, uv.y);
        add_face_texcoords(OpenMesh::FaceHandle(static_cast<int>(face)), corners[0], uvs);
    }
    return OpenMesh::FaceHandle(static_cast<int>(face));
}

void OpenMeshSoup::add_face_texcoords(OpenMesh::FaceHandle, OpenMesh::VertexHandle first,
                                      const std::vector<OpenMesh::Vec2f>& uvs)
{
    if (uvs.size() != corners_.size() || corners_.empty())
        return;
    // The coordinates begin at the corner `first` of the last face.
    const auto start =
        std::find(corners_.begin(), corners_.end(), static_cast<std::uint32_t>(indexOf(first)));
    const auto shift = static_cast<std::size_t>(start - corners_.begin());
    const auto uvOf = [&](std::size_t corner) {
        const std::size_t n = corners_.size();
        const OpenMesh::Vec2f& uv = uvs[(corner + n - shift % n) % n];
        return imageUv(uv[0], uv[1]);
    };
    cornerUvs_.resize(3 * soup_.triangles.size(), glm::vec2(0.0f));
    isFaceMapped_.resize(firstTriangle_, false);
    isFaceMapped_.resize(soup_.triangles.size(), true);
    for (std::size_t i = 0; i < parts_.size(); ++i)
        for (std::size_t corner = 0; corner < 3; ++corner)
            cornerUvs_[3 * (firstTriangle_ + i) + corner] = uvOf(parts_[i][corner]);
}

void OpenMeshSoup::warnOfCrossed(Diagnostics& diagnostics) const
{
    if (crossedFaces_ > 0)
        diagnostics.warn("{}: the edges of {} polygons cross, of face {} first; where they bear "
                         "grass is undefined",
                         place_, crossedFaces_, firstCrossed_);
}

void OpenMeshSoup::set_normal(OpenMesh::VertexHandle vertex, const OpenMesh::Vec3f& normal)
{
    const std::size_t index = indexOf(vertex);
    soup_.normals.resize(soup_.positions.size(), glm::vec3(0.0f));
    normalsDisagree_.resize(soup_.positions.size(), false);
    // Normals are per corner; different normals at one vertex mean an edge.
    glm::vec3& own = soup_.normals[index];
    if (own != glm::vec3(0.0f) && own != toGlm(normal))
        normalsDisagree_[index] = true;
    own = toGlm(normal);
}

void OpenMeshSoup::set_normal(OpenMesh::VertexHandle vertex, const OpenMesh::Vec3d& normal)
{
    set_normal(vertex, OpenMesh::Vec3f(normal));
}

void OpenMeshSoup::keepColor(OpenMesh::VertexHandle vertex, const glm::vec4& color)
{
    soup_.colors.resize(soup_.positions.size(), glm::vec4(1.0f));
    isColored_.resize(soup_.positions.size(), false);
    const std::size_t index = indexOf(vertex);
    // An invalid number becomes 0.
    for (glm::length_t c = 0; c < 4; ++c)
        soup_.colors[index][c] = std::isfinite(color[c]) ? color[c] : 0.0f;
    isColored_[index] = true;
    soup_.hasColors = true;
}

void OpenMeshSoup::setColors(const std::vector<glm::vec4>& colors)
{
    for (std::size_t v = 0; v < colors.size(); ++v)
        keepColor(OpenMesh::VertexHandle(static_cast<int>(v)), colors[v]);
}

// Brings colours into [0, 1]. Vertices without one stay white.
void OpenMeshSoup::finishColors(Diagnostics& diagnostics)
{
    if (!soup_.hasColors)
        return;
    isColored_.resize(soup_.colors.size(), false);
    for (std::size_t v = 0; v < soup_.colors.size(); ++v)
        if (!isColored_[v])
            soup_.colors[v] = glm::vec4(0.0f, 0.0f, 0.0f, 1.0f);
    bringToUnit(soup_.colors, place_, "the colour of its vertices", diagnostics);
    for (std::size_t v = 0; v < soup_.colors.size(); ++v)
        if (!isColored_[v])
            soup_.colors[v] = glm::vec4(1.0f);
}

void OpenMeshSoup::noteGaps(const MaskInputs& read, const PartName& partOf)
{
    isColored_.resize(soup_.positions.size(), false);
    isMapped_.resize(soup_.positions.size(), false);
    isFaceMapped_.resize(soup_.triangles.size(), false);
    const auto holds = [&](const std::vector<bool>& has, std::size_t triangle) {
        const glm::uvec3 t = soup_.triangles[triangle];
        return has[t.x] && has[t.y] && has[t.z];
    };
    for (const std::string& name : read.attributes)
        for (std::size_t t = 0; t < soup_.triangles.size(); ++t) {
            const bool isThere = name == "COLOR_0" ? holds(isColored_, t)
                                 : name == "TEXCOORD_0" || name == materialCoordinates
                                     ? isFaceMapped_[t] || holds(isMapped_, t)
                                     : false;
            if (!isThere)
                soup_.attributes.addGap(name, t, t + 1, partOf ? partOf(faceOf_[t]) : place_);
        }
}

void OpenMeshSoup::set_color(OpenMesh::VertexHandle vertex, const OpenMesh::Vec3uc& color)
{
    keepColor(vertex, glm::vec4(color[0], color[1], color[2], 255.0f) / 255.0f);
}

void OpenMeshSoup::set_color(OpenMesh::VertexHandle vertex, const OpenMesh::Vec4uc& color)
{
    keepColor(vertex, glm::vec4(color[0], color[1], color[2], color[3]) / 255.0f);
}

void OpenMeshSoup::set_color(OpenMesh::VertexHandle vertex, const OpenMesh::Vec3f& color)
{
    keepColor(vertex, {color[0], color[1], color[2], 1.0f});
}

void OpenMeshSoup::set_color(OpenMesh::VertexHandle vertex, const OpenMesh::Vec4f& color)
{
    keepColor(vertex, {color[0], color[1], color[2], color[3]});
}

void OpenMeshSoup::set_texcoord(OpenMesh::VertexHandle vertex, const OpenMesh::Vec2f& uv)
{
    soup_.uvs.resize(soup_.positions.size(), glm::vec2(0.0f));
    soup_.uvs[indexOf(vertex)] = imageUv(uv[0], uv[1]);
    isMapped_.resize(soup_.positions.size(), false);
    isMapped_[indexOf(vertex)] = true;
}

void OpenMeshSoup::set_texcoord(OpenMesh::VertexHandle vertex, const OpenMesh::Vec3f& uv)
{
    set_texcoord(vertex, OpenMesh::Vec2f(uv[0], uv[1]));
}

OpenMesh::HalfedgeHandle OpenMeshSoup::add_edge(OpenMesh::VertexHandle, OpenMesh::VertexHandle)
{
    return OpenMesh::HalfedgeHandle();
}

OpenMesh::FaceHandle OpenMeshSoup::add_face(OpenMesh::HalfedgeHandle)
{
    return OpenMesh::FaceHandle();
}

Soup OpenMeshSoup::take(const MaskInputs& read, Diagnostics& diagnostics, const PartName& partOf)
{
    finishColors(diagnostics);
    noteGaps(read, partOf);
    const std::size_t vertices = soup_.positions.size();
    soup_.normals.resize(vertices, glm::vec3(0.0f));
    for (std::size_t i = 0; i < normalsDisagree_.size(); ++i)
        if (normalsDisagree_[i])
            soup_.normals[i] = glm::vec3(0.0f); // topology computes it and finds edges
    soup_.uvs.resize(vertices, glm::vec2(0.0f));
    soup_.colors.resize(vertices, glm::vec4(1.0f));
    if (cornerUvs_.empty())
        return std::move(soup_);

    // Split a vertex whose triangles have different texture coordinates.
    cornerUvs_.resize(3 * soup_.triangles.size(), glm::vec2(0.0f));
    std::vector<bool> taken(vertices, false);
    std::map<std::tuple<std::uint32_t, float, float>, std::uint32_t> copies;
    for (std::size_t i = 0; i < cornerUvs_.size(); ++i) {
        std::uint32_t& corner = soup_.triangles[i / 3][int(i % 3)];
        const glm::vec2 uv = cornerUvs_[i];
        if (!taken[corner]) {
            taken[corner] = true;
            soup_.uvs[corner] = uv;
        }
        if (soup_.uvs[corner] == uv)
            continue;
        const auto next = static_cast<std::uint32_t>(soup_.positions.size());
        const auto [copy, isNew] = copies.try_emplace({corner, uv.x, uv.y}, next);
        if (isNew) {
            soup_.positions.push_back(glm::dvec3(soup_.positions[corner]));
            soup_.normals.push_back(glm::vec3(soup_.normals[corner]));
            soup_.colors.push_back(glm::vec4(soup_.colors[corner]));
            soup_.uvs.push_back(uv);
        }
        corner = copy->second;
    }
    return std::move(soup_);
}

} // namespace sward::terrain
