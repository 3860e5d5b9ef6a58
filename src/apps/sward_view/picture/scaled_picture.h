#pragma once

#include "gpu/context/context.h"
#include "gpu/memory/image.h"
#include "gpu/presentation/swapchain.h"

#include <glm/vec2.hpp>
#include <vulkan/vulkan.h>

#include <cstdint>
#include <vector>

namespace sward::view {

/// The internal picture, scaled to the window afterwards; of the window's size or smaller. One of
/// less than half the width is scaled in two steps of linear filtering, the first to twice the
/// size, one of less than a quarter in three: together they are a smooth filter, where one step
/// would show the pixels as squares.
class ScaledPicture {
public:
    explicit ScaledPicture(const gpu::DeviceContext& context)
        : context_(context)
    {
    }

    /// Sets the size to the window's size times `scale`, and the window's format. Waits for the
    /// device if either changes.
    void resize(VkExtent2D window, double scale, VkFormat format);

    const gpu::Image& image() const { return image_; }
    glm::uvec2 size() const { return {image_.extent().width, image_.extent().height}; }

    /// Scales the picture (ImageUse::colorTarget) to the whole window image; one of the window's
    /// size begins `shift` pixels from its left border, and nothing is left of it. Leaves the
    /// window image as colorTarget and the picture as transferSource.
    void spread(VkCommandBuffer commands, const gpu::Swapchain::Target& target, VkExtent2D window,
                std::uint32_t shift = 0) const;

    /// Scales the picture (ImageUse::transferSource) to an image of `extent` [pixels] in
    /// ImageUse::transferTarget.
    void scaleInto(VkCommandBuffer commands, VkImage to, VkExtent2D extent) const;

private:
    const gpu::DeviceContext& context_;
    gpu::Image image_;
    std::vector<gpu::Image> doubled_; ///< each twice as large as the one before
};

/// Copies `from` (ImageUse::transferSource) to a window image, from `shift` pixels right of its
/// left border on; scales it if the window has got another size meanwhile. Leaves that as
/// colorTarget.
void spreadPicture(VkCommandBuffer commands, const gpu::Image& from,
                   const gpu::Swapchain::Target& target, VkExtent2D window,
                   std::uint32_t shift = 0);

} // namespace sward::view
