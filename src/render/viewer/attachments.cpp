#include "render/viewer/attachments.h"

#include "core/error.h"
#include "core/expect.h"
#include "gpu/context/check.h"

namespace sward::render {

Attachments::Attachments(const gpu::DeviceContext& context, const TargetSettings& settings)
    : context_(&context)
    , settings_(settings)
{
    expect(settings.samples == 1 || settings.samples == 4, "a picture has 1 or 4 samples");
    const VkSampleCountFlags both =
        context.limits.framebufferColorSampleCounts & context.limits.framebufferDepthSampleCounts;
    if ((both & settings.samples) == 0)
        fail(ErrorKind::unsupported, "{} does not draw with {} samples per pixel; 1 always works",
             context.name, settings.samples);
}

bool Attachments::resize(glm::uvec2 size)
{
    expect(size.x > 0 && size.y > 0, "a picture has at least one pixel");
    if (size == size_)
        return false;
    if (size_ != glm::uvec2(0))
        gpu::check(context_->vk.DeviceWaitIdle(context_->device), "vkDeviceWaitIdle");

    const VkExtent2D extent{size.x, size.y};
    depth_ = gpu::Image(*context_, {.name = "frame/depth",
                                    .format = depthFormat,
                                    .extent = extent,
                                    .usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT |
                                             VK_IMAGE_USAGE_SAMPLED_BIT,
                                    .samples = settings_.samples});
    if (hasColor())
        color_ = gpu::Image(*context_, {.name = "frame/color",
                                        .format = settings_.colorFormat,
                                        .extent = extent,
                                        .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT,
                                        .samples = settings_.samples});
    size_ = size;
    return true;
}

} // namespace sward::render
