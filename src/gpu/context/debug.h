#pragma once

#include "gpu/context/context.h"

#include <vulkan/vulkan.h>

#include <cstdint>
#include <string>

namespace sward::gpu {

/// Vulkan's enumerator for a type of object.
template <typename Handle>
constexpr VkObjectType objectType = VK_OBJECT_TYPE_UNKNOWN;
template <>
inline constexpr VkObjectType objectType<VkQueue> = VK_OBJECT_TYPE_QUEUE;
template <>
inline constexpr VkObjectType objectType<VkBuffer> = VK_OBJECT_TYPE_BUFFER;
template <>
inline constexpr VkObjectType objectType<VkImage> = VK_OBJECT_TYPE_IMAGE;
template <>
inline constexpr VkObjectType objectType<VkImageView> = VK_OBJECT_TYPE_IMAGE_VIEW;
template <>
inline constexpr VkObjectType objectType<VkSampler> = VK_OBJECT_TYPE_SAMPLER;
template <>
inline constexpr VkObjectType objectType<VkDeviceMemory> = VK_OBJECT_TYPE_DEVICE_MEMORY;
template <>
inline constexpr VkObjectType objectType<VkShaderModule> = VK_OBJECT_TYPE_SHADER_MODULE;
template <>
inline constexpr VkObjectType objectType<VkPipelineLayout> = VK_OBJECT_TYPE_PIPELINE_LAYOUT;
template <>
inline constexpr VkObjectType objectType<VkPipeline> = VK_OBJECT_TYPE_PIPELINE;
template <>
inline constexpr VkObjectType objectType<VkDescriptorSet> = VK_OBJECT_TYPE_DESCRIPTOR_SET;
template <>
inline constexpr VkObjectType objectType<VkDescriptorSetLayout> =
    VK_OBJECT_TYPE_DESCRIPTOR_SET_LAYOUT;
template <>
inline constexpr VkObjectType objectType<VkCommandBuffer> = VK_OBJECT_TYPE_COMMAND_BUFFER;
template <>
inline constexpr VkObjectType objectType<VkQueryPool> = VK_OBJECT_TYPE_QUERY_POOL;
template <>
inline constexpr VkObjectType objectType<VkSemaphore> = VK_OBJECT_TYPE_SEMAPHORE;

void setName(const DeviceContext& context, VkObjectType type, std::uint64_t object,
             const std::string& name);

/// Names an object: captures and validation messages then show "cull/tiles" instead of 0x55d0….
/// Does nothing without VK_EXT_debug_utils.
template <typename Handle>
void setName(const DeviceContext& context, Handle object, const std::string& name)
{
    static_assert(objectType<Handle> != VK_OBJECT_TYPE_UNKNOWN);
    setName(context, objectType<Handle>, reinterpret_cast<std::uint64_t>(object), name);
}

/// Labels the commands recorded during its lifetime.
class LabelScope {
public:
    LabelScope(const DeviceContext& context, VkCommandBuffer commands, const char* label);
    LabelScope(const LabelScope&) = delete;
    LabelScope& operator=(const LabelScope&) = delete;
    ~LabelScope();

private:
    const DeviceContext& context_;
    VkCommandBuffer commands_;
};

} // namespace sward::gpu
