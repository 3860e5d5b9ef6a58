#pragma once

#include "gpu/context.h"
#include "gpu/handle.h"

#include <vulkan/vulkan.h>

#include <cstdint>
#include <string>
#include <vector>

namespace sward::gpu {

/// The layout of a set of one uniform buffer, at binding 0, for compute shaders.
class UniformSetLayout {
public:
    UniformSetLayout() = default;
    UniformSetLayout(const DeviceContext& context, const std::string& name);

    VkDescriptorSetLayout get() const { return layout_.get(); }

private:
    Owned<VkDescriptorSetLayout, &DeviceFunctions::DestroyDescriptorSetLayout> layout_;
};

/// Any device takes uniform buffers that lie at multiples of it [bytes].
constexpr VkDeviceSize uniformAlignment = 256;

struct UniformSetsSettings {
    std::string name{};
    VkBuffer buffer =
        VK_NULL_HANDLE;      ///< with VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT; outlives the sets
    VkDeviceSize offset = 0; ///< of the first [bytes], a multiple of uniformAlignment …
    VkDeviceSize bytes = 0;  ///< … and of each, so that they lie on end
    std::uint32_t count = 1;
};

/// Sets for parts of one size of a buffer, which lie on end. Sets of any UniformSetLayout fit any
/// pipeline that was made with one.
class UniformSets {
public:
    UniformSets() = default;
    UniformSets(const DeviceContext& context, const UniformSetLayout& layout,
                const UniformSetsSettings& settings);

    VkDescriptorSet get(std::uint32_t index) const { return sets_[index]; }

private:
    Owned<VkDescriptorPool, &DeviceFunctions::DestroyDescriptorPool> pool_;
    std::vector<VkDescriptorSet> sets_;
};

} // namespace sward::gpu
