#include "gpu/frame/sowing/sown_meadow.h"

#include "bake/bake.h"
#include "bake/seeds/grow_field.h"
#include "bake/settings/meadow.h"
#include "core/diagnostics.h"
#include "core/progress.h"
#include "field/seeds/seeds.h"
#include "support/meshes.h"

#include <memory>
#include <utility>

namespace sward::test {

SownMeadow sownMeadow(double side, std::uint32_t cells, std::optional<double> density,
                      double stored)
{
    bake::BakeSettings settings;
    settings.meadow = bake::loadMeadow("meadow");
    settings.density = density;
    settings.exposureRays = 0;
    settings.bladeScale = 1.0;
    settings.seeds = bake::SeedUse::always;
    Diagnostics diagnostics;
    Progress progress;
    field::Field baked =
        bake::bakeField(meshes::hills(side, cells), settings, 1, diagnostics, progress).field;
    const auto grow = [&](double share) {
        bake::Growth growth;
        growth.region.share = static_cast<float>(share);
        return bake::growField(field::viewOf(baked), growth, 2, "seeded", progress);
    };
    field::Seeds seeds = baked.seeds->seeds;
    seeds.meadow.stored = stored;
    seeds.meadow.storedWidening = 1.0; // as growField() leaves them
    SownMeadow meadow{grow(1.0), grow(stored)};
    meadow.seeded.seeds = std::make_shared<const field::SharedSeeds>(std::move(seeds));
    return meadow;
}

} // namespace sward::test
