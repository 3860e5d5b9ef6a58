#pragma once

#include <vulkan/vulkan.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace sward::gpu {

/// An image in ImageUse::colorTarget that is drawn into.
struct ColorAttachment {
    VkImageView view = VK_NULL_HANDLE;         ///< of one mip level
    VkImageView resolve = VK_NULL_HANDLE;      ///< of one sample; receives the average, if given
    std::optional<std::array<float, 4>> clear; ///< none: what is there stays …
    bool isLoaded = true; ///< … or, where nothing is drawn, may become anything
    bool isKept = true;   ///< false: the samples are needed no more once they are resolved
};

/// An image in ImageUse::depthTarget.
struct DepthAttachment {
    VkImageView view = VK_NULL_HANDLE; ///< of one mip level
    std::optional<float> clear;        ///< reversed Z: 0 is far; none: what is there stays
    bool isKept = true;                ///< false: it is needed no more
};

constexpr std::size_t maxColorAttachments = 4;

/// Sets viewport and scissor to the whole extent, y downwards, depth from 0 to 1.
void setArea(VkCommandBuffer commands, VkExtent2D extent);

/// Draws into images while it lives (dynamic rendering). Begins with setArea().
class RenderingScope {
public:
    /// At most maxColorAttachments, all of this extent or larger.
    RenderingScope(VkCommandBuffer commands, VkExtent2D extent,
                   std::span<const ColorAttachment> colors,
                   const std::optional<DepthAttachment>& depth = std::nullopt);
    RenderingScope(const RenderingScope&) = delete;
    RenderingScope& operator=(const RenderingScope&) = delete;
    ~RenderingScope();

private:
    VkCommandBuffer commands_;
};

} // namespace sward::gpu
