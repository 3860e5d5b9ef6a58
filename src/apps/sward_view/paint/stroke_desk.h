#pragma once

#include <cstddef>
#include <optional>
#include <string>

namespace sward::view {

/// What the user does with the list of strokes.
struct StrokeDesk {
    std::optional<std::size_t> hovered; ///< stroke under the mouse: shown on the ground
    std::optional<std::size_t> renamed; ///< stroke whose name is typed
    std::string name;                   ///< as it is typed
    float moveBy = 2.0f;                ///< [m] that strokes are moved onto the ground at most
    bool takesSpecies = false;          ///< the next click takes the species of a blade
};

} // namespace sward::view
