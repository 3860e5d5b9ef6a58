#pragma once

#include "gpu/recording/recording.h"

#include <vulkan/vulkan.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace sward::gpu {

/// A colour attachment; its image is in ImageUse::colorTarget.
struct ColorAttachment {
    VkImageView view = VK_NULL_HANDLE;         ///< of one mip level
    VkImageView resolve = VK_NULL_HANDLE;      ///< of one sample; receives the average, if set
    std::optional<std::array<float, 4>> clear; ///< none: contents are kept …
    bool isLoaded = true; ///< … or become undefined where nothing is drawn, if false
    bool isKept = true;   ///< false: the samples are discarded after the resolve
};

/// A depth attachment; its image is in ImageUse::depthTarget.
struct DepthAttachment {
    VkImageView view = VK_NULL_HANDLE; ///< of one mip level
    std::optional<float> clear;        ///< reversed Z: 0 is far; none: contents are kept
    bool isKept = true;                ///< false: contents are discarded afterwards
};

constexpr std::size_t maxColorAttachments = 4;

/// Sets viewport and scissor to the whole extent, y downwards, depth from 0 to 1.
void setArea(const Recording& commands, VkExtent2D extent);

/// Dynamic rendering into images during its lifetime. Begins with setArea().
class RenderingScope {
public:
    /// At most maxColorAttachments, each at least as large as `extent`.
    RenderingScope(const Recording& commands, VkExtent2D extent,
                   std::span<const ColorAttachment> colors,
                   const std::optional<DepthAttachment>& depth = std::nullopt);
    RenderingScope(const RenderingScope&) = delete;
    RenderingScope& operator=(const RenderingScope&) = delete;
    ~RenderingScope();

private:
    Recording commands_;
};

} // namespace sward::gpu
