#include "bake/whole/report_totals.h"

#include "bake/sample/surface_sampler.h"
#include "bake/whole/warnings.h"
#include "core/error.h"
#include "terrain/load.h"
#include "terrain/maps/map_places.h"

#include <algorithm>
#include <cmath>

namespace sward::bake {
namespace {

// Fills in the distances between roots.
void fillSpacing(Report& report, double minimum, const BakeSettings& settings, const BakePlan& plan)
{
    if (settings.spread == Spread::uniform)
        return;
    report.spacingRequested = settings.spacing ? *settings.spacing : plan.roots.spacing;
    report.spacingMinimum = minimum;
    const double bearing = plan.roots.bearing.value_or(0.0);
    if (!settings.strokes.empty() || !plan.roots.bearing)
        report.relativeRadius.reset();
    else if (report.kept > 0 && bearing > 0.0)
        report.relativeRadius =
            minimum / std::sqrt(2.0 * bearing / (std::sqrt(3.0) * double(report.kept)));
}

bool needsAltitude(const BakeSettings& settings)
{
    const auto restricts = [](const SoftRange& range) {
        return !range.holds(-unbounded, unbounded);
    };
    bool any = restricts(settings.altitude) || restricts(settings.water);
    for (const SpeciesTraits& species : settings.meadow.species)
        any = any || species.habitat.needsAltitude();
    return any;
}

// Altitude range of the bearing ground, measured as --altitude does.
SoftRange altitudesOf(const terrain::GroundMesh& ground, const GroundUp& groundUp)
{
    SoftRange range{unbounded, -unbounded, 0.0};
    for (std::size_t t = 0; t < ground.triangles.size(); ++t)
        for (glm::length_t corner = 0; ground.bears[t] != 0 && corner < 3; ++corner) {
            const glm::dvec3 place =
                ground.origin + glm::dvec3(ground.positions[ground.triangles[t][corner]]);
            const double altitude = groundUp.altitude(place);
            range.low = std::min(range.low, altitude);
            range.high = std::max(range.high, altitude);
        }
    return range;
}

// What each mask reads of the ground.
std::vector<Report::MaskUse> maskUses(const BakeSettings& settings)
{
    std::vector<Report::MaskUse> uses;
    const auto add = [&](const std::vector<Mask>& masks) {
        for (const Mask& mask : masks)
            uses.push_back({textOf(mask), mask.attributeName()});
    };
    add(settings.masks);
    for (const SpeciesTraits& species : settings.meadow.species)
        add(species.habitat.masks);
    return uses;
}

void add(Report::Timing& sum, const Report::Timing& more)
{
    sum.rays += more.rays;
    sum.sample += more.sample;
    sum.sampleBusy += more.sampleBusy;
    sum.traits += more.traits;
    sum.patches += more.patches;
}

} // namespace

void Totals::add(const TileResult& tile)
{
    counts.kept += tile.counts.kept;
    for (const CellTree& cell : tile.cells)
        for (const shared::Patch& patch : cell.patches)
            blades += patch.bladeCount;
    counts.undersides += tile.counts.undersides;
    counts.proposed += tile.counts.proposed;
    for (std::size_t i = 0; i < rejectCount; ++i)
        counts.rejected[i] += tile.counts.rejected[i];
    if (tile.spacingMinimum > 0.0)
        spacingMinimum = spacingMinimum > 0.0 ? std::min(spacingMinimum, tile.spacingMinimum)
                                              : tile.spacingMinimum;
    bake::add(timing, tile.timing);
}

void Totals::fill(Report& report, double factor) const
{
    const auto scaled = [&](std::uint64_t n) {
        return static_cast<std::uint64_t>(std::llround(double(n) * factor));
    };
    report.kept = scaled(counts.kept);
    report.proposed = scaled(counts.proposed);
    for (std::size_t i = 0; i < rejectCount; ++i)
        report.rejected[i] = scaled(counts.rejected[i]);
    report.densityReached = report.input.area > 0.0 ? double(report.kept) / report.input.area : 0.0;
    bake::add(report.timing, timing);
}

void finishReport(Report& report, const Totals& totals, const BakeSettings& settings,
                  const BakePlan& plan, Diagnostics& diagnostics)
{
    if (settings.count && settings.strokes.empty() && totals.counts.kept < *settings.count &&
        totals.counts.kept > 0)
        fail(ErrorKind::input, "--count {}: the ground keeps only {} of its candidates",
             *settings.count, totals.counts.kept);
    if (!settings.strokes.empty() && totals.blades > settings.maxBlades)
        fail(
            ErrorKind::input,
            "--paint {}: {} blades, ribbons of plants included, grow with these strokes, more than "
            "--max-blades {}",
            settings.strokes.file, totals.blades, settings.maxBlades);
    report.bladeScale = plan.plan.scale;
    report.masks = maskUses(settings);
    report.densityRequested = settings.count ? 0.0 : plan.plan.density;
    report.densityClosed = plan.plan.closedDensity;
    report.widening = plan.plan.widening;
    totals.fill(report, 1.0);
    fillSpacing(report, totals.spacingMinimum, settings, plan);
    warnAboutRoots(totals.counts, report.input, settings, plan.plan, diagnostics);
}

Report reportOf(const terrain::GroundMesh& ground, const BakeSettings& settings, int threads)
{
    Report report;
    const Aabb box = ground.bounds();
    report.input.triangles = ground.triangles.size();
    report.input.area = bearingArea(ground, Sides::front);
    report.input.low = ground.origin + glm::dvec3(box.low);
    report.input.high = ground.origin + glm::dvec3(box.high);
    if (needsAltitude(settings))
        report.input.altitudes = altitudesOf(ground, settings.groundUp);
    report.input.hash = terrain::contentHash(ground);
    report.input.mapSystem = terrain::systemName(ground.mapSystem);
    report.seed = settings.seed;
    report.masks = maskUses(settings);
    report.slope = settings.slope;
    report.threads = threads;
    const double scale = settings.bladeScale.value_or(automaticScale(report.input.area));
    report.colors = greenShares(ground, scale, masksByVertexColor(settings));
    return report;
}

} // namespace sward::bake
