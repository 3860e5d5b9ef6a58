#pragma once

#include "core/bounds.h"
#include "render/frame/camera.h"
#include "render/frame/geometry.h"
#include "render/host/host_image.h"
#include "render/host/host_light.h"

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <vulkan/vulkan.h>

#include <cstdint>
#include <optional>

namespace sward::render {

/// Depth of the host's scene; blades behind it are culled.
struct HostDepth {
    VkImageView view = VK_NULL_HANDLE; ///< depth aspect, one layer, one mip level; at least as
                                       ///< large as the view's picture, with the same first pixel
    VkImageLayout layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL; ///< while it is read
    std::uint32_t samples = 1;                                       ///< 1, 2, 4 or 8
    /// How much farther a surface may be than its depth: two steps of 32 or 24 bits; 3e-5 for 16
    /// bits.
    float slack = 1.2e-7f;

    HostImage image{}; ///< behind `view`, for checks
};

/// Layers of the grass in a view, as numbers (docs/layers.md), which Grass::recordRaster() writes:
/// of the nearest sample that shows a blade. Not if Grass::whyTessellated() has a reason.
struct HostLayers {
    std::uint32_t wanted = 0; ///< bits of render::Layer: all but flowForward; flowBackward needs
                              ///< Grass::Settings::keepsMotion
    /// Device address, a multiple of 16, of layerBytes(wanted, size, true) bytes in a buffer with
    /// the usages STORAGE_BUFFER and SHADER_DEVICE_ADDRESS. LayerWords says what they hold. All
    /// commands after recordRaster() see them; the CPU does after a barrier to the host.
    VkDeviceAddress words = 0;
};

/// One view of an engine's frame: an eye of a stereo pair, a shadow cascade, a mirror.
struct HostView {
    /// From the world to Vulkan's clip space, perspective or parallel. A picture with y upwards
    /// must be handled by the viewport and must not set `depth`.
    glm::dmat4 worldToClip{1.0};
    glm::uvec2 size{1};        ///< [pixels] of the picture
    std::uint32_t samples = 1; ///< per pixel

    /// true: 1 near and 0 far; false: 0 near and 1 far. Grass::begin() compares it with what
    /// isReversedZ() finds in the matrices.
    bool hasReversedZ = true;

    /// How blades are drawn: see Grass::recordRaster(). Automatic: the compute rasteriser on a GPU;
    /// the tessellator on a CPU, where it lights pixels faster. Shadow maps need the tessellator.
    Geometry geometry = Geometry::automatic;

    /// Culling uses this matrix instead: a frozen camera.
    std::optional<glm::dmat4> cullViewFrom{};

    /// The worldToClip of the frame before, for motion vectors; unset: same as now.
    std::optional<glm::dmat4> clipBefore{};

    /// Occluders; unset: none.
    std::optional<HostDepth> depth{};

    /// Shadow map of the host's sun; unset: the whole view is in the sun.
    std::optional<HostShadow> shadow{};

    /// Picture that Grass::recordRaster() stores the grass into, instead of a composite by
    /// Grass::recordDraw(); unset: none. Grass::whyNotStored() tells whether it does.
    std::optional<StoredPicture> stored{};

    /// Numbers beside the picture; unset: none.
    std::optional<HostLayers> layers{};
};

/// The view's matrix for culling: converts `fieldToClip` from the host's convention to reversed Z,
/// with planes, eye and pixels per unit. A parallel projection gets an eye so distant that its rays
/// are parallel. `content` is the box of everything visible.
ViewMatrices viewMatricesOf(const glm::dmat4& fieldToClip, bool hasReversedZ, glm::uvec2 size,
                            const Aabb& content);

/// The eye of a perspective.
glm::dvec3 eyeOf(const glm::dmat4& toClip);

/// Whether all rays of a projection are parallel; it then has no distances.
bool isParallel(const glm::dmat4& toClip);

/// Whether depth falls with the distance from the eye, by a perspective of any planes, also at
/// infinity or oblique, of either direction of y and of either hand. Unset by parallel rays, which
/// may come from either side, and where rounding to single precision could turn the answer.
std::optional<bool> isReversedZ(const glm::dmat4& toClip);

} // namespace sward::render
