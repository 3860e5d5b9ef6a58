#pragma once

#include "gpu/context/context.h"
#include "gpu/context/device_functions.h"

#include <vulkan/vulkan.h>

namespace sward::gpu {

/// A command buffer in recording state, with the functions that record into it.
class Recording {
public:
    /// Uses the functions of the context's device.
    Recording(const DeviceContext& context, VkCommandBuffer commands)
        : vk(&context.vk)
        , commands_(commands)
    {
    }

    /// Uses the linked functions. Implicit, since both are the same unless a host brings its own
    /// loader.
    Recording(VkCommandBuffer commands)
        : vk(&linkedFunctions())
        , commands_(commands)
    {
    }

    operator VkCommandBuffer() const { return commands_; }

    const DeviceFunctions* vk;

private:
    VkCommandBuffer commands_;
};

} // namespace sward::gpu
