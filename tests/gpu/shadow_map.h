#pragma once

#include "gpu/context.h"
#include "gpu/handle.h"
#include "gpu/memory.h"

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

    VkImageView view() const { return view_.get(); }

private:
    gpu::Memory memory_;
    gpu::Owned<VkImage, &gpu::DeviceFunctions::DestroyImage> image_;
    gpu::ImageView view_;
};

/// From the world to a map of 2 `reach` [m] along each edge around the origin, by rays from the
/// sun; depth spans 2 `reach` as well.
glm::dmat4 worldToShadow(glm::dvec3 sun, double reach, bool isReversed);

} // namespace sward::test
