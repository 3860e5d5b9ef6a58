#pragma once

#include "core/diagnostics.h"
#include "terrain/mesh_files/polygon.h"
#include "terrain/topology/soup.h"

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace sward::terrain {

/// Gathers what a reader of polygons finds and keeps all faces, non-manifold ones too. Texture
/// coordinates are given with (0, 0) in the lower left. Vertices are numbered from 0.
class PolygonSoup {
public:
    explicit PolygonSoup(std::string place)
        : place_(std::move(place))
    {
    }

    std::size_t vertices() const { return soup_.positions.size(); }
    std::size_t faces() const { return faces_; } ///< of any number of corners

    /// Adds a vertex.
    void addVertex(const glm::dvec3& position) { soup_.positions.push_back(position); }

    /// Adds a face of vertices that exist, divided by triangulate(); one of fewer than three
    /// corners is counted and left out. `uvs` has an entry for each corner, or none.
    void addFace(std::span<const std::uint32_t> corners, std::span<const glm::vec2> uvs = {});

    // Each sets what belongs to a vertex. Different normals at one vertex are an edge: topology
    // makes its normals. What is not finite is 0.
    void setNormal(std::size_t vertex, const glm::vec3& normal);
    void setColor(std::size_t vertex, const glm::vec4& color);
    void setUv(std::size_t vertex, const glm::vec2& uv);

    /// Throws Error{input} if there is no triangle. Warns of polygons whose edges cross and of
    /// faces that were left out.
    void finishFaces(Diagnostics& diagnostics) const;

    /// The soup; texture coordinates have (0, 0) in the upper left, colours are brought into
    /// [0, 1]. Notes triangles without attributes that masks `read`, of the part that
    /// `partOf(face)` names; without it, of the whole file.
    using PartName = std::function<std::string(std::uint32_t)>;
    Soup take(const MaskInputs& read, Diagnostics& diagnostics, const PartName& partOf = {});

    /// Per triangle, the number of its face in the file.
    const std::vector<std::uint32_t>& faceOf() const { return faceOf_; }

    const std::vector<glm::dvec3>& positions() const { return soup_.positions; }

private:
    void finishColors(Diagnostics& diagnostics);
    void noteGaps(const MaskInputs& read, const PartName& partOf);

    std::string place_;
    Soup soup_;
    std::size_t faces_ = 0;
    std::vector<std::uint32_t> faceOf_;
    std::vector<bool> normalsDisagree_;  // per vertex with a normal
    std::vector<bool> isColored_;        // per vertex; empty until the first colour
    std::vector<bool> isMapped_;         // per vertex with texture coordinates of its own
    std::vector<bool> isFaceMapped_;     // per triangle with texture coordinates of its corners
    std::vector<glm::vec2> cornerUvs_;   // three to a triangle; empty until the first
    std::vector<glm::dvec3> places_;     // of the corners of a face
    std::vector<PolygonTriangle> parts_; // of a face
    std::size_t crossedFaces_ = 0;
    std::size_t firstCrossed_ = 0;
    std::size_t longFaces_ = 0; // with more corners than ears are clipped of
    std::size_t firstLong_ = 0;
    std::size_t shortFaces_ = 0;
    std::size_t firstShort_ = 0;
};

} // namespace sward::terrain
