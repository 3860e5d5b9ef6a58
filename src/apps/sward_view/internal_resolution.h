#pragma once

#include "render/frame_settings.h"

namespace sward::view {

/// How many of the window's pixels are drawn, so that frames come often enough: on a CPU a picture
/// of a quarter of the width is a matter of a tenth of the time.
class InternalResolution {
public:
    static constexpr double lowest = 0.16; ///< of width and height
    static constexpr double highest = 1.0;

    /// `wanted` [s]: what a frame may take; `begin`: the first frame's scale.
    InternalResolution(double wanted, double begin)
        : wanted_(wanted)
        , scale_(begin)
    {
    }

    /// Tells how long a frame took that was drawn at scale().
    void add(double seconds);

    /// Of the window's width and height. Changes in few steps, since each costs new pictures.
    double scale() const { return scale_; }

private:
    static constexpr int patience = 6; ///< frames that agree before the scale rises

    double wanted_;
    double scale_;
    int quick_ = 0; ///< frames in a row that left room for more pixels
};

/// Settings for a picture of `scale` (0, 1] of the width and height, on a CPU: blades are thinned
/// as much more as its pixels are larger, at most by 4, and those left out are not moved. What they
/// cost then follows from the pixels.
render::FrameSettings thinnedForScale(render::FrameSettings settings, double scale);

} // namespace sward::view
