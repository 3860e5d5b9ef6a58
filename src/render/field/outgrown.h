#pragma once

#include "gpu/buffer.h"

#include <vulkan/vulkan.h>

#include <vector>

namespace sward::render {

/// A buffer that another one replaces, which has room for more.
struct Outgrown {
    gpu::Buffer former;           ///< to be destroyed when no frame in flight uses it
    VkBuffer now = VK_NULL_HANDLE; ///< gets the former bytes; null: they are not wanted
};

/// Replaced buffers, in the order of their replacements.
using OutgrownBuffers = std::vector<Outgrown>;

} // namespace sward::render
