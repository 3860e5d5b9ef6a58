#include "bake/seeds/seed_bake.h"

#include "bake/blades/blade_traits.h"
#include "bake/blades/clumps.h"
#include "bake/filter/root_filter.h"
#include "bake/filter/species_mix.h"
#include "bake/plan/plan.h"
#include "bake/plan/sward_cover.h"
#include "bake/sample/surface_sampler.h"
#include "bake/seeds/seed_cells.h"
#include "bake/seeds/seed_places.h"
#include "bake/seeds/seed_sites.h"
#include "core/error.h"
#include "shaders/shared/sow/sown_blade.h"

#include <glm/common.hpp>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace sward::bake {
namespace {

// Blades of a 32 m cell at its first level; finer levels have three quarters as many a patch, and a
// patch of more than 512 is split.
constexpr double bladesOfFirstLevel = 920.0;
constexpr double cellArea = 1024.0; // [m²] of a level cell
constexpr std::uint32_t finestLevel = 10;

// Blades of the lowest ranks that the field stores for the distance.
constexpr double storedPerSquareMetre = 1.5; // at blade scale 1
constexpr double minStored = 1e6;

constexpr double widestStored = 2.0; // factor on their widths, as planBake()

// Greatest factor of a blade's height by wide variation: as high as moisture of 1.5 makes it where
// nothing is grazed.
constexpr double maxWideHeight = 1.24;

// Blades on smaller scales have waves too short for their fixed point.
constexpr double smallestSeedScale = 1e-3;

// The setting that cannot be sown; null if all can.
const char* unsownSetting(const BakeSettings& settings, double scale)
{
    if (settings.spread != Spread::uniform)
        return "--sampling poisson: the place of a Poisson disk depends on its neighbours";
    if (settings.count)
        return "--count: it chooses among all candidates; use --density";
    if (growsTufts(settings.meadow))
        return "a meadow with tufts: their blades are moved on the ground";
    if (scale < smallestSeedScale)
        return "blades below a thousandth of their size: set a larger --blade-scale";
    return nullptr;
}

double scaleOf(const terrain::GroundMesh& ground, const BakeSettings& settings)
{
    return settings.bladeScale.value_or(automaticScale(bearingArea(ground, settings.sides)));
}

// The shared text knows the purposes of random numbers by these.
constexpr bool isDice(std::uint32_t number, Dimension dimension)
{
    return number == static_cast<std::uint32_t>(dimension);
}
static_assert(isDice(shared::sowChanceDice, Dimension::chance) &&
              isDice(shared::sowSpeciesDice, Dimension::species) &&
              isDice(shared::sowHeightDice, Dimension::height) &&
              isDice(shared::sowWidthDice, Dimension::width) &&
              isDice(shared::sowStiffnessDice, Dimension::stiffness) &&
              isDice(shared::sowFacingDice, Dimension::facing) &&
              isDice(shared::sowClumpDice, Dimension::clump) &&
              isDice(shared::sowDrynessDice, Dimension::dryness));

float narrow(double x)
{
    return static_cast<float>(x);
}

field::SeedMeadow seedMeadowOf(const BakeSettings& settings, const Plan& plan)
{
    const Meadow& own = settings.meadow;
    field::SeedMeadow meadow;
    meadow.seed = settings.seed;
    meadow.density = plan.density;
    meadow.scale = plan.scale;
    meadow.clumpSpacing = plan.clumpSpacing;
    meadow.heightWaves = narrow(own.heightWaves);
    meadow.drifts = narrow(own.drifts);
    meadow.sparseHeight = narrow(own.sparseHeight);
    meadow.wideVariation = narrow(own.wideVariation);
    meadow.creaseReach = narrow(creaseReach(own, plan.scale));
    meadow.creaseBlend = narrow(own.edges.creaseBlend);
    meadow.vertical = narrow(settings.align.vertical);
    meadow.isRadial = settings.groundUp.radial;
    meadow.up = meadow.isRadial ? settings.groundUp.centre : settings.groundUp.direction;
    meadow.isMixed = own.species.size() > 1 && std::any_of(own.species.begin(), own.species.end(),
                                                           [](const SpeciesTraits& one) {
                                                               return one.habitat.needsAnything();
                                                           });
    const bool hasFeet = settings.exposureRays > 0 && own.edges.occluderReach > 0.0;
    const double tallest = plan.scale * (1.0 + own.heightWaves) *
                           (1.0 + (maxWideHeight - 1.0) * own.wideVariation) *
                           (hasFeet ? std::max(own.edges.occluderHeight, 1.0) : 1.0);
    const SpeciesShares shares = SpeciesMix(own).evenShares();
    double highest = 0.0;
    double widest = 0.0;
    for (std::size_t slot = 0; slot < own.species.size(); ++slot) {
        const SpeciesTraits& species = own.species[slot];
        shared::SowSpecies sown = {};
        sown.share = narrow(shares.share[slot]);
        sown.heightLow = narrow(species.height.x * plan.scale);
        sown.heightRange = narrow((species.height.y - species.height.x) * plan.scale);
        sown.widthLow = narrow(species.width.x * plan.scale);
        sown.widthRange = narrow((species.width.y - species.width.x) * plan.scale);
        sown.stiffnessLow = narrow(species.stiffness.x);
        sown.stiffnessRange = narrow(species.stiffness.y - species.stiffness.x);
        sown.clumping = narrow(species.clumping);
        sown.facing = species.facing == Facing::outward  ? shared::sowOutward
                      : species.facing == Facing::shared ? shared::sowShared
                                                         : shared::sowFree;
        sown.ribbons = field::ribbonsOf(species.organs);
        meadow.species.push_back(sown);
        highest = std::max(highest, species.height.y * tallest);
        widest = std::max(widest, species.width.y * plan.scale);
        for (const field::Organ& organ : species.organs)
            widest = std::max(widest, species.height.y * tallest *
                                          double(std::max(organ.length.x, organ.length.y)) *
                                          double(organ.width));
    }
    meadow.highest = narrow(highest);
    meadow.widest = narrow(widest);

    const double perRoot = bladesPerRoot(own);
    double left = plan.density * perRoot * cellArea;
    while (left > bladesOfFirstLevel && meadow.levels < finestLevel) {
        left *= 0.25;
        ++meadow.levels;
    }
    const double all = plan.density * perRoot * plan.area;
    const double wanted =
        std::min(std::max(storedPerSquareMetre / (plan.scale * plan.scale) * plan.area, minStored),
                 double(settings.budget));
    // Whole levels, so that the last patches are full.
    meadow.stored = 1.0;
    for (std::uint32_t level = meadow.levels; level > 0 && meadow.stored * all > wanted; --level)
        meadow.stored *= 0.25;
    meadow.stored = std::min(meadow.stored, wanted / std::max(all, 1.0));
    return meadow;
}

// Distance [m] from which a clump may own a blade.
double clumpReach(const field::SeedMeadow& meadow)
{
    return 1.5 * meadow.clumpSpacing;
}

// Entries [begin, end) of one cell.
template <typename T>
std::pair<std::size_t, std::size_t> rangeOf(const std::vector<T>& list, const SeedCellNumber& cell,
                                            std::size_t from)
{
    std::size_t begin = from;
    while (begin < list.size() && list[begin].cell < cell)
        ++begin;
    std::size_t end = begin;
    while (end < list.size() && list[end].cell == cell)
        ++end;
    return {begin, end};
}

} // namespace

bool writesSeeds(const terrain::GroundMesh& ground, const BakeSettings& settings)
{
    if (settings.seeds == SeedUse::never)
        return false;
    const double scale = scaleOf(ground, settings);
    const char* const unsown = unsownSetting(settings, scale);
    if (settings.seeds == SeedUse::always) {
        if (unsown != nullptr)
            fail(ErrorKind::usage, "--seeds always cannot sow {}", unsown);
        return true;
    }
    // A number that somebody chose is stored, or refused by its limits.
    return unsown == nullptr && !settings.density &&
           closedDensity(settings.meadow) / (scale * scale) * bearingArea(ground, settings.sides) *
                   bladesPerRoot(settings.meadow) >
               double(std::max(settings.budget, usualBudget));
}

BakeSettings fullSettings(const BakeSettings& settings)
{
    BakeSettings full = settings;
    full.budget = std::numeric_limits<std::uint64_t>::max();
    full.maxBlades = std::numeric_limits<std::uint64_t>::max();
    return full;
}

void planSeeds(const terrain::GroundMesh& ground, const BakeSettings& settings, BakePlan& plan)
{
    field::SeedMeadow& meadow = plan.seeds.emplace(seedMeadowOf(settings, plan.plan));
    meadow.unitBits = SeedUnits(ground, meadow.scale, clumpReach(meadow)).bits();
    // Fewer blades are wider, and the ground shows the rest of the sward.
    const double missing = 1.0 / std::max(meadow.stored, 1e-9);
    meadow.storedWidening = std::min(std::sqrt(missing), widestStored);
    plan.plan.widening = meadow.storedWidening;
    plan.plan.thinned = std::clamp(missing / meadow.storedWidening, 1.0, field::maxThinned);
}

double seedMargin(const terrain::GroundMesh& ground, const BakeSettings& settings,
                  const BakePlan& plan)
{
    // Conditions are sampled on whole parts, which may begin in a cell and end outside of it.
    const double scale = plan.plan.scale;
    return (widestPart + 2.0 * creaseReach(settings.meadow, scale) +
            SeedSites::bareReach(settings, scale) +
            reachOf(ground, settings, scale, plan.plan.clumpSpacing) + 1.0) *
           1.001;
}

SeedPlaces seedPlacesOf(const terrain::GroundMesh& ground, const BakeSettings& settings,
                        const field::SeedMeadow& meadow, const TileRegion* tile)
{
    return seedPlaces(ground, settings, SeedUnits(meadow.unitBits), meadow.clumpSpacing,
                      clumpReach(meadow), tile);
}

field::Seeds makeSeeds(const GroundView& part, const BakeSettings& settings, const BakePlan& plan,
                       const TileRegion* tile, const TakeSeedCell& take, Progress& progress)
{
    const terrain::GroundMesh& ground = part.ground;
    field::Seeds seeds;
    seeds.meadow = *plan.seeds;
    const SeedUnits units(seeds.meadow.unitBits);
    RootFilter filter(ground, settings, part.rays, &part.features, plan.plan.scale);
    const SeedSites sites(ground, settings, plan.plan.scale, seeds.meadow, filter, part.rays,
                          part.features);
    const SeedPlaces places = seedPlacesOf(ground, settings, seeds.meadow, tile);
    const SeedCells maker(ground, settings, seeds.meadow, units, sites, places.centreCount);

    // The ranges of all cells that triangles touch, then batches of them: cells are made by several
    // threads and appended in order.
    struct Ranges {
        std::pair<std::size_t, std::size_t> parts;
        std::pair<std::size_t, std::size_t> centres;
    };
    std::vector<Ranges> ranges;
    for (std::size_t next = 0, centre = 0; next < places.parts.size();) {
        const SeedCellNumber cell = places.parts[next].cell;
        ranges.push_back(
            {rangeOf(places.parts, cell, next), rangeOf(places.centres, cell, centre)});
        next = ranges.back().parts.second;
        centre = ranges.back().centres.second;
    }
    progress.begin("seeds", ranges.size());
    constexpr std::size_t batch = 256;
    struct Made {
        field::SeedEntry entry;
        UninitializedVector<std::byte> packed;
    };
    for (std::size_t first = 0; first < ranges.size(); first += batch) {
        std::vector<Made> made(std::min(batch, ranges.size() - first));
        tbb::parallel_for(std::size_t(0), made.size(), [&](std::size_t i) {
            const auto& [parts, centres] = ranges[first + i];
            const field::SeedCell cell = maker.make(
                std::span(places.parts).subspan(parts.first, parts.second - parts.first),
                std::span(places.centres).subspan(centres.first, centres.second - centres.first));
            if (!cell.pieces.empty()) {
                take(cell);
                made[i] = {field::entryOf(cell), field::packSeedCell(cell, seeds.meadow.isMixed)};
            }
            progress.advance(1);
        });
        progress.throwIfCancelled();
        for (const Made& one : made)
            if (!one.packed.empty())
                field::addSeedCell(seeds, one.entry, one.packed);
    }
    return seeds;
}

} // namespace sward::bake
