#pragma once

#include "gpu/context.h"
#include "gpu/image.h"
#include "gpu/swapchain.h"

#include <glm/vec2.hpp>
#include <vulkan/vulkan.h>

namespace sward::view {

/// The internal picture, scaled to the window afterwards; of the window's size or smaller. One of
/// less than half the width is scaled in two steps of linear filtering, the first to twice the
/// size: together they are a smooth filter, where one step would show the pixels as squares.
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

    /// Scales the picture (ImageUse::colorTarget) to the whole window image. Leaves the window
    /// image as colorTarget and the picture as transferSource.
    void spread(VkCommandBuffer commands, const gpu::Swapchain::Target& target,
                VkExtent2D window) const;

    /// Scales the picture (ImageUse::transferSource) to an image of `extent` [pixels] in
    /// ImageUse::transferTarget.
    void scaleInto(VkCommandBuffer commands, VkImage to, VkExtent2D extent) const;

private:
    const gpu::DeviceContext& context_;
    gpu::Image image_;
    gpu::Image doubled_; ///< of twice the size; none if the picture has half the width or more
};

/// Copies `from` (ImageUse::transferSource) to a window image; scales it if the window has got
/// another size meanwhile. Leaves that as colorTarget.
void spreadPicture(VkCommandBuffer commands, const gpu::Image& from,
                   const gpu::Swapchain::Target& target, VkExtent2D window);

} // namespace sward::view
