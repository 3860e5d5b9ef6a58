#pragma once

#include "gpu/context/context.h"
#include "gpu/context/handle.h"
#include "gpu/memory/memory.h"
#include "render/grass.h"

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vulkan/vulkan.h>

#include <cstdint>
#include <functional>

namespace sward::test {

/// A host's shadow map with given depths, ready to be sampled.
class ShadowMap {
public:
    /// Depth of a texel of a layer.
    using Depths = std::function<float(std::uint32_t layer, glm::uvec2 texel)>;

    ShadowMap(const gpu::DeviceContext& context, std::uint32_t size, std::uint32_t layers,
              const Depths& depths);

    /// Draws a view's blades into the first layer of a map of one layer, of reversed depth.
    void record(VkCommandBuffer commands, const render::Grass& grass, std::uint32_t view,
                const render::BladeTarget& target) const;

    VkImageView view() const { return view_.get(); }

private:
    std::uint32_t size_;
    gpu::Memory memory_;
    gpu::Owned<VkImage, &gpu::DeviceFunctions::DestroyImage> image_;
    gpu::ImageView view_;
};

/// From the world to a map of 2 `reach` [m] along each edge around the origin, by rays from the
/// sun; depth spans 2 `reach` as well.
glm::dmat4 worldToShadow(glm::dvec3 sun, double reach, bool isReversed);

} // namespace sward::test
