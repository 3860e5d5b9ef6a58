#include "apps/sward_view/internal_resolution.h"

#include <algorithm>
#include <cmath>

namespace sward::view {
namespace {

constexpr double ratio = 0.8;      ///< from one scale to the next lower
constexpr double tolerance = 1.15; ///< factor above the wanted time that is allowed
constexpr double room = 0.6;       ///< share of the wanted time below which the scale rises

// Largest thinning of blades: wider ones would look like leaves.
constexpr double maxThinning = 4.0;

// The largest available scale not above `scale`.
double stepBelow(double scale)
{
    const double steps = std::ceil(std::log(scale) / std::log(ratio) - 1e-9);
    return std::clamp(std::pow(ratio, std::max(steps, 0.0)), InternalResolution::lowest,
                      InternalResolution::highest);
}

} // namespace

void InternalResolution::add(double seconds)
{
    if (seconds > tolerance * wanted_) {
        // Assume time proportional to pixels, but at most halve the scale.
        quick_ = 0;
        const double share = std::max(std::sqrt(wanted_ / seconds), 0.5);
        scale_ = stepBelow(std::max(scale_ * share, lowest));
        return;
    }
    quick_ = seconds < room * wanted_ ? quick_ + 1 : 0;
    if (quick_ < patience || scale_ >= highest)
        return;
    quick_ = 0;
    scale_ = std::min(stepBelow(scale_) / ratio, highest);
}

render::FrameSettings thinnedForScale(render::FrameSettings settings, double scale)
{
    settings.lodThreshold *= static_cast<float>(std::min(1.0 / scale, maxThinning));
    return settings;
}

} // namespace sward::view
