#pragma once

#include "shaders/shared/ground.h"

#include <cstdint>
#include <span>
#include <vector>

namespace sward::render {

/// Puts the triangles that `indices` name into an order in which neighbours in space follow one
/// another. The same input has the same result.
void sortTriangles(std::span<const shared::GroundVertex> corners, std::span<std::uint32_t> indices);

/// Cuts the triangles that `indices` name, all of one material, into clusters of
/// shared::clusterTriangles, the last one of fewer.
std::vector<shared::GroundCluster> clustersOf(std::span<const shared::GroundVertex> corners,
                                              std::span<const std::uint32_t> indices,
                                              std::uint32_t material);

} // namespace sward::render
