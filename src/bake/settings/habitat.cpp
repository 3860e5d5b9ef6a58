#include "bake/settings/habitat.h"

#include "core/math/exact_math.h"

#include <algorithm>

namespace sward::bake {
namespace {

constexpr double degreesPerRadian = 57.29577951308232;

// Cosine of an angle in degrees; beyond 180° nothing is excluded.
double cosineOf(double degrees)
{
    return exactSinCos(std::clamp(degrees, 0.0, 180.0) / degreesPerRadian).cos;
}

} // namespace

bool Habitat::needsGreen() const
{
    return std::any_of(masks.begin(), masks.end(),
                       [](const Mask& mask) { return mask.source == Mask::Source::groundGreen; });
}

HabitatWeight::HabitatWeight(const Habitat& habitat)
    : habitat_(habitat)
    , needsSlope_(habitat.needsSlope())
    , needsAltitude_(habitat.needsAltitude())
    , needsCurvature_(habitat.needsCurvature())
    , uprightLow_(cosineOf(habitat.slope.high))
    , uprightHigh_(cosineOf(habitat.slope.low))
{
    // Set the ends exactly, so that rounding excludes nothing.
    if (habitat.slope.low <= 0.0)
        uprightHigh_ = 2.0;
    if (habitat.slope.high >= 180.0)
        uprightLow_ = -2.0;
}

double HabitatWeight::slopeWeight(double upright) const
{
    if (upright >= uprightLow_ && upright <= uprightHigh_)
        return 1.0;
    if (habitat_.slope.soft <= 0.0)
        return 0.0;
    return habitat_.slope.weight(exactAcos(upright) * degreesPerRadian);
}

double HabitatWeight::at(const terrain::GroundMesh& ground, const RootSample& root,
                         const Site& site, double chance, Reject& reason) const
{
    double weight = 1.0;
    double least = 1.0;
    const auto falls = [&](Reject factorsReason, double factor) {
        weight *= factor;
        if (factor < least || weight <= chance)
            reason = factorsReason;
        least = std::min(least, factor);
        return weight <= chance;
    };
    for (const Mask& mask : habitat_.masks)
        if (falls(Reject::mask, mask.at(ground, root, site.green)))
            return weight;
    if (needsSlope_ && falls(Reject::slope, slopeWeight(site.upright)))
        return weight;
    if (needsAltitude_ && falls(Reject::altitude, habitat_.altitude.weight(site.altitude)))
        return weight;
    if (needsCurvature_)
        falls(Reject::curvature, habitat_.curvature.weight(site.curvature));
    return weight;
}

} // namespace sward::bake
