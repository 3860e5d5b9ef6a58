#include "bake/bake.h"

#include "bake/blade_traits.h"
#include "bake/display_ground.h"
#include "bake/exposure.h"
#include "bake/patches.h"
#include "bake/plan.h"
#include "bake/spatial_order.h"
#include "bake/surface_sampler.h"
#include "bake/warnings.h"
#include "core/error.h"
#include "field/write.h"
#include "terrain/load.h"

#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_invoke.h>
#include <tbb/task_arena.h>

#include <chrono>
#include <cmath>
#include <optional>

namespace sward::bake {
namespace {

// Seconds since it was last asked.
class Stopwatch {
public:
    double lap()
    {
        const auto now = std::chrono::steady_clock::now();
        const double seconds = std::chrono::duration<double>(now - last_).count();
        last_ = now;
        return seconds;
    }

private:
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

Report reportOf(const terrain::GroundMesh& ground, const BakeSettings& settings, int threads)
{
    Report report;
    const Aabb box = ground.bounds();
    report.input.triangles = ground.triangles.size();
    for (std::size_t t = 0; t < ground.triangles.size(); ++t)
        report.input.area += ground.bears[t] != 0 ? ground.area(t) : 0.0;
    report.input.low = ground.origin + glm::dvec3(box.low);
    report.input.high = ground.origin + glm::dvec3(box.high);
    report.input.hash = terrain::contentHash(ground);
    report.seed = settings.seed;
    report.threads = threads;
    return report;
}

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

// The bake itself, inside the arena that bounds its threads.
class Baker {
public:
    Baker(const terrain::GroundMesh& ground, const BakeSettings& settings, Diagnostics& diagnostics,
          Progress& progress)
        : ground_(ground)
        , settings_(settings)
        , diagnostics_(diagnostics)
        , progress_(progress)
    {
    }

    void prepare(Report& report)
    {
        checkGround(ground_, settings_);
        lookAround(report);
        const double area = bearingArea(ground_, settings_);
        plan_ = planBake(area, settings_, diagnostics_);
        report.bladeScale = plan_.scale;
        const terrain::SurfaceQuery* const query = query_ ? &*query_ : nullptr;
        filter_.emplace(ground_, settings_, query, &features_, plan_.scale);
        grower_.emplace(ground_, settings_, BladeGrower::Whole{plan_.scale, area}, *filter_, query);
        sampler_.emplace(ground_, settings_, *filter_);
    }

    const Plan& plan() const { return plan_; }

    Sampling sample(double density, Report& report)
    {
        const Amount amount =
            settings_.count ? sampler_->amountFor(*settings_.count, progress_) : Amount{density};
        Sampling sampling = sampler_->sample(amount, progress_);
        report.timing.sample = watch_.lap();
        sortSpatially(ground_, sampling.roots);
        return sampling;
    }

    // Everything after the roots are known.
    field::Field grow(Sampling& sampling, Report& report)
    {
        field::Field field;
        field.origin = ground_.origin;
        field.copyright = ground_.copyright;
        std::vector<float> exposure;
        if (settings_.exposureRays > 0)
            exposure = castExposure(sampling.roots, ground_, settings_,
                                    settings_.rayLength * plan_.scale, *query_, progress_);
        report.timing.rays += watch_.lap();
        const std::vector<shared::Blade> blades =
            growBlades(sampling.roots, exposure, *grower_, progress_);
        report.timing.traits = watch_.lap();

        const PatchTree tree = buildPatches(blades, ground_, sampling.roots, progress_);
        field.patches = tree.patches;
        field.blades.resize(blades.size());
        field.keys.resize(blades.size());
        for (const shared::Patch& patch : field.patches)
            for (std::uint32_t i = patch.firstBlade; i < patch.firstBlade + patch.bladeCount; ++i) {
                field.blades[i] = shared::packBlade(blades[tree.bladeOrder[i]], patch);
                field.keys[i] = keyOf(ground_, sampling.roots[tree.bladeOrder[i]]);
            }
        for (const SpeciesTraits& species : settings_.meadow.species)
            field.species.push_back({species.name, species.look});
        field.ground = displayGround(ground_, masksByVertexColor(settings_));
        field.defaults = defaultsFor(settings_, plan_.scale);
        field.provenance = provenanceOf(settings_, report);
        report.timing.patches = watch_.lap();
        return field;
    }

private:
    // Prepares rays, and beside it what the connections of the ground tell, each if asked for.
    void lookAround(Report& report)
    {
        const terrain::FeatureChoice choice = featuresFor(settings_);
        const bool castsRays = settings_.exposureRays > 0 || filterNeedsRays(ground_, settings_) ||
                               growsTufts(settings_.meadow);
        if (castsRays || choice.any())
            progress_.begin("rays", 1);
        double connecting = 0.0;
        tbb::parallel_invoke(
            [&] {
                if (castsRays)
                    query_.emplace(ground_);
            },
            [&] {
                if (!choice.any())
                    return;
                Stopwatch watch;
                features_ = findFeatures(ground_, terrain::analyse(ground_), choice);
                connecting = watch.lap();
            });
        report.timing.topology = connecting;
        report.timing.rays = std::max(watch_.lap() - connecting, 0.0);
    }

    const terrain::GroundMesh& ground_;
    const BakeSettings& settings_;
    Diagnostics& diagnostics_;
    Progress& progress_;
    Stopwatch watch_;
    std::optional<terrain::SurfaceQuery> query_;
    terrain::SurfaceFeatures features_;
    std::optional<RootFilter> filter_;
    std::optional<BladeGrower> grower_;
    std::optional<SurfaceSampler> sampler_;
    Plan plan_;
};

// Runs `work` on so many threads.
template <typename Work>
void withThreads(int threads, Work work)
{
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(threads));
    tbb::task_arena arena(threads);
    arena.execute(work);
}

int threadCount(int threads)
{
    return threads > 0 ? threads : tbb::info::default_concurrency();
}

void fillCounts(Report& report, const Sampling& sampling, double factor)
{
    const auto scaled = [&](std::uint64_t n) {
        return static_cast<std::uint64_t>(std::llround(double(n) * factor));
    };
    report.kept = scaled(sampling.roots.size());
    report.proposed = report.kept;
    for (std::size_t i = 0; i < rejectCount; ++i) {
        report.rejected[i] = scaled(sampling.rejected[i]);
        report.proposed += report.rejected[i];
    }
    report.densityReached = report.input.area > 0.0 ? double(report.kept) / report.input.area : 0.0;
}

// Bytes a blade's candidate number adds for each doubling of the candidates on a triangle.
constexpr double bytesPerDoubling = 1.0 / 8.0;

} // namespace

BakeResult bakeField(const terrain::GroundMesh& ground, const BakeSettings& settings, int threads,
                     Diagnostics& diagnostics, Progress& progress)
{
    validate(settings);
    BakeResult result;
    result.report = reportOf(ground, settings, threadCount(threads));
    Report& report = result.report;
    withThreads(report.threads, [&] {
        Baker baker(ground, settings, diagnostics, progress);
        baker.prepare(report);
        report.densityRequested = settings.count ? 0.0 : baker.plan().density;
        Sampling sampling = baker.sample(baker.plan().density, report);
        if (settings.count && sampling.roots.size() < *settings.count && !sampling.roots.empty())
            fail(ErrorKind::input, "--count {}: the ground keeps only {} of its candidates",
                 *settings.count, sampling.roots.size());
        fillCounts(report, sampling, 1.0);
        warnAboutRoots(sampling, ground, settings, diagnostics);
        result.field = baker.grow(sampling, report);
    });
    report.output.patches = result.field.patches.size();
    report.warnings = diagnostics.warnings();
    return result;
}

Report estimateBake(const terrain::GroundMesh& ground, const BakeSettings& settings, int threads,
                    Diagnostics& diagnostics, Progress& progress)
{
    validate(settings);
    Report report = reportOf(ground, settings, threadCount(threads));
    constexpr double sampleSize = 400'000.0;
    withThreads(report.threads, [&] {
        // Bake a thin field by the same steps …
        BakeSettings thin = settings;
        thin.count.reset();
        const double area = bearingArea(ground, settings);
        const Plan plan = planBake(area, settings, diagnostics);
        report.bladeScale = plan.scale;
        if (area <= 0.0)
            return;
        const double wanted = settings.count ? sampleSize : plan.expected;
        thin.density = std::min(wanted, sampleSize) / area;
        thin.bladeScale = plan.scale;
        Baker baker(ground, thin, diagnostics, progress);
        baker.prepare(report);
        Sampling sampling = baker.sample(*thin.density, report);

        // … and scale what grew: to the density asked for, or to the count.
        const double share = std::max(double(sampling.roots.size()), 1.0);
        const double factor = settings.count
                                  ? (sampling.roots.empty() ? 0.0 : double(*settings.count) / share)
                                  : plan.density / *thin.density;
        report.densityRequested = settings.count ? 0.0 : plan.density;
        fillCounts(report, sampling, factor);
        warnAboutRoots(sampling, ground, settings, diagnostics);
        field::Field sample = baker.grow(sampling, report);
        const double withBlades = double(field::fieldBytes(sample));
        const std::size_t grown = sample.blades.size();
        report.output.patches = static_cast<std::uint64_t>(double(sample.patches.size()) * factor);
        sample.blades.clear();
        sample.keys.clear();
        sample.patches.clear();
        const double withoutBlades = double(field::fieldBytes(sample));
        const double perTriangle = double(grown) / double(ground.triangles.size());
        const double doublings =
            std::log2(std::max(perTriangle * factor, 1.0)) - std::log2(std::max(perTriangle, 1.0));
        report.output.bytes =
            static_cast<std::uint64_t>(withoutBlades + (withBlades - withoutBlades) * factor +
                                       double(grown) * factor * doublings * bytesPerDoubling);
    });
    report.warnings = diagnostics.warnings();
    return report;
}

} // namespace sward::bake
