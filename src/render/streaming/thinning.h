#pragma once

#include "shaders/shared/eyepoint.h"

#include <algorithm>
#include <span>

namespace sward::render {

// While blades that a view draws are missing, the threshold of level of detail is raised by a
// factor, the thinning, until all that it draws is there (decision 0026).

/// Largest thinning. Wider blades would look like other blades; beyond it, missing blades leave
/// gaps in the picture.
constexpr float maxThinning = 8.0f;

/// Threshold by which missing blades are ranked if level of detail is off [pixels].
constexpr float rankingThreshold = 0.3f;

/// The thinning of the next frame on its way to `wanted`: it changes by a tenth at most. `now` 0:
/// there was no frame before.
inline float nextThinning(float now, float wanted)
{
    constexpr float step = 1.1f;
    return now == 0.0f ? wanted : std::clamp(wanted, now / step, now * step);
}

inline void setThreshold(std::span<shared::Eyepoint> views, float threshold)
{
    for (shared::Eyepoint& view : views)
        view.lodThreshold = threshold;
}

} // namespace sward::render
