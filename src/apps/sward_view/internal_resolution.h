#pragma once

#include "render/frame_settings.h"

namespace sward::view {

/// Chooses the share of the window's pixels that is drawn, to reach a frame rate. On a CPU a
/// picture of a quarter of the width takes about a tenth of the time.
class InternalResolution {
public:
    static constexpr double lowest = 0.16; ///< of width and height
    static constexpr double highest = 1.0;

    /// `wanted` [s]: target frame time; `begin`: the first frame's scale.
    InternalResolution(double wanted, double begin)
        : wanted_(wanted)
        , scale_(begin)
    {
    }

    /// Reports the time of a frame drawn at scale().
    void add(double seconds);

    /// Share of the window's width and height. Few steps, because a change creates new images.
    double scale() const { return scale_; }

private:
    static constexpr int patience = 6; ///< consecutive fast frames before the scale rises

    double wanted_;
    double scale_;
    int quick_ = 0; ///< consecutive fast frames
};

/// Settings for a picture of `scale` (0, 1] of the width and height, on a CPU. Thins blades by the
/// growth of the pixel size, at most by 4, and does not move blades that are left out. Their cost
/// then depends on the pixels.
render::FrameSettings thinnedForScale(render::FrameSettings settings, double scale);

} // namespace sward::view
