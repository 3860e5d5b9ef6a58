#pragma once

#include "terrain/ground_mesh.h"

#include <glm/vec3.hpp>

#include <array>
#include <vector>

namespace sward::terrain {

/// An edge at which the normal jumps, seen from the side of the ground where it is convex. Relative
/// to the ground's origin [m].
struct ConvexCrease {
    glm::vec3 from{0.0f};
    glm::vec3 to{0.0f};
    std::array<glm::vec3, 2> normals{}; ///< unit, of the ground on either side of the edge
};

/// Sides of the triangles from which an edge is seen.
struct CreaseSides {
    bool front = true;
    bool back = false; ///< an edge that is concave on the front is convex on the back
};

/// The convex creases beside bearing triangles: edges of two triangles whose vertex normals differ
/// by 25.8° to 154°. Vertices of equal position count as one. A mesh without split vertices, such as
/// a heightmap, has none. In an order that depends on the mesh alone.
std::vector<ConvexCrease> convexCreases(const GroundMesh& mesh, CreaseSides sides = {});

} // namespace sward::terrain
