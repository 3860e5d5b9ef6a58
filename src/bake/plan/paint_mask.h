#pragma once

#include "bake/settings/settings.h"
#include "core/diagnostics.h"
#include "core/progress.h"
#include "terrain/ground_mesh.h"

#include <cstdint>
#include <vector>

namespace sward::bake {

/// Largest side of a paint mask, in texels.
inline constexpr std::uint32_t maxPaintMaskSize = 8192;

/// The strokes and masks of a bake as a square image over the ground's texture coordinates.
struct PaintMask {
    std::uint32_t size = 0;           ///< texels on a side
    std::vector<std::uint8_t> values; ///< rows from the top; 255: the density of the bake
    std::uint64_t covered = 0;        ///< texels whose middle lies on bearing ground
    std::uint64_t clipped = 0;        ///< of these, those whose density is above 1
    std::uint64_t overlapping = 0;    ///< of these, those under several triangles
};

/// What importers have to keep for paintMask(): the coordinates of Mask::Source::texture.
void addPaintMaskInputs(terrain::MaskInputs& inputs);

/// Evaluates the strokes over the product of the masks, without filters and habitats, at the middle
/// of each texel. A texel under several triangles takes the first; one within 2 texels of a
/// triangle, the triangle's nearest point; all others are 0. Of ground that bears on both sides, it
/// is the front. Masks must be loaded. Warns of clipped and overlapping texels. Throws Error{input}
/// if bearing ground lacks texture coordinates, or one of its triangles spans more than a whole
/// image; Error{interrupted} when cancelled. The same for any number of threads.
PaintMask paintMask(const terrain::GroundMesh& ground, const BakeSettings& settings,
                    std::uint32_t size, int threads, Diagnostics& diagnostics, Progress& progress);

} // namespace sward::bake
