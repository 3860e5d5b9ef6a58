#include "render/host/host_shadow_maps.h"

#include "gpu/context/check.h"
#include "gpu/context/debug.h"
#include "gpu/recording/barrier.h"

namespace sward::render {
namespace {

/// Every device samples this format.
constexpr VkFormat placeholderFormat = VK_FORMAT_D16_UNORM;
constexpr const char* placeholderName = "host shadow/none";
constexpr VkImageSubresourceRange placeholderRange{VK_IMAGE_ASPECT_DEPTH_BIT, 0, 1, 0, 1};

} // namespace

gpu::ImageSetLayout hostShadowLayout(const gpu::DeviceContext& context)
{
    return {context,
            {.name = "host shadow",
             .sampledCount = 1,
             .stages = VK_SHADER_STAGE_COMPUTE_BIT | VK_SHADER_STAGE_FRAGMENT_BIT}};
}

bool isLitByHost(const HostLight& light, const HostView& view)
{
    return light.ambient || !light.lamps.empty() || view.shadow;
}

HostShadowMaps::HostShadowMaps(const gpu::DeviceContext& context, std::uint32_t slots,
                               std::uint32_t maxViews)
    : context_(&context)
    , maxViews_(maxViews)
    , layout_(hostShadowLayout(context))
    , sampler_(gpu::createSampler(context, {.name = "host shadow",
                                            .filter = VK_FILTER_NEAREST,
                                            .address = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE}))
    , views_(slots * maxViews)
{
}

HostShadowMaps::Placeholder HostShadowMaps::makePlaceholder() const
{
    Placeholder made;
    VkImageCreateInfo create{};
    create.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
    create.imageType = VK_IMAGE_TYPE_2D;
    create.format = placeholderFormat;
    create.extent = {1, 1, 1};
    create.mipLevels = 1;
    create.arrayLayers = 1;
    create.samples = VK_SAMPLE_COUNT_1_BIT;
    create.usage = VK_IMAGE_USAGE_SAMPLED_BIT;
    VkImage image = VK_NULL_HANDLE;
    gpu::check(context_->vk.CreateImage(context_->device, &create, context_->allocation, &image),
               "vkCreateImage");
    made.image = {*context_, image};
    gpu::setName(*context_, image, placeholderName);
    made.memory = gpu::allocateFor(*context_, image, placeholderName);

    VkImageViewCreateInfo seen{};
    seen.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
    seen.image = image;
    seen.viewType = VK_IMAGE_VIEW_TYPE_2D_ARRAY;
    seen.format = placeholderFormat;
    seen.subresourceRange = placeholderRange;
    VkImageView view = VK_NULL_HANDLE;
    gpu::check(context_->vk.CreateImageView(context_->device, &seen, context_->allocation, &view),
               "vkCreateImageView");
    made.view = {*context_, view};
    return made;
}

void HostShadowMaps::begin(std::uint32_t slot, const HostLight& light,
                           std::span<const HostView> views)
{
    usesPlaceholder_ = false;
    for (std::uint32_t i = 0; i < views.size(); ++i) {
        View& view = views_[slot * maxViews_ + i];
        view.isLit = isLitByHost(light, views[i]);
        if (!view.isMade)
            view.set = gpu::ImageSet(*context_, layout_, "host shadow");
        view.isMade = true;
        if (views[i].shadow) {
            view.set.setSampled(0, views[i].shadow->view, sampler_.get(), views[i].shadow->layout);
            continue;
        }
        if (placeholder_.view.get() == VK_NULL_HANDLE)
            placeholder_ = makePlaceholder();
        view.set.setSampled(0, placeholder_.view.get(), sampler_.get());
        usesPlaceholder_ = true;
    }
}

void HostShadowMaps::record(const gpu::Recording& commands) const
{
    if (!usesPlaceholder_)
        return;
    // In every frame, since nothing says whether former commands were submitted.
    VkImageMemoryBarrier2 barrier{};
    barrier.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2;
    barrier.srcStageMask = gpu::anyAccess.stages;
    barrier.srcAccessMask = gpu::anyAccess.accesses;
    barrier.dstStageMask = gpu::shaderStages;
    barrier.dstAccessMask = VK_ACCESS_2_SHADER_SAMPLED_READ_BIT;
    barrier.oldLayout = VK_IMAGE_LAYOUT_UNDEFINED;
    barrier.newLayout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.image = placeholder_.image.get();
    barrier.subresourceRange = placeholderRange;
    VkDependencyInfo dependency{};
    dependency.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
    dependency.imageMemoryBarrierCount = 1;
    dependency.pImageMemoryBarriers = &barrier;
    commands.vk->CmdPipelineBarrier2(commands, &dependency);
}

const gpu::ImageSet& HostShadowMaps::of(std::uint32_t slot, std::uint32_t view) const
{
    return views_[slot * maxViews_ + view].set;
}

bool HostShadowMaps::isLit(std::uint32_t slot, std::uint32_t view) const
{
    return views_[slot * maxViews_ + view].isLit;
}

} // namespace sward::render
