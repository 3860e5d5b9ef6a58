#include "render/frame/shadow_box.h"

#include "shaders/shared/culling.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <cmath>

namespace sward::render {
namespace {

/// Of the box, in halves of its edge: behind its middle, and towards the sun.
constexpr double boxBehind = 1.0;
constexpr double boxBefore = 2.0;

/// Depth by which an occluder must be nearer: half a texel.
constexpr double nearerBy = 1.0 / (shared::bladeShadowTexels * (boxBehind + boxBefore));

glm::vec4 planeOf(const glm::dvec4& row)
{
    return glm::vec4(row / glm::length(glm::dvec3(row)));
}

} // namespace

std::optional<glm::dmat4> shadowBoxOf(glm::dvec3 eye, glm::dvec3 forward,
                                      const FrameSettings& settings)
{
    if (!settings.bladeShadows || settings.debug != DebugMode::none)
        return std::nullopt;
    const double half = 0.5 * static_cast<double>(settings.bladeShadowDistance);
    const glm::dvec3 sun = glm::normalize(glm::dvec3(settings.sunDirection));
    const glm::dvec3 beside =
        std::abs(sun.y) < 0.9 ? glm::dvec3(0.0, 1.0, 0.0) : glm::dvec3(1.0, 0.0, 0.0);
    const glm::dvec3 across = glm::normalize(glm::cross(beside, sun));
    const glm::dvec3 down = glm::cross(sun, across);
    const glm::dvec3 middle = eye + half * glm::normalize(forward);
    const double texel = 2.0 * half / shared::bladeShadowTexels;
    const auto stepped = [&](const glm::dvec3& axis) {
        return std::round(glm::dot(axis, middle) / texel) * texel;
    };
    const glm::dvec4 x(across / half, -stepped(across) / half);
    const glm::dvec4 y(down / half, -stepped(down) / half);
    const double length = (boxBehind + boxBefore) * half;
    const glm::dvec4 z(sun / length, (boxBehind * half - stepped(sun)) / length);
    return glm::transpose(glm::dmat4(x, y, z, glm::dvec4(0.0, 0.0, 0.0, 1.0)));
}

shared::BladeShadow bladeShadowOf(const glm::dmat4& toClip, std::uint64_t map)
{
    const glm::dmat4 rows = glm::transpose(toClip);
    const double half = 0.5 * shared::bladeShadowTexels;
    const glm::dvec4 middle(0.0, 0.0, 0.0, half);
    shared::BladeShadow shadow = {};
    shadow.map.address = map;
    shadow.across = glm::vec4(half * rows[0] + middle);
    shadow.down = glm::vec4(half * rows[1] + middle);
    shadow.depth = glm::vec4(rows[2]);
    shadow.size = shared::bladeShadowTexels;
    shadow.nearer = static_cast<float>(nearerBy);
    return shadow;
}

shared::Frame seenBySun(const shared::Frame& frame, const glm::dmat4& toClip)
{
    const glm::dmat4 rows = glm::transpose(toClip);
    const glm::dvec4 one(0.0, 0.0, 0.0, 1.0);
    shared::Frame seen = frame;
    seen.viewProjection = glm::mat4(toClip);
    const glm::vec4 planes[6] = {planeOf(one + rows[0]), planeOf(one - rows[0]),
                                 planeOf(one + rows[1]), planeOf(one - rows[1]),
                                 planeOf(one - rows[2]), planeOf(rows[2])};
    for (int i = 0; i < 6; ++i)
        seen.view.planes[i] = planes[i];
    seen.view.cullMask &= shared::cullDistance | shared::leaveThinned;
    seen.view.cullMask |= shared::cullPatch;
    seen.view.minWidth = 0.0f;
    seen.cullResults = 0;
    seen.pyramid = {};
    return seen;
}

} // namespace sward::render
