#pragma once

#include "render/frame/frame_settings.h"

namespace sward::view {

/// Chooses the share of the window's pixels that is drawn, to reach a frame rate. On a CPU a
/// picture of a quarter of the width takes about a tenth of the time.
class InternalResolution {
public:
    static constexpr double lowest = 0.16; ///< of width and height
    static constexpr double highest = 1.0;
    static constexpr double ratio = 0.8; ///< from one scale to the next lower

    /// `wanted` [s]: target frame time; `begin`: the first frame's scale.
    InternalResolution(double wanted, double begin)
        : wanted_(wanted)
        , scale_(begin)
    {
    }

    /// Reports the time of the next frame. The frame was drawn at scale(), or was in flight when
    /// that changed.
    void add(double seconds);

    /// Share of the window's width and height. Few steps, because a change creates new images.
    double scale() const { return scale_; }

private:
    void change(double scale, double seconds);
    void learn(double seconds);

    double wanted_;
    double scale_;
    int quick_ = 0;        ///< consecutive frames whose time would allow a higher scale
    int late_ = 4;         ///< coming frames that say nothing: the first ones create pipelines
    int steps_ = 0;        ///< by which the scale last changed; 0: their cost is known
    double before_ = 0.0;  ///< [s] time of a frame before them
    double growth_ = 1.25; ///< factor of the time for one step up; first half of that of pixels
};

/// Settings for a picture of `scale` (0, 1] of the width and height, on a CPU. Thins blades by the
/// growth of the pixel size, at most by 4, and does not move blades that are left out. Their cost
/// then depends on the pixels.
render::FrameSettings thinnedForScale(render::FrameSettings settings, double scale);

} // namespace sward::view
