#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace sward::gpu {

/// A SPIR-V module whose floating-point operations are each rounded by themselves: every one of them
/// gets the decoration NoContraction. Without it a driver may fuse a product and a sum, and results
/// differ from those of a CPU and of other drivers. `words`: a valid module.
std::vector<std::uint32_t> withoutContraction(std::span<const std::uint32_t> words);

} // namespace sward::gpu
