#include "bake/bake_steps.h"

#include "bake/display_ground.h"
#include "bake/plan.h"
#include "bake/root_source.h"
#include "bake/surface_sampler.h"
#include "bake/warnings.h"
#include "core/error.h"
#include "terrain/load.h"
#include "terrain/surface_query.h"
#include "terrain/topology.h"

#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace sward::bake {
namespace {

// What a viewer starts with on this ground.
field::Defaults defaultsFor(const BakeSettings& settings, double scale)
{
    field::Defaults defaults;
    const auto lengths = static_cast<float>(scale);
    defaults.wind.waveLength *= lengths;
    defaults.wind.speed *= lengths;
    defaults.wind.gustSize *= lengths;
    if (settings.groundUp.radial) {
        defaults.attractor = settings.groundUp.centre;
        defaults.attractorBlend = 1.0f;
    } else {
        defaults.gravityDirection = -glm::vec3(settings.groundUp.direction);
        // Wind blows along the ground, whichever way that lies.
        const glm::vec3 up(settings.groundUp.direction);
        const glm::vec3 along =
            defaults.wind.direction - up * glm::dot(up, defaults.wind.direction);
        defaults.wind.direction = glm::normalize(along);
    }
    return defaults;
}

std::string provenanceOf(const BakeSettings& settings, const Report& report)
{
    const nlohmann::json object = {{"tool", "sward 0.1.0"},
                                   {"input_hash", report.input.hash},
                                   {"blade_scale", report.bladeScale},
                                   {"settings", nlohmann::json::parse(toJson(settings))}};
    return object.dump();
}

// What is reported of the distances between roots.
void fillSpacing(Report& report, double minimum, const BakeSettings& settings, const BakePlan& plan)
{
    if (settings.spread == Spread::uniform)
        return;
    report.spacingRequested = settings.spacing ? *settings.spacing : plan.roots.spacing;
    report.spacingMinimum = minimum;
    const double sides = settings.sides == Sides::both ? 2.0 : 1.0;
    if (report.kept > 0)
        report.relativeRadius = minimum / std::sqrt(2.0 * sides * report.input.area /
                                                    (std::sqrt(3.0) * double(report.kept)));
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

// Heights of the ground that bears, as --altitude has them.
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

void add(Report::Timing& sum, const Report::Timing& more)
{
    sum.rays += more.rays;
    sum.sample += more.sample;
    sum.traits += more.traits;
    sum.patches += more.patches;
}

} // namespace

double extentOf(const terrain::GroundMesh& ground)
{
    const glm::vec3 size = ground.bounds().size();
    return double(std::max({size.x, size.y, size.z}));
}

terrain::SurfaceFeatures featuresOf(const terrain::GroundMesh& ground, const BakeSettings& settings)
{
    checkGround(ground, settings);
    const terrain::FeatureChoice choice = featuresFor(settings);
    return choice.any() ? findFeatures(ground, terrain::analyse(ground), choice)
                        : terrain::SurfaceFeatures{};
}

BakePlan planWhole(const GroundView& whole, const BakeSettings& settings, Diagnostics& diagnostics,
                   Progress& progress)
{
    const terrain::GroundMesh& ground = whole.ground;
    BakePlan plan;
    plan.plan =
        planBake(bearingArea(ground, settings.sides), extentOf(ground), settings, diagnostics);
    // Only a count makes the whole ground be sampled, and only some filters then ask for rays.
    std::optional<terrain::SurfaceQuery> query;
    const terrain::SurfaceQuery* rays = whole.rays;
    if (rays == nullptr && settings.count && filterNeedsRays(ground, settings))
        rays = &query.emplace(ground);
    const RootFilter filter(ground, settings, rays, &whole.features, plan.plan.scale);
    plan.roots = planRoots(ground, settings, filter, plan.plan, progress);
    return plan;
}

void Totals::add(const TileResult& tile)
{
    counts.kept += tile.counts.kept;
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
    if (settings.count && totals.counts.kept < *settings.count && totals.counts.kept > 0)
        fail(ErrorKind::input, "--count {}: the ground keeps only {} of its candidates",
             *settings.count, totals.counts.kept);
    report.bladeScale = plan.plan.scale;
    report.densityRequested = settings.count ? 0.0 : plan.plan.density;
    totals.fill(report, 1.0);
    fillSpacing(report, totals.spacingMinimum, settings, plan);
    warnAboutRoots(totals.counts, report.input, settings, diagnostics);
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
    report.seed = settings.seed;
    report.threads = threads;
    return report;
}

field::Field fieldWithoutBlades(const terrain::GroundMesh& ground, const BakeSettings& settings,
                                const BakePlan& plan, const Report& report)
{
    field::Field field;
    field.origin = ground.origin;
    field.copyright = ground.copyright;
    for (const SpeciesTraits& species : settings.meadow.species)
        field.species.push_back({species.name, species.look});
    field.ground = displayGround(ground, masksByVertexColor(settings));
    field.defaults = defaultsFor(settings, plan.plan.scale);
    field.provenance = provenanceOf(settings, report);
    return field;
}

int threadCount(int threads)
{
    return threads > 0 ? threads : tbb::info::default_concurrency();
}

void withThreads(int threads, const std::function<void()>& work)
{
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(threads));
    tbb::task_arena arena(threads);
    arena.execute(work);
}

} // namespace sward::bake
