#pragma once

#include "gpu/context/context.h"
#include "gpu/context/handle.h"
#include "gpu/pipeline/shared_objects.h"

#include <vulkan/vulkan.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace sward::gpu {

/// Layout of a descriptor set with one uniform buffer at binding 0, for compute shaders.
class UniformSetLayout {
public:
    UniformSetLayout() = default;
    UniformSetLayout(const DeviceContext& context, const std::string& name);

    VkDescriptorSetLayout get() const { return layout_ ? layout_->get() : VK_NULL_HANDLE; }

private:
    std::shared_ptr<const SetLayout> layout_;
};

/// Alignment of uniform buffers [bytes] that every device accepts.
constexpr VkDeviceSize uniformAlignment = 256;

struct UniformSetsSettings {
    std::string name{};
    VkBuffer buffer =
        VK_NULL_HANDLE;      ///< with VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT; outlives the sets
    VkDeviceSize offset = 0; ///< start of the first part [bytes], a multiple of uniformAlignment …
    VkDeviceSize bytes = 0;  ///< … and size of each; the parts are contiguous
    std::uint32_t count = 1;
};

/// Descriptor sets for contiguous parts of a buffer, all of one size. The sets of every
/// UniformSetLayout are compatible with pipelines made with any other.
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
