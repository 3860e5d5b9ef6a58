#pragma once

#include "gpu/context.h"
#include "gpu/image.h"
#include "gpu/swapchain.h"

#include <glm/vec2.hpp>
#include <vulkan/vulkan.h>

namespace sward::view {

/// The picture that is drawn before it is spread over the window: as large as that, or smaller.
class ScaledPicture {
public:
    explicit ScaledPicture(const gpu::DeviceContext& context)
        : context_(context)
    {
    }

    /// Has the window's size times `scale`, in the format of its images. Waits for the device if
    /// that is new.
    void resize(VkExtent2D window, double scale, VkFormat format);

    const gpu::Image& image() const { return image_; }
    glm::uvec2 size() const { return {image_.extent().width, image_.extent().height}; }

    /// From ImageUse::colorTarget over the whole of the window's image, which is then a
    /// colorTarget; the picture is a transferSource.
    void spread(VkCommandBuffer commands, const gpu::Swapchain::Target& target,
                VkExtent2D window) const;

private:
    const gpu::DeviceContext& context_;
    gpu::Image image_;
};

} // namespace sward::view
