#pragma once

#include <vulkan/vulkan.h>

namespace sward::gpu {

// The Vulkan functions that passes and gpu objects call, without the prefix "vk". Functions that
// only a program with its own device needs are linked instead.
// clang-format off
#define SWARD_DEVICE_FUNCTIONS(each)                                                               \
    each(AllocateMemory) each(FreeMemory) each(MapMemory)                                          \
    each(BindBufferMemory) each(BindImageMemory)                                                   \
    each(GetBufferMemoryRequirements) each(GetImageMemoryRequirements)                             \
    each(CreateBuffer) each(DestroyBuffer) each(GetBufferDeviceAddress)                            \
    each(CreateImage) each(DestroyImage) each(CreateImageView) each(DestroyImageView)              \
    each(CreateSampler) each(DestroySampler)                                                       \
    each(CreateShaderModule) each(DestroyShaderModule)                                             \
    each(CreatePipelineLayout) each(DestroyPipelineLayout)                                         \
    each(CreateComputePipelines) each(CreateGraphicsPipelines) each(DestroyPipeline)               \
    each(CreateDescriptorSetLayout) each(DestroyDescriptorSetLayout)                               \
    each(CreateDescriptorPool) each(DestroyDescriptorPool)                                         \
    each(AllocateDescriptorSets) each(UpdateDescriptorSets)                                        \
    each(CreateCommandPool) each(DestroyCommandPool) each(AllocateCommandBuffers)                  \
    each(ResetCommandBuffer) each(BeginCommandBuffer) each(EndCommandBuffer) each(QueueSubmit2)    \
    each(WaitSemaphores) each(GetSemaphoreCounterValue)                                            \
    each(CreateFence) each(DestroyFence) each(CreateSemaphore) each(DestroySemaphore)              \
    each(CreateQueryPool) each(DestroyQueryPool)                                                   \
    each(CmdBindPipeline) each(CmdBindDescriptorSets) each(CmdPushConstants)                       \
    each(CmdDispatch) each(CmdDispatchIndirect) each(CmdDraw) each(CmdDrawIndirect)                \
    each(CmdDrawIndexed) each(CmdDrawIndexedIndirectCount) each(CmdBindIndexBuffer)                \
    each(CmdBeginRendering) each(CmdEndRendering) each(CmdSetViewport) each(CmdSetScissor)         \
    each(CmdCopyBuffer) each(CmdFillBuffer) each(CmdUpdateBuffer) each(CmdCopyImage)               \
    each(CmdCopyImageToBuffer) each(CmdCopyBufferToImage) each(CmdBlitImage)                         \
    each(CmdResetQueryPool) each(CmdWriteTimestamp2) each(GetQueryPoolResults)                     \
    each(ResetFences) each(WaitForFences) each(CmdPipelineBarrier2) each(DeviceWaitIdle)
// clang-format on

/// The functions of one device.
struct DeviceFunctions {
#define SWARD_DEVICE_FUNCTION(name) PFN_vk##name name = nullptr;
    SWARD_DEVICE_FUNCTIONS(SWARD_DEVICE_FUNCTION)
#undef SWARD_DEVICE_FUNCTION
};

/// The functions of the loader that the program is linked with.
const DeviceFunctions& linkedFunctions();

/// Loads the functions from a device. Throws Error{unsupported} that names a missing one.
DeviceFunctions loadFunctions(VkDevice device, PFN_vkGetDeviceProcAddr getDeviceProcAddr);

} // namespace sward::gpu
