#pragma once

#include "gpu/recording/statistics.h"
#include "render/frame/frame_settings.h"
#include "render/frame/frame_stats.h"

#include <glm/vec2.hpp>

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>

namespace sward::view {

/// Frames that `bench` draws before the measured ones.
struct WarmUp {
    std::uint64_t frames = 0;
    double seconds = 0;
};

/// Output of --stats and bench --json.
struct RunStats {
    std::string device;
    std::string driver;
    glm::uvec2 size{0};
    std::uint32_t samples = 0;
    std::string geometry;
    std::string geometryReason;
    render::FrameStats blades;                       ///< of the last frame
    std::map<std::string, gpu::Statistics> gpuTimes; ///< [ms], by the pass's name
    gpu::Statistics recordTime;                      ///< [ms]
    std::size_t deviceBytes = 0;
    std::size_t validationMessages = 0;
    std::optional<WarmUp> warmUp; ///< only for `bench`
};

/// The JSON text, indented, with a newline at the end. A pass that did not run has times of 0.
std::string statsText(const RunStats& stats);

} // namespace sward::view
