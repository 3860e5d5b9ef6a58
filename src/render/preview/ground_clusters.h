#pragma once

#include "shaders/shared/ground.h"

#include <cstdint>
#include <span>
#include <vector>

namespace sward::render {

/// Sorts the triangles of `indices` so that neighbours in space follow one another. Deterministic.
void sortTriangles(std::span<const shared::GroundVertex> corners, std::span<std::uint32_t> indices);

/// Cuts the triangles of `indices`, all of one material, into clusters of shared::clusterTriangles;
/// the last may have fewer.
std::vector<shared::GroundCluster> clustersOf(std::span<const shared::GroundVertex> corners,
                                              std::span<const std::uint32_t> indices,
                                              std::uint32_t material);

} // namespace sward::render
