#pragma once

#include "terrain/ground_mesh.h"

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace sward::terrain {

/// Imported ground in file space and double precision. Arrays are as in GroundMesh, but normals,
/// uvs and colors may be shorter than positions; missing entries have the default value named here.
struct Soup {
    std::vector<glm::dvec3> positions;
    std::vector<glm::vec3> normals; ///< of any length; (0, 0, 0): the file has none
    std::vector<glm::vec2> uvs;     ///< (0, 0)
    std::vector<glm::vec4> colors;  ///< (1, 1, 1, 1)
    VertexAttributes attributes;    ///< values may be shorter, as of the arrays above

    std::vector<glm::uvec3> triangles;
    std::vector<std::uint32_t> materialOf;
    std::vector<std::uint32_t> nodeOf;

    std::vector<GroundMaterial> materials;
    std::vector<GroundImage> images;
    std::vector<std::string> nodes;
    std::string copyright;
    bool hasColors = false;

    /// Distance [m] between vertices that may be one and the same, rounded twice: the step of its
    /// coordinates, of decimals or single precision. 0: all are exact.
    double precision = 0.0;
};

/// A mesh as a soup in world space. Roles are not kept.
Soup soupOf(const GroundMesh& mesh);

/// Transforms positions by the affine `matrix` and normals by its inverse transpose. A mirroring
/// matrix flips the triangles, so that fronts stay fronts. Starts at the given vertex and triangle.
void transform(Soup& soup, const glm::dmat4& matrix, std::size_t firstVertex = 0,
               std::size_t firstTriangle = 0);

/// Converts a soup in world space to ground: drops unused vertices, recentres in double precision
/// before rounding, and computes missing normals. Everything bears grass. Throws Error{input}
/// naming `place` as validate() does.
GroundMesh settle(Soup&& soup, const std::string& place);

} // namespace sward::terrain
