#pragma once

#include "apps/sward_view/frame_options.h"

#include <string>

namespace sward::view {

/// What the window is opened with, beside what every command has.
struct ViewerOptions {
    const FrameOptions* frame = nullptr;
    std::string panel;        ///< that is open at first; "off": nothing but the picture
    std::string controlsFile; ///< where each control is told; empty: nowhere
    std::string shaderFolder; ///< whose changes are compiled and shown; empty or "none": none
    std::string meadow;       ///< name or file of what is sown on a mesh; empty: the first
    float resolution = 0.0f;  ///< share of the window's width and height that is drawn; 0: by time
    double seconds = 0.0;     ///< closes by itself so long after the first field is there
};

} // namespace sward::view
