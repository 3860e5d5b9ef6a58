#pragma once

#include "field/field.h"
#include "shaders/shared/cover.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sward::field {

/// Maximum corners of the grid along its longest axis.
constexpr std::uint32_t maxCoverCorners = 128;

/// Maximum blades read for the grid; of larger fields some of each patch.
constexpr std::size_t maxCoverBlades = std::size_t(1) << 20;

/// The grass of a field at the corners of a grid; see shared::Cover. The table is unset.
struct LeafAreaGrid {
    shared::Cover shape = {};
    float meanHeight = 0.0f; ///< [m] of the blades, which the values' heights are relative to
    std::vector<std::uint32_t> values; ///< shared::packGrass()

    /// A view for shared functions on the CPU; valid as long as the grid.
    shared::Cover view() const;
};

/// m² of blade (one side, upright) per m² of ground. Blades and ground are distributed to the eight
/// corners around them, then divided. The integral over the ground is the blades' area; without a
/// blade within a cell the value is 0. A cell's edge is at least half the mean blade height, the
/// range at which grass darkens.
LeafAreaGrid leafAreaOf(const FieldView& field);

/// shared::packGrass() of a corner: [m²] of leaves there, that times the height [m] of their
/// blades, and that times their tone; and [m²] of ground. Heights within a fifth of the field's
/// mean count as the mean.
std::uint32_t grassOf(glm::vec3 leaves, float ground, float meanHeight);

/// Its grid, also for a field without blades.
shared::Cover coverShapeOf(const FieldView& field);

/// m² of ground at the corners of the grid, never 0; at convex edges, of the surface half a mean
/// blade above the ground.
std::vector<float> groundAreasOf(const FieldView& field, const shared::Cover& shape);

/// Colours and structure of the ground under a field's grass: members undergrowth, sward, thinned
/// and structure.
void describeUndergrowth(const FieldView& field, shared::Cover& cover);

/// Members undergrowth and sward, from the mean colours of roots and tips.
void colorUndergrowth(const glm::vec3& root, const glm::vec3& tip, shared::Cover& cover);

} // namespace sward::field
