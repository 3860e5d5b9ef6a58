#pragma once

#include "render/frame/frame_settings.h"
#include "shaders/shared/frame.h"

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <optional>

namespace sward::render {

/// The part of the world around an eye that a shared::BladeShadow shows: a cube of the size of
/// FrameSettings::bladeShadowDistance whose middle lies before the eye, half as long again towards
/// the sun. From the eye's space to Vulkan's clip space: parallel, reversed Z. It moves in steps of
/// whole texels, so that shadows stay where they are. Unset if settings switch it off, or show no
/// light. `forward`: of any length.
std::optional<glm::dmat4> shadowBoxOf(glm::dvec3 eye, glm::dvec3 forward,
                                      const FrameSettings& settings);

/// What a frame knows of the map at this address; `toClip`: from the field's space.
shared::BladeShadow bladeShadowOf(const glm::dmat4& toClip, std::uint64_t map);

/// The frame of the sun's view, whose eye remains that of the picture: it decides which blades are
/// drawn, and how wide.
shared::Frame seenBySun(const shared::Frame& frame, const glm::dmat4& toClip);

} // namespace sward::render
