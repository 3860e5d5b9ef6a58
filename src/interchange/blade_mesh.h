#pragma once

#include "field/field.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

namespace sward::interchange {

/// The blade of one species as triangles: a ribbon along the Bézier curve of shared/physics.h. It
/// starts at the origin, grows along +Y and leans to +Z; its curve is one long and its root, along
/// X, one wide, so that a scale of (width, height, height) makes a blade of it.
struct BladeMesh {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;     ///< unit; the side that looks to +Z
    std::vector<glm::vec2> uvs;         ///< across from left, along from the root
    std::vector<glm::vec3> colors;      ///< linear, [0, 1], to be multiplied by `baseColor`
    glm::vec3 baseColor{1.0f};          ///< linear: the larger of root and tip colour per channel
    std::vector<std::uint32_t> indices; ///< triangles, counter-clockwise seen from +Z
};

/// Rows of quads of a ribbon of this shape.
std::uint32_t bladeSegments(std::uint32_t shape);

/// The mesh of `species` as a blade of `stiffness` [0, 1] rests on level ground: no wind, gravity
/// and recovery as the field's defaults have them. Outline and fold are the species'.
BladeMesh bladeMesh(const shared::Species& species, const field::Defaults& defaults,
                    float stiffness);

} // namespace sward::interchange
