#pragma once

#include "shaders/shared/ground.h"

#include <cstdint>
#include <span>
#include <vector>

namespace sward::render {

/// Triangles of a cluster, but for the last one of a part.
inline constexpr std::uint32_t clusterTriangles = 256;

/// Puts the triangles that `indices` name into an order in which neighbours in space follow one
/// another, and cuts them into clusters. Their `firstIndex` begins at `firstIndex`. The same input
/// has the same result.
std::vector<shared::GroundCluster> clusterTrianglesOf(std::span<const shared::GroundVertex> corners,
                                                      std::span<std::uint32_t> indices,
                                                      std::uint32_t firstIndex);

} // namespace sward::render
