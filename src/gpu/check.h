#pragma once

#include <vulkan/vulkan.h>

#include <source_location>

namespace sward::gpu {

/// Turns every result but VK_SUCCESS into an Error that names `call` and the result: {unsupported}
/// for what the driver does not have, {runtime} for the rest (device lost, out of memory).
void check(VkResult result, const char* call,
           std::source_location where = std::source_location::current());

} // namespace sward::gpu
