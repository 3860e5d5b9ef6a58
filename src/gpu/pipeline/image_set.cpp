#include "gpu/pipeline/image_set.h"

#include "core/error.h"
#include "core/expect.h"
#include "gpu/context/check.h"
#include "gpu/context/debug.h"

#include <algorithm>

namespace sward::gpu {
namespace {

constexpr std::uint32_t sampledBinding = 0;
constexpr std::uint32_t storageBinding = 1;

} // namespace

ImageSetLayout::ImageSetLayout(const DeviceContext& context, const ImageSetSettings& settings)
    : sampledCount_(settings.sampledCount)
    , storageCount_(settings.storageCount)
{
    const VkPhysicalDeviceLimits& limits = context.limits;
    const std::uint32_t maxSampled =
        std::min(limits.maxPerStageDescriptorSamplers, limits.maxPerStageDescriptorSampledImages);
    if (sampledCount_ > maxSampled || storageCount_ > limits.maxPerStageDescriptorStorageImages)
        fail(ErrorKind::unsupported,
             "'{}' has {} sampled and {} storage images; {} allows {} and {} in a shader",
             settings.name, sampledCount_, storageCount_, context.name, maxSampled,
             limits.maxPerStageDescriptorStorageImages);

    std::vector<VkDescriptorSetLayoutBinding> bindings;
    if (sampledCount_ > 0)
        bindings.push_back({sampledBinding, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
                            sampledCount_, settings.stages, nullptr});
    if (storageCount_ > 0)
        bindings.push_back({storageBinding, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, storageCount_,
                            settings.stages, nullptr});

    layout_ = sharedSetLayout(context, settings.name, bindings);
}

ImageSet::ImageSet(const DeviceContext& context, const ImageSetLayout& layout,
                   const std::string& name)
    : context_(&context)
    , sampledCount_(layout.sampledCount())
    , isSet_(layout.sampledCount() + layout.storageCount(), false)
{
    expect(!isSet_.empty(), "an image set has images");

    // A pool for this one set.
    std::vector<VkDescriptorPoolSize> sizes;
    if (layout.sampledCount() > 0)
        sizes.push_back({VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, layout.sampledCount()});
    if (layout.storageCount() > 0)
        sizes.push_back({VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, layout.storageCount()});
    VkDescriptorPoolCreateInfo create{};
    create.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
    create.maxSets = 1;
    create.poolSizeCount = static_cast<std::uint32_t>(sizes.size());
    create.pPoolSizes = sizes.data();
    VkDescriptorPool pool = VK_NULL_HANDLE;
    check(context.vk.CreateDescriptorPool(context.device, &create, context.allocation, &pool),
          "vkCreateDescriptorPool");
    pool_ = {context, pool};

    VkDescriptorSetLayout setLayout = layout.get();
    VkDescriptorSetAllocateInfo allocate{};
    allocate.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
    allocate.descriptorPool = pool;
    allocate.descriptorSetCount = 1;
    allocate.pSetLayouts = &setLayout;
    check(context.vk.AllocateDescriptorSets(context.device, &allocate, &set_),
          "vkAllocateDescriptorSets");
    setName(context, set_, name);
}

void ImageSet::setSampled(std::uint32_t index, VkImageView view, VkSampler sampler,
                          VkImageLayout layout)
{
    write(sampledBinding, index, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
          {sampler, view, layout});
}

void ImageSet::setStorage(std::uint32_t index, VkImageView view)
{
    write(storageBinding, index, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE,
          {VK_NULL_HANDLE, view, VK_IMAGE_LAYOUT_GENERAL});
}

void ImageSet::write(std::uint32_t binding, std::uint32_t index, VkDescriptorType type,
                     const VkDescriptorImageInfo& image)
{
    const bool isSampled = binding == sampledBinding;
    const std::size_t element = isSampled ? index : sampledCount_ + std::size_t(index);
    expect(element < (isSampled ? sampledCount_ : isSet_.size()), "the set has that element");

    VkWriteDescriptorSet change{};
    change.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
    change.dstSet = set_;
    change.dstBinding = binding;
    change.dstArrayElement = index;
    change.descriptorCount = 1;
    change.descriptorType = type;
    change.pImageInfo = &image;
    context_->vk.UpdateDescriptorSets(context_->device, 1, &change, 0, nullptr);
    isSet_[element] = true;
}

void ImageSet::bind(const Recording& commands, VkPipelineBindPoint point,
                    const PipelineLayout& layout, std::uint32_t setIndex) const
{
    expect(std::ranges::find(isSet_, false) == isSet_.end(), "every image of the set is set");
    commands.vk->CmdBindDescriptorSets(commands, point, layout.get(), setIndex, 1, &set_, 0,
                                       nullptr);
}

} // namespace sward::gpu
