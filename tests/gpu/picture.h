#pragma once

#include "gpu/image.h"
#include "render/field_renderer.h"

#include <glm/vec2.hpp>

#include <cstddef>
#include <vector>

namespace sward::test {

/// A picture in memory that a renderer draws into.
class Picture {
public:
    Picture(const gpu::DeviceContext& context, glm::uvec2 size);

    /// One frame, waited for.
    void draw(render::FieldRenderer& renderer, const render::Camera& camera,
              const render::FrameSettings& settings, double time);

    std::vector<std::byte> pixels() const; ///< R G B A, rows from the top
    glm::uvec2 size() const { return size_; }

private:
    const gpu::DeviceContext& context_;
    glm::uvec2 size_;
    gpu::Image image_;
};

/// Pixels in which two pictures differ.
std::size_t differingPixels(const std::vector<std::byte>& a, const std::vector<std::byte>& b);

} // namespace sward::test
