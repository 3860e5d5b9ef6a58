#include "bake/bake.h"
#include "bake/mask/ground_green.h"
#include "bake/plan/plan.h"
#include "bake/sample/surface_sampler.h"

#include <algorithm>
#include <optional>

namespace sward::bake {
namespace {

/// Whether no mask is named, neither for all species nor for one.
bool isUnmasked(const BakeSettings& settings)
{
    return settings.masks.empty() &&
           std::ranges::all_of(settings.meadow.species, [](const SpeciesTraits& species) {
               return species.habitat.masks.empty();
           });
}

} // namespace

std::vector<Mask> defaultMasks(const terrain::GroundMesh& ground, const BakeSettings& settings)
{
    if (!isUnmasked(settings))
        return {};
    const double scale =
        settings.bladeScale.value_or(automaticScale(bearingArea(ground, settings.sides)));
    const std::optional<GreenShares> shares = greenShares(ground, scale, false);
    if (!shares || !shares->matter())
        return {};
    return {Mask{.source = Mask::Source::groundGreen}};
}

} // namespace sward::bake
