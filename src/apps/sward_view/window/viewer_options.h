#pragma once

#include "apps/sward_view/scene/frame_options.h"

#include <optional>
#include <string>

namespace sward::view {

/// Bounds of the size of text and controls.
constexpr double smallestUiScale = 0.5;
constexpr double largestUiScale = 4.0;

/// Options of the window, in addition to the common ones.
struct ViewerOptions {
    const FrameOptions* frame = nullptr;
    std::string panel;        ///< that is open at first; "off": nothing but the picture
    std::string controlsFile; ///< output of the control map; empty: none
    std::string shaderFolder; ///< whose changes are compiled and shown; empty or "none": none
    std::string meadow;       ///< meadow name or file for meshes; empty: the first
    std::string ground;       ///< on which a field was baked, for painting; empty: none
    float resolution = 0.0f;  ///< drawn share of width and height; 0: by time
    std::optional<bool> refinesAtRest; ///< unset: on a CPU device with a resolution by time
    std::optional<float> uiScale;      ///< of texts and controls; unset: as the desktop asks for
    bool fitsScreen = true;            ///< whether the window's size follows the content scale
    double seconds = 0.0;              ///< [s] closes after the first field; 0: never
};

} // namespace sward::view
