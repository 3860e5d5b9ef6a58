#pragma once

namespace sward::view {

/// What the interface covers, in the window's coordinates; 0: it is not shown.
struct Covered {
    float rail = 0.0f;   ///< width on the left
    float panel = 0.0f;  ///< width beside the rail
    float status = 0.0f; ///< height below
};

} // namespace sward::view
