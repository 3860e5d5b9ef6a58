#pragma once

#include "shaders/shared/species.h"
#include "trace/blade_poses.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

namespace sward::trace {

// A blade as a strip of flat quadrilaterals: rows of points across it, straight from row to row.
//
// Rows lie on the curve of the blade, and their edges are those of shared::outlineAt(), at full
// width and with the full fold. Between rows the outline is off by at most `outlineError`, and the
// curve by at most `curveError`.

/// Largest error of half the width between rows, in widths of the blade. A dandelion's leaf, whose
/// outline has vertical tangents between its lobes, is within 0.06.
inline constexpr float outlineError = 0.005f;

/// Largest distance between the curve and its chords, in widths of the blade; where a blade is so
/// narrow or so bent that this needs more than maxRows rows, it grows to what those have.
inline constexpr float curveError = 0.1f;

/// Largest number of rows of a blade.
inline constexpr std::uint32_t maxRows = 65;

/// Places along the blade, from 0 to 1, where its rows lie. `width` [m] is that of an outline of 1.
std::vector<float> rowsOf(const shared::Species& look, const BladePose& pose, float width);

/// The points of a row.
struct BladeRow {
    glm::vec3 left{0.0f};  ///< [m]
    glm::vec3 ridge{0.0f}; ///< the middle, raised by the fold
    glm::vec3 right{0.0f}; ///< [m]
};

/// The row at `along` [0, 1].
BladeRow rowAt(const shared::Species& look, const BladePose& pose, float width, float along);

} // namespace sward::trace
