#pragma once

#include "bake/ground/root_sample.h"
#include "core/progress.h"
#include "terrain/ground_mesh.h"

#include <cstdint>
#include <vector>

namespace sward::bake {

/// Computes a sort key for each root. Sorted by it, the roots are in progressive order: every
/// prefix, of the whole and of any part of space, is itself evenly spread (relative radius at least
/// 0.55 if the roots are Poisson-disk samples). Roots are chosen level by level. The minimum
/// distance of chosen roots falls from 2 m by the fourth root of two per level. Within a level, a
/// hash of the keys orders them.
///
/// The levels use lattices of 32 m, 4 m, 0.5 m … cubes aligned with the patch tree. So the order in
/// a 32 m cell depends only on roots within progressiveReach of the cell.
///
/// After a share `evenUpTo` of the roots, the rest follows in random order: they are close
/// neighbours of others. Throws Error{interrupted} if `progress` is cancelled meanwhile.
std::vector<std::uint64_t> progressiveOrder(const terrain::GroundMesh& ground, const Roots& roots,
                                            double evenUpTo, const Progress* progress = nullptr);

/// Poisson disks are even up to more than half; random roots are not even at a half.
inline constexpr double evenPoissonShare = 0.6;
inline constexpr double evenUniformShare = 0.3;

inline constexpr double progressiveReach = 9.0; ///< [m]

} // namespace sward::bake
