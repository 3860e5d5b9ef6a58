#pragma once

#include "gpu/context.h"
#include "gpu/device_functions.h"

#include <vulkan/vulkan.h>

namespace sward::gpu {

/// A command buffer that is being recorded, and the functions that record.
class Recording {
public:
    /// By the functions of its device.
    Recording(const DeviceContext& context, VkCommandBuffer commands)
        : vk(&context.vk)
        , commands_(commands)
    {
    }

    /// By those that the program is linked with. Implicit: it is the same where nobody has brought
    /// a loader of their own.
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
