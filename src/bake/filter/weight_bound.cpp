#include "bake/filter/weight_bound.h"

#include "bake/filter/part_mask.h"
#include "core/math/exact_math.h"

#include <algorithm>

namespace sward::bake {
namespace {

constexpr double degreesOfRadian = 57.29577951308232;

// Wider than the rounding of a product of weights.
constexpr double weightSlack = 1e-9;

// Largest weight of a range on an interval.
double highest(const SoftRange& range, const Interval& values)
{
    if (values.high < range.low)
        return range.weight(values.high);
    return values.low > range.high ? range.weight(values.low) : 1.0;
}

Interval slopesOf(const Interval& upright)
{
    return {degreesOfRadian * exactAcos(upright.high), degreesOfRadian * exactAcos(upright.low)};
}

void lower(WeightBound& bound, double factor, Reject reason, double& lowest)
{
    bound.weight *= factor;
    if (factor >= lowest)
        return;
    lowest = factor;
    bound.reason = reason;
}

} // namespace

WeightBounds::WeightBounds(const terrain::GroundMesh& ground, const BakeSettings& settings,
                           const terrain::SurfaceFeatures* features)
    : ground_(ground)
    , settings_(settings)
    , features_(features)
    , everywhere_({settings.slope, settings.altitude, settings.curvature, settings.masks})
    , all_(placeOf(everywhere_))
{
    for (const SpeciesTraits& one : settings.meadow.species)
        species_.push_back(placeOf(one.habitat));
    testsAll_ = everywhere_.needsAnything() || settings.minIsland > 0.0 ||
                !settings.water.holds(-unbounded, unbounded);
    const std::vector<SpeciesTraits>& species = settings.meadow.species;
    testsSpecies_ = !species.empty() &&
                    std::all_of(species.begin(), species.end(), [](const SpeciesTraits& one) {
                        return one.cover < 1.0 || one.habitat.needsAnything();
                    });
}

WeightBounds::Place WeightBounds::placeOf(const Habitat& habitat)
{
    const auto cosine = [](double degrees) {
        return exactSinCos(std::clamp(degrees, 0.0, 180.0) / degreesOfRadian).cos;
    };
    return {&habitat, {cosine(habitat.slope.high), cosine(habitat.slope.low)}};
}

WeightBound WeightBounds::of(const Place& place, const SiteRange& range,
                             const GroundPart& part) const
{
    const Habitat& habitat = *place.habitat;
    WeightBound bound;
    double lowest = 1.0;
    const bool isSloped =
        range.upright.high < place.upright.low || range.upright.low > place.upright.high;
    if (habitat.needsSlope() && isSloped) // an arc cosine is slow
        lower(bound, highest(habitat.slope, slopesOf(range.upright)), Reject::slope, lowest);
    if (habitat.needsAltitude())
        lower(bound, highest(habitat.altitude, range.altitude), Reject::altitude, lowest);
    if (habitat.needsCurvature())
        lower(bound, highest(habitat.curvature, range.curvature), Reject::curvature, lowest);
    for (const Mask& mask : habitat.masks)
        if (bound.weight > 0.0 && isZeroOn(mask, ground_, part))
            lower(bound, 0.0, Reject::mask, lowest);
    return bound;
}

WeightBound WeightBounds::on(const GroundPart& part) const
{
    WeightBound bound;
    if (!lowersAny())
        return bound;
    const SiteRange range = siteRange(ground_, settings_.groundUp, features_, part);
    double lowest = 1.0;
    if (testsAll_) {
        if (settings_.minIsland > 0.0 &&
            double(features_->islandArea[part.triangle]) < settings_.minIsland)
            return {0.0, Reject::border};
        const WeightBound all = of(all_, range, part);
        lower(bound, all.weight, all.reason, lowest);
        lower(bound, highest(settings_.water, range.altitude), Reject::water, lowest);
    }
    if (testsSpecies_ && bound.weight > 0.0) {
        // As SpeciesMix adds them up.
        double presence = 0.0;
        Reject reason = Reject::mask;
        double best = -1.0;
        for (std::size_t i = 0; i < species_.size(); ++i) {
            const WeightBound own = of(species_[i], range, part);
            presence += settings_.meadow.species[i].cover * own.weight;
            if (own.weight > best)
                reason = own.reason;
            best = std::max(best, own.weight);
        }
        lower(bound, std::min(presence, 1.0), reason, lowest);
    }
    if (bound.weight > 0.0)
        bound.weight = std::min(bound.weight + weightSlack, 1.0);
    return bound;
}

} // namespace sward::bake
