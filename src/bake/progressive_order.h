#pragma once

#include "bake/root_sample.h"
#include "terrain/ground_mesh.h"

#include <cstdint>
#include <vector>

namespace sward::bake {

/// A number for each root by which the roots, sorted, are in progressive order: every prefix, of
/// the whole and of any part of space, is itself evenly spread (relative radius at least 0.55 where
/// the roots are Poisson-disk samples). Roots are chosen level by level, the radius that chosen
/// ones keep from one another falling from 2 m by the fourth root of two; within a level by a hash
/// of their keys.
///
/// The levels run over lattices of 32 m, 4 m, 0.5 m … cubes whose planes are planes of the patch
/// tree, so the order of the roots in a 32 m cell depends on nothing farther from the cell than
/// progressiveReach.
///
/// Where a share `evenUpTo` of the roots has been chosen the rest follows at random: they are close
/// neighbours of others.
std::vector<std::uint64_t> progressiveOrder(const terrain::GroundMesh& ground, const Roots& roots,
                                            double evenUpTo);

/// Poisson disks are even up to more than half of them; of roots spread by chance a half cannot be.
inline constexpr double evenPoissonShare = 0.6;
inline constexpr double evenUniformShare = 0.3;

inline constexpr double progressiveReach = 9.0; ///< [m]

} // namespace sward::bake
