#pragma once

#include "gpu/context/context.h"
#include "gpu/context/handle.h"
#include "gpu/pipeline/pipeline_layout.h"
#include "gpu/pipeline/shared_objects.h"
#include "gpu/recording/recording.h"

#include <vulkan/vulkan.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace sward::gpu {

struct ImageSetSettings {
    std::string name{};
    std::uint32_t sampledCount =
        0; ///< elements of binding 0, combined image samplers; lavapipe: ≤ 32
    std::uint32_t storageCount = 0; ///< elements of binding 1, storage images
    VkShaderStageFlags stages = VK_SHADER_STAGE_ALL;
};

/// Layout of a descriptor set of images: sampled images at binding 0, storage images at binding 1.
/// Empty bindings are omitted.
class ImageSetLayout {
public:
    ImageSetLayout() = default;
    ImageSetLayout(const DeviceContext& context, const ImageSetSettings& settings);

    VkDescriptorSetLayout get() const { return layout_ ? layout_->get() : VK_NULL_HANDLE; }
    std::uint32_t sampledCount() const { return sampledCount_; }
    std::uint32_t storageCount() const { return storageCount_; }

private:
    std::shared_ptr<const SetLayout> layout_;
    std::uint32_t sampledCount_ = 0;
    std::uint32_t storageCount_ = 0;
};

/// A descriptor set of images. Every element must be set before the set is bound, since lavapipe
/// lacks partially bound sets. No element may be set while the device uses the set.
class ImageSet {
public:
    ImageSet() = default;
    ImageSet(const DeviceContext& context, const ImageSetLayout& layout, const std::string& name);

    /// `view` is of an image in ImageUse::sampled, or in `layout` while it is sampled.
    void setSampled(std::uint32_t index, VkImageView view, VkSampler sampler,
                    VkImageLayout layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);

    /// `view` is of one mip level of an image in ImageUse::storage.
    void setStorage(std::uint32_t index, VkImageView view);

    void bind(const Recording& commands, VkPipelineBindPoint point, const PipelineLayout& layout,
              std::uint32_t setIndex = 0) const;

private:
    void write(std::uint32_t binding, std::uint32_t index, VkDescriptorType type,
               const VkDescriptorImageInfo& image);

    const DeviceContext* context_ = nullptr;
    Owned<VkDescriptorPool, &DeviceFunctions::DestroyDescriptorPool> pool_;
    VkDescriptorSet set_ = VK_NULL_HANDLE;
    std::uint32_t sampledCount_ = 0;
    std::vector<bool> isSet_; ///< the sampled ones, then the storage images
};

} // namespace sward::gpu
