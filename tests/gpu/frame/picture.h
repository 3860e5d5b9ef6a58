#pragma once

#include "field/field.h"
#include "gpu/device/device.h"
#include "gpu/memory/image.h"
#include "render/frame/frame_stats.h"
#include "render/layers/frame_layers.h"
#include "render/viewer/field_renderer.h"

#include <glm/vec2.hpp>

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace sward::test {

/// A picture in memory that a renderer draws into.
class Picture {
public:
    /// `isStored`: renderers store into it, instead of copying to it.
    Picture(const gpu::DeviceContext& context, glm::uvec2 size, bool isStored = false,
            VkFormat format = VK_FORMAT_R8G8B8A8_SRGB);

    /// Draws one frame and waits. `jitter` [pixels].
    void draw(render::FieldRenderer& renderer, const render::Camera& camera,
              const render::FrameSettings& settings, double time,
              glm::vec2 jitter = glm::vec2(0.0f));

    /// The same for the part of a picture of `whole` pixels that begins at pixel `first`.
    void drawPart(render::FieldRenderer& renderer, const render::Camera& camera,
                  const render::FrameSettings& settings, double time, glm::uvec2 whole,
                  glm::ivec2 first);

    /// The same as draw(), and writes layers.
    void drawLayers(render::FieldRenderer& renderer, const render::Camera& camera,
                    const render::FrameSettings& settings, double time, render::LayerMask layers);

    std::vector<std::byte> pixels() const; ///< R G B A or as the format has it, rows from the top
    glm::uvec2 size() const { return size_; }

private:
    const gpu::DeviceContext& context_;
    glm::uvec2 size_;
    gpu::Image image_;
};

/// A field with its renderer.
struct FieldScene {
    field::Field field;
    render::FieldRenderer renderer;
    render::FrameSettings settings; ///< settings of the field
    render::Camera camera;

    FieldScene(const gpu::Device& device, field::Field made,
               const render::FieldRenderer::Settings& wanted)
        : field(std::move(made))
        , renderer(device, field::viewOf(field), wanted)
        , settings(render::FrameSettings::of(field::viewOf(field)))
    {
    }
};

/// Blades and ribbons of all results of culling in a frame.
std::uint64_t sumOf(const render::FrameStats& stats);

/// Pixels in which two pictures differ.
std::size_t differingPixels(const std::vector<std::byte>& a, const std::vector<std::byte>& b);

/// The largest difference of any of their bytes.
int largestDifference(const std::vector<std::byte>& a, const std::vector<std::byte>& b);

} // namespace sward::test
