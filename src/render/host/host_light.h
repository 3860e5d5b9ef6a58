#pragma once

#include "render/host/host_image.h"

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <vulkan/vulkan.h>

#include <array>
#include <cstddef>
#include <optional>
#include <span>

namespace sward::render {

inline constexpr std::size_t maxCascades = 4; ///< of a shadow map
inline constexpr std::size_t maxLamps = 16;   ///< of a frame

/// The host's shadow map of its sun, as a view needs it: one layer for each cascade. Blades in
/// shadow get no sun, neither reflected nor through the blade; other light stays. A place is looked
/// up in the first cascade that contains it and two texels around it; outside of all it is in the
/// sun. The edge of a shadow is three texels wide.
struct HostShadow {
    /// Depth aspect of a 2D array with at least as many layers as cascades, of one mip level and
    /// one sample, with the usage SAMPLED. Not null.
    VkImageView view = VK_NULL_HANDLE;
    VkImageLayout layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL; ///< while it is read

    /// By layer, the finest first: from the world to Vulkan's clip space, by parallel rays. 1 to
    /// maxCascades, finite. Read until Grass::begin() returns.
    std::span<const glm::dmat4> worldToShadow{};
    bool hasReversedZ = true; ///< true: 1 nearest to the sun; false: 0 nearest

    /// A place is moved so far towards the sun before it is compared [m]; finite. Blades that the
    /// map itself shows need more than a step of its depth.
    float bias = 0.02f;

    /// And so far along the blade's up-vector [texels of its cascade], so that sloping ground does
    /// not shade the roots on it; finite. Not along the normal: a blade has two sides.
    float lift = 1.5f;

    HostImage image{}; ///< behind `view`, for checks
};

/// Light from all around, the same at all places: the radiance that arrives from a direction of the
/// world, as spherical harmonics of order 2 in linear colours of FrameSettings::skyColor's unit.
struct HostAmbient {
    /// Coefficients of the orthonormal real basis (Ramamoorthi & Hanrahan 2001), finite: 0.282095;
    /// 0.488603 of y, z, x; 1.092548 of xy, yz; 0.315392 (3z² − 1); 1.092548 xz; 0.546274 (x² −
    /// y²). Those of irradiance are π times the first, 2π/3 times the next three and π/4 times the
    /// others: divide by that.
    std::array<glm::vec3, 9> radiance{};

    static HostAmbient constant(glm::vec3 radiance); ///< the same from everywhere
};

/// The cone of a spot light.
struct HostCone {
    glm::vec3 direction{0.0f, -1.0f, 0.0f}; ///< of its axis, away from the lamp; any length above 0
    float innerCosine = 0.9f; ///< full light inside of this angle's cosine, (outer, 1]
    float outerCosine = 0.8f; ///< no light outside, [−1, inner)
};

/// A point light, or a spot light if it has a cone. Its light falls with the inverse square of the
/// distance, times (1 − (distance / range)⁴)². Blades reflect it and let it through as the sun's;
/// the grass around a blade absorbs some. Nothing else casts a shadow: it shines through ground.
struct HostLamp {
    glm::dvec3 position{0.0}; ///< world [m]
    float range = 10.0f;      ///< [m] above 0; there is no light beyond

    /// Linear, not negative, in FrameSettings::sunColor's unit at 1 m: the irradiance there over π.
    /// Of a radiant intensity I, it is I / π. Distances below 1 cm count as 1 cm.
    glm::vec3 color{1.0f};
    std::optional<HostCone> cone{}; ///< unset: a point light
};

/// The light of a host's scene on blades, for all views of a frame. What is not given here is that
/// of FrameSettings: the sun always is.
struct HostLight {
    std::optional<HostAmbient> ambient{}; ///< instead of the sky's and the ground's colours
    std::span<const HostLamp> lamps{};    ///< at most maxLamps
};

/// Throw Error{usage} that names what is out of range. requireCounts() has counted the lamps.
void requireValid(const HostLight& light);
void requireValid(const HostShadow& shadow);

} // namespace sward::render
