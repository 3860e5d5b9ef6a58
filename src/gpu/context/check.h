#pragma once

#include <vulkan/vulkan.h>

#include <source_location>

namespace sward::gpu {

/// Throws an Error that names `call` and the result, unless it is VK_SUCCESS: {unsupported} if the
/// driver lacks something, {runtime} for the rest (device lost, out of memory).
void check(VkResult result, const char* call,
           std::source_location where = std::source_location::current());

} // namespace sward::gpu
