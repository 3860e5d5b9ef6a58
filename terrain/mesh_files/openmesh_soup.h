#pragma once

#include "core/diagnostics.h"
#include "terrain/mesh_files/polygon.h"
#include "terrain/topology/soup.h"

#include <OpenMesh/Core/IO/importer/BaseImporter.hh>

#include <functional>
#include <string>

namespace sward::terrain {

/// Receives the output of OpenMesh's readers and keeps all faces: a half-edge mesh would reject or
/// split non-manifold ones. Included by mesh_import.cpp only.
class OpenMeshSoup final : public OpenMesh::IO::BaseImporter {
public:
    explicit OpenMeshSoup(std::string place)
        : place_(std::move(place))
    {
    }

    /// The soup read so far; polygons are divided by triangulate(). Texture coordinates have (0, 0)
    /// in the upper left, colours are brought into [0, 1]. Notes triangles without attributes that
    /// masks `read`, of the part that `partOf(face)` names; without it, of the whole file.
    using PartName = std::function<std::string(std::uint32_t)>;
    Soup take(const MaskInputs& read, Diagnostics& diagnostics, const PartName& partOf = {});

    /// Replaces the colours, one to a vertex.
    void setColors(const std::vector<glm::vec4>& colors);

    /// Texture coordinates of the corners of faces that come after, in order; empty for a face
    /// without. (0, 0) is in the lower left.
    void expectFaceUvs(std::vector<std::vector<glm::vec2>> uvs) { faceUvs_ = std::move(uvs); }

    /// The current content, one vertex per vertex of the file.
    Soup& soup() { return soup_; }

    std::size_t facesSeen() const { return faces_; }

    /// Warns of polygons whose edges cross.
    void warnOfCrossed(Diagnostics& diagnostics) const;

    /// Per triangle, the number of its face in the file.
    const std::vector<std::uint32_t>& faceOf() const { return faceOf_; }

    OpenMesh::VertexHandle add_vertex(const OpenMesh::Vec3f& point) override;
    OpenMesh::VertexHandle add_vertex() override;
    void set_point(OpenMesh::VertexHandle vertex, const OpenMesh::Vec3f& point) override;
    OpenMesh::FaceHandle add_face(const VHandles& corners) override;
    void add_face_texcoords(OpenMesh::FaceHandle face, OpenMesh::VertexHandle first,
                            const std::vector<OpenMesh::Vec2f>& uvs) override;
    void set_normal(OpenMesh::VertexHandle vertex, const OpenMesh::Vec3f& normal) override;
    void set_normal(OpenMesh::VertexHandle vertex, const OpenMesh::Vec3d& normal) override;
    void set_color(OpenMesh::VertexHandle vertex, const OpenMesh::Vec3uc& color) override;
    void set_color(OpenMesh::VertexHandle vertex, const OpenMesh::Vec4uc& color) override;
    void set_color(OpenMesh::VertexHandle vertex, const OpenMesh::Vec3f& color) override;
    void set_color(OpenMesh::VertexHandle vertex, const OpenMesh::Vec4f& color) override;
    void set_texcoord(OpenMesh::VertexHandle vertex, const OpenMesh::Vec2f& uv) override;
    void set_texcoord(OpenMesh::VertexHandle vertex, const OpenMesh::Vec3f& uv) override;
    size_t n_vertices() const override { return soup_.positions.size(); }
    size_t n_faces() const override { return faces_; }
    size_t n_edges() const override { return 0; }

    // Callbacks without a counterpart in the soup.
    OpenMesh::HalfedgeHandle add_edge(OpenMesh::VertexHandle, OpenMesh::VertexHandle) override;
    OpenMesh::FaceHandle add_face(OpenMesh::HalfedgeHandle) override;
    void add_face_texcoords(OpenMesh::FaceHandle, OpenMesh::VertexHandle,
                            const std::vector<OpenMesh::Vec3f>&) override
    {
    }
    void set_face_texindex(OpenMesh::FaceHandle, int) override {}
    void set_halfedge(OpenMesh::VertexHandle, OpenMesh::HalfedgeHandle) override {}
    void set_status(OpenMesh::VertexHandle, const OpenMesh::Attributes::StatusInfo&) override {}
    void set_next(OpenMesh::HalfedgeHandle, OpenMesh::HalfedgeHandle) override {}
    void set_face(OpenMesh::HalfedgeHandle, OpenMesh::FaceHandle) override {}
    void request_face_texcoords2D() override {}
    void set_texcoord(OpenMesh::HalfedgeHandle, const OpenMesh::Vec2f&) override {}
    void set_texcoord(OpenMesh::HalfedgeHandle, const OpenMesh::Vec3f&) override {}
    void set_status(OpenMesh::HalfedgeHandle, const OpenMesh::Attributes::StatusInfo&) override {}
    void set_color(OpenMesh::EdgeHandle, const OpenMesh::Vec3uc&) override {}
    void set_color(OpenMesh::EdgeHandle, const OpenMesh::Vec4uc&) override {}
    void set_color(OpenMesh::EdgeHandle, const OpenMesh::Vec3f&) override {}
    void set_color(OpenMesh::EdgeHandle, const OpenMesh::Vec4f&) override {}
    void set_status(OpenMesh::EdgeHandle, const OpenMesh::Attributes::StatusInfo&) override {}
    void set_normal(OpenMesh::FaceHandle, const OpenMesh::Vec3f&) override {}
    void set_normal(OpenMesh::FaceHandle, const OpenMesh::Vec3d&) override {}
    void set_color(OpenMesh::FaceHandle, const OpenMesh::Vec3uc&) override {}
    void set_color(OpenMesh::FaceHandle, const OpenMesh::Vec4uc&) override {}
    void set_color(OpenMesh::FaceHandle, const OpenMesh::Vec3f&) override {}
    void set_color(OpenMesh::FaceHandle, const OpenMesh::Vec4f&) override {}
    void set_status(OpenMesh::FaceHandle, const OpenMesh::Attributes::StatusInfo&) override {}
    void add_texture_information(int, std::string) override {}

private:
    std::size_t indexOf(OpenMesh::VertexHandle vertex) const;
    void keepColor(OpenMesh::VertexHandle vertex, const glm::vec4& color);
    void finishColors(Diagnostics& diagnostics);
    void noteGaps(const MaskInputs& read, const PartName& partOf);

    std::string place_;
    Soup soup_;
    std::size_t faces_ = 0;
    std::vector<std::uint32_t> faceOf_;
    std::vector<bool> normalsDisagree_; // per vertex with a normal
    std::vector<bool> isColored_;       // per vertex; empty until the first colour
    std::vector<bool> isMapped_;        // per vertex with texture coordinates of its own
    std::vector<bool> isFaceMapped_;    // per triangle with texture coordinates of its corners
    std::vector<std::vector<glm::vec2>> faceUvs_; // per face to come
    std::size_t firstTriangle_ = 0;               // of the last face
    std::vector<glm::vec2> cornerUvs_;            // three to a triangle; empty until the first
    std::vector<std::uint32_t> corners_;          // of the last face
    std::vector<glm::dvec3> places_;              // of its corners
    std::vector<PolygonTriangle> parts_;          // of the last face
    std::size_t crossedFaces_ = 0;
    std::size_t firstCrossed_ = 0;
};

} // namespace sward::terrain
