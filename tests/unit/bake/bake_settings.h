#pragma once

#include "bake/settings/meadow.h"
#include "bake/settings/settings.h"

namespace sward::tests {

/// Settings with one plain species, no rays and a density that suits unit-sized meshes.
inline bake::BakeSettings plainSettings(double density)
{
    bake::BakeSettings settings;
    settings.density = density;
    settings.exposureRays = 0;
    settings.bladeScale = 1.0;
    settings.meadow.clumpSize = 0.0;
    settings.meadow.species.emplace_back();
    return settings;
}

/// Settings with the meadow of all built-in species, and no rays.
inline bake::BakeSettings meadowSettings(double density)
{
    bake::BakeSettings settings;
    settings.meadow = bake::loadMeadow("meadow");
    settings.density = density;
    settings.exposureRays = 0;
    settings.bladeScale = 1.0;
    settings.seed = 5;
    return settings;
}

} // namespace sward::tests
