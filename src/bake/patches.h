#pragma once

#include "bake/root_sample.h"
#include "core/progress.h"
#include "shaders/shared/blade.h"
#include "shaders/shared/patch.h"

#include <cstdint>
#include <vector>

namespace sward::bake {

/// Widest cell that owns blades [m]: its roots are kept to 32 / 65535 m.
inline constexpr double widestPatch = 32.0;

/// The patch tree and, for each place in the field, which blade stands there.
struct PatchTree {
    std::vector<shared::Patch> patches;    ///< level by level; parents before children
    std::vector<std::uint32_t> bladeOrder; ///< index into the blades, patch after patch
};

/// Groups blades into the cells of an octree fixed in the world (`origin` is a multiple of 32 m).
/// From the top, a cell of at most 32 m takes up to 256 of its blades, evenly spread, for itself;
/// what is left goes to its children. Cells with a single child and no blades are left out.
PatchTree buildPatches(const std::vector<shared::Blade>& blades, const terrain::GroundMesh& ground,
                       const Roots& roots, Progress& progress);

} // namespace sward::bake
