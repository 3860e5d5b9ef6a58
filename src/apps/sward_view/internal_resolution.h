#pragma once

namespace sward::view {

/// How many of the window's pixels are drawn, so that frames come often enough: on a CPU a picture
/// of a quarter of the width is a matter of a tenth of the time.
class InternalResolution {
public:
    static constexpr double lowest = 0.2; ///< of width and height
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

} // namespace sward::view
