#pragma once

#include "render/frame/wind.h"
#include "shaders/shared/wind.h"

#include <span>

namespace sward::render {

/// The pace of a source of the world, from its own direction, speed and size.
WindPace paceOf(const WindPattern& source);

/// How far the pattern of a source has moved on at `time` [s] since time 0. Computed in double
/// precision: the error is that of one rounding to single precision at any time, and of
/// 2⁻⁵³ · speed / size · time cells of noise.
shared::WindPhase phaseAt(const WindSource& wind, double time);

/// Moves the patterns of a wind, made by together() from blowing(sources, …), to `time` [s].
void moveTo(shared::Wind& wind, std::span<const WindSource> sources, double time);

} // namespace sward::render
