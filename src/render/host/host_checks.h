#pragma once

#include "render/grass.h"

#include <cstddef>

namespace sward::render {

// Throw Error{usage} that names the member, its value and the bound.

void requireValid(const Placement& placement);
void requireValid(const Grass::Settings& settings);

/// Lengths of the lists of a frame.
struct FrameCounts {
    std::size_t views = 0;
    std::size_t colliders = 0;
    std::size_t lamps = 0;
};
void requireCounts(const FrameCounts& counts, const Grass::Settings& settings);

/// A frame of a Grass with these settings.
void requireValid(const GrassFrame& frame, const Grass::Settings& settings);

/// Winds and other lists of bounded length, and directions without length.
void requireValid(const FrameSettings& settings);

} // namespace sward::render
