#include "gpu/recording/rendering.h"

#include "core/expect.h"

namespace sward::gpu {
namespace {

VkRenderingAttachmentInfo attachment(VkImageView view, VkImageLayout layout, bool clears,
                                     bool isKept)
{
    VkRenderingAttachmentInfo result{};
    result.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO;
    result.imageView = view;
    result.imageLayout = layout;
    result.loadOp = clears ? VK_ATTACHMENT_LOAD_OP_CLEAR : VK_ATTACHMENT_LOAD_OP_LOAD;
    result.storeOp = isKept ? VK_ATTACHMENT_STORE_OP_STORE : VK_ATTACHMENT_STORE_OP_DONT_CARE;
    return result;
}

VkRenderingAttachmentInfo describe(const ColorAttachment& color)
{
    VkRenderingAttachmentInfo result =
        attachment(color.view, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, color.clear.has_value(),
                   color.isKept);
    if (!color.clear && !color.isLoaded)
        result.loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    if (color.clear)
        for (std::size_t i = 0; i < 4; ++i)
            result.clearValue.color.float32[i] = (*color.clear)[i];
    if (color.resolve != VK_NULL_HANDLE) {
        result.resolveMode = VK_RESOLVE_MODE_AVERAGE_BIT;
        result.resolveImageView = color.resolve;
        result.resolveImageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    }
    return result;
}

VkRenderingAttachmentInfo describe(const DepthAttachment& depth)
{
    VkRenderingAttachmentInfo result =
        attachment(depth.view, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL,
                   depth.clear.has_value(), depth.isKept);
    result.clearValue.depthStencil = {depth.clear.value_or(0.0f), 0};
    return result;
}

} // namespace

void setArea(const Recording& commands, VkExtent2D extent)
{
    const VkViewport viewport{
        0.0f, 0.0f, static_cast<float>(extent.width), static_cast<float>(extent.height),
        0.0f, 1.0f};
    const VkRect2D scissor{{0, 0}, extent};
    commands.vk->CmdSetViewport(commands, 0, 1, &viewport);
    commands.vk->CmdSetScissor(commands, 0, 1, &scissor);
}

RenderingScope::RenderingScope(const Recording& commands, VkExtent2D extent,
                               std::span<const ColorAttachment> colors,
                               const std::optional<DepthAttachment>& depth)
    : commands_(commands)
{
    expect(colors.size() <= maxColorAttachments, "there are at most four colour attachments");
    std::array<VkRenderingAttachmentInfo, maxColorAttachments> colorAttachments{};
    for (std::size_t i = 0; i < colors.size(); ++i)
        colorAttachments[i] = describe(colors[i]);
    const VkRenderingAttachmentInfo depthAttachment =
        depth ? describe(*depth) : VkRenderingAttachmentInfo{};

    VkRenderingInfo rendering{};
    rendering.sType = VK_STRUCTURE_TYPE_RENDERING_INFO;
    rendering.renderArea.extent = extent;
    rendering.layerCount = 1;
    rendering.colorAttachmentCount = static_cast<std::uint32_t>(colors.size());
    rendering.pColorAttachments = colorAttachments.data();
    rendering.pDepthAttachment = depth ? &depthAttachment : nullptr;
    commands.vk->CmdBeginRendering(commands, &rendering);
    setArea(commands, extent);
}

RenderingScope::~RenderingScope()
{
    commands_.vk->CmdEndRendering(commands_);
}

} // namespace sward::gpu
