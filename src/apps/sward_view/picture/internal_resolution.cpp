#include "apps/sward_view/picture/internal_resolution.h"

#include <algorithm>
#include <cmath>

namespace sward::view {
namespace {

constexpr double tolerance = 1.15; ///< factor above the wanted time that is allowed
constexpr double aim = 1.1; ///< factor above the wanted time that a rise may be expected to take
constexpr double maxGrowth = 1.6; ///< of a step's time; that of its pixels is 1.5625
constexpr int patience = 6;       ///< consecutive fast frames before the scale rises
constexpr int inFlight = 2; ///< frames drawn at the former scale whose times are still reported

// Largest thinning of blades: wider ones would look like leaves.
constexpr double maxThinning = 4.0;

// The largest available scale not above `scale`.
double stepBelow(double scale)
{
    const double steps = std::ceil(std::log(scale) / std::log(InternalResolution::ratio) - 1e-9);
    return std::clamp(std::pow(InternalResolution::ratio, std::max(steps, 0.0)),
                      InternalResolution::lowest, InternalResolution::highest);
}

} // namespace

void InternalResolution::add(double seconds)
{
    if (late_ > 0) {
        --late_;
        return;
    }
    learn(seconds);
    if (seconds > tolerance * wanted_) {
        // Assume time proportional to pixels, but at most halve the scale.
        const double share = std::max(std::sqrt(wanted_ / seconds), 0.5);
        change(stepBelow(std::max(scale_ * share, lowest)), seconds);
        return;
    }
    // Part of a frame's time does not depend on pixels: expect what the last step has cost.
    quick_ = growth_ * seconds < aim * wanted_ ? quick_ + 1 : 0;
    if (quick_ >= patience)
        change(std::min(stepBelow(scale_) / ratio, highest), seconds);
}

void InternalResolution::change(double scale, double seconds)
{
    quick_ = 0;
    if (scale == scale_)
        return;
    steps_ = static_cast<int>(std::lround(std::log(scale_ / scale) / std::log(ratio)));
    before_ = seconds;
    scale_ = scale;
    late_ = inFlight;
}

void InternalResolution::learn(double seconds)
{
    // No frame costs more than its pixels: then something else was slow.
    if (steps_ != 0 && seconds > 0.0) {
        const double growth = std::pow(seconds / before_, 1.0 / steps_);
        growth_ = growth < maxGrowth ? std::max(growth, 1.0) : growth_;
    }
    steps_ = 0;
}

render::FrameSettings thinnedForScale(render::FrameSettings settings, double scale)
{
    settings.lodThreshold *= static_cast<float>(std::min(1.0 / scale, maxThinning));
    // They take a CPU as long as a third of the picture; at rest they are drawn.
    settings.bladeShadows = settings.bladeShadows && scale >= 1.0;
    return settings;
}

} // namespace sward::view
