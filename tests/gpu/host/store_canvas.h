#pragma once

#include "gpu/context/context.h"
#include "gpu/memory/image.h"
#include "host_picture.h"

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <vulkan/vulkan.h>

#include <cstddef>
#include <vector>

namespace sward::test {

/// A host's picture of one sample per pixel that grass is stored into, and its depth. Each channel
/// is 0 … 1, or radiance.
class StoreCanvas {
public:
    struct Settings {
        glm::uvec2 size = hostSize;
        VkFormat format = VK_FORMAT_R8G8B8A8_UNORM;
        bool isSrgb = false; ///< of an 8-bit format: the image is sRGB, and the view UNORM
        glm::vec4 background{0.2f, 0.4f, 0.8f, 1.0f}; ///< linear, of what is there before
    };

    static constexpr float depthBefore = 0.25f; ///< where no grass is stored

    StoreCanvas(const gpu::DeviceContext& context, const Settings& settings);

    render::StoredPicture picture() const; ///< with depth, the view at the first pixel

    /// Draws the background, as a host draws its scene, and leaves both images for storage.
    void recordScene(VkCommandBuffer commands) const;
    /// Hands both images to the host's later passes.
    void recordEnd(VkCommandBuffer commands) const;

    /// After recordEnd(): rows of colours, decoded to linear ones, …
    std::vector<glm::vec4> colors() const;
    /// … the bytes of these, …
    std::vector<std::byte> bytes() const;
    /// … and depths.
    std::vector<float> depths() const;

private:
    const gpu::DeviceContext& context_;
    Settings settings_;
    gpu::Image color_;
    gpu::Image depth_;
};

/// The nearest depth of the four samples of each pixel of a `depth` that has been drawn into.
std::vector<float> nearestOfFour(const gpu::DeviceContext& context, const gpu::Image& depth,
                                 bool isReversed);

/// The depth of one of the four samples of each pixel, once for a `depth` that has been drawn into.
std::vector<float> depthsOfSample(const gpu::DeviceContext& context, const gpu::Image& depth,
                                  std::uint32_t sample);

} // namespace sward::test
