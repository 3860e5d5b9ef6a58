#pragma once

#include "core/bounds.h"
#include "render/camera.h"
#include "render/geometry.h"

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <vulkan/vulkan.h>

#include <cstdint>
#include <optional>

namespace sward::render {

/// Depth of what the host has drawn, so that blades behind it are left out.
struct HostDepth {
    VkImageView view = VK_NULL_HANDLE; ///< of the depth aspect, one layer, one mip level, as large
                                       ///< as the view's picture, whose first pixel is its first
    VkImageLayout layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL; ///< when it is read
    std::uint32_t samples = 1;                                       ///< 1, 2, 4 or 8
    /// By how much what was drawn may be farther than its depth says: two steps of 32 or 24 bits;
    /// 16 bits have 3e-5.
    float slack = 1.2e-7f;
};

/// One view of a frame as an engine has it: an eye of two, a shadow's cascade, a mirror.
struct HostView {
    /// From the world to Vulkan's clip space, of a perspective or a parallel projection; a picture
    /// with y upwards is the viewport's affair, except that `depth` is then not to be given.
    glm::dmat4 worldToClip{1.0};
    glm::uvec2 size{1};        ///< [pixels] of the picture
    std::uint32_t samples = 1; ///< per pixel of it
    bool hasReversedZ = true;  ///< 1 near and 0 far; else 0 near and 1 far

    /// How blades are drawn: see Grass::recordRaster(). Automatic is the compute rasteriser on a
    /// GPU and the tessellator on a CPU, which lights the pixels of the former more slowly. Shadow
    /// maps want the tessellator.
    Geometry geometry = Geometry::automatic;

    /// Blades are culled from here instead: a frozen camera.
    std::optional<glm::dmat4> cullViewFrom{};

    /// The worldToClip of the frame before, for motion vectors; not given: the same as now.
    std::optional<glm::dmat4> clipBefore{};

    /// What hides blades; not given: nothing.
    std::optional<HostDepth> depth{};
};

/// The view's matrix as blades are culled by it: `fieldToClip` in the host's convention becomes one
/// with reversed Z, its planes, eye and sharpness. A parallel projection is culled by an eye so far
/// away that its rays are parallel; `content` is the box of what can be seen.
ViewMatrices viewMatricesOf(const glm::dmat4& fieldToClip, bool hasReversedZ, glm::uvec2 size,
                            const Aabb& content);

/// Whether all rays of a projection are parallel: distances then mean nothing.
bool isParallel(const glm::dmat4& toClip);

} // namespace sward::render
