#pragma once

#include "field/field.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sward::test {

/// Ground of a generated field.
enum class Surface {
    cloud,  ///< anywhere in a cube, with up-vectors of every direction; no ground is drawn
    plane,  ///< a square at height 0
    sphere, ///< a ball around the origin
};

/// A field generated without a bake, for tests of later stages.
struct FieldSettings {
    Surface surface = Surface::plane;
    std::size_t blades = 4096;
    float extent = 10.0f; ///< [m] side of the cube or square, diameter of the ball
    float heightLow = 0.35f;
    float heightHigh = 0.75f; ///< [m]
    float widthLow = 0.012f;
    float widthHigh = 0.022f; ///< [m]
    bool hasGround = true;    ///< drawn beneath plane and sphere
    glm::dvec3 origin{0.0};
    std::uint64_t seed = 1;
};

/// A valid field: an octree of patches, blades in progressive (random) order, one species, one
/// material. Heights, widths, stiffness, colours, clumps and directions are random, too.
field::Field makeField(const FieldSettings& settings);

/// A few blades on ground of 10 m.
field::Field smallGround(Surface surface);

/// A field of these blades under an octree over the cube that begins at `low`, with `size` [m]
/// edges. They come in progressive order. Blade i has key i of `keys`.
field::Field treeOf(const std::vector<shared::Blade>& blades,
                    const std::vector<field::BladeKey>& keys, glm::vec3 low, float size);

/// A field without blades and without ground.
field::Field emptyField();

} // namespace sward::test
