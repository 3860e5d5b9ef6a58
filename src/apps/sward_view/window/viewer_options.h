#pragma once

#include "apps/sward_view/frame_options.h"

#include <optional>
#include <string>

namespace sward::view {

/// Options of the window, in addition to the common ones.
struct ViewerOptions {
    const FrameOptions* frame = nullptr;
    std::string panel;        ///< that is open at first; "off": nothing but the picture
    std::string controlsFile; ///< output of the control map; empty: none
    std::string shaderFolder; ///< whose changes are compiled and shown; empty or "none": none
    std::string meadow;       ///< meadow name or file for meshes; empty: the first
    float resolution = 0.0f;  ///< drawn share of width and height; 0: by time
    std::optional<bool> refinesAtRest; ///< unset: on a CPU device with a resolution by time
    double seconds = 0.0;              ///< [s] closes after the first field; 0: never
};

} // namespace sward::view
