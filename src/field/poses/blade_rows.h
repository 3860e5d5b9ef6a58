#pragma once

#include "field/poses/blade_poses.h"
#include "shaders/shared/species.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

namespace sward::field {

// A blade as a strip of flat quadrilaterals: rows of points across it, straight from row to row.
//
// Rows lie on the curve of the blade, and their edges are those of shared::outlineAt(), at full
// width and with the full fold. Between rows outline and curve are off by at most chosen distances.

/// Largest distances between rows, in widths of the blade.
struct RowErrors {
    float curve = 0.05f;    ///< > 0; between the curve and its chords
    float outline = 0.005f; ///< > 0; of an edge. A dandelion's leaf, whose outline has vertical
                            ///< tangents between its lobes, is within 0.06.
};

/// Largest number of segments of a blade's curve.
inline constexpr std::uint32_t maxSegments = 64;

/// Places along the blade, from 0 to 1, where its rows lie. `width` [m] is that of an outline of 1.
/// A blade so narrow or so bent that its curve needs more than maxSegments has the error of those.
std::vector<float> rowsOf(const shared::Species& look, const BladePose& pose, float width,
                          const RowErrors& errors = {});

/// The points of a row.
struct BladeRow {
    glm::vec3 left{0.0f};  ///< [m]
    glm::vec3 ridge{0.0f}; ///< the middle, raised by the fold
    glm::vec3 right{0.0f}; ///< [m]
};

/// The row at `along` [0, 1].
BladeRow rowAt(const shared::Species& look, const BladePose& pose, float width, float along);

} // namespace sward::field
