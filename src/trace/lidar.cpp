#include "trace/lidar.h"

#include "core/error.h"
#include "core/random.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sward::trace {
namespace {

// Beams of one call of the sink, and of one task.
constexpr std::uint64_t beamsAtOnce = 1u << 16;
constexpr std::uint64_t beamsOfTask = 256;

constexpr std::uint32_t maxRays = 4096, maxReturnsOfBeam = 15;

// Where a ray of a beam ends.
struct RayEnd {
    double range;
    float power;
    float incidence;
    std::uint32_t blade;
};

// What a task has found.
struct LidarFound {
    std::vector<LidarReturn> returns;
    std::uint64_t groundRays = 0;
    std::uint64_t freeRays = 0;
};

void checkLidar(const LidarSettings& settings)
{
    const auto inRange = [](float value, float low, float high) {
        return value >= low && value <= high;
    };
    requireUsage(inRange(settings.divergence, 0.0f, 1.0f),
                 "LidarSettings::divergence is {} rad; allowed is 0 to 1", settings.divergence);
    requireUsage(inRange(settings.exitWidth, 0.0f, 10.0f),
                 "LidarSettings::exitWidth is {} m; allowed is 0 to 10", settings.exitWidth);
    requireUsage(settings.rays >= 1 && settings.rays <= maxRays,
                 "LidarSettings::rays is {}; allowed is 1 to {}", settings.rays, maxRays);
    requireUsage(settings.maxReturns >= 1 && settings.maxReturns <= maxReturnsOfBeam,
                 "LidarSettings::maxReturns is {}; allowed is 1 to {}", settings.maxReturns,
                 maxReturnsOfBeam);
    requireUsage(settings.resolution >= 0.0f,
                 "LidarSettings::resolution is {} m; it must not be negative", settings.resolution);
    requireUsage(settings.nearest >= 0.0f && settings.farthest > settings.nearest,
                 "LidarSettings: ranges {} to {} m hold nothing", settings.nearest,
                 settings.farthest);
    requireUsage(inRange(settings.groundReflectance, 0.0f, 1.0f),
                 "LidarSettings::groundReflectance is {}; allowed is 0 to 1",
                 settings.groundReflectance);
    requireUsage(!settings.leafReflectance.empty(), "LidarSettings::leafReflectance is empty");
    for (const float one : settings.leafReflectance)
        requireUsage(inRange(one, 0.0f, 1.0f),
                     "LidarSettings::leafReflectance has {}; allowed is 0 to 1", one);
}

class Sensor {
public:
    Sensor(const RayScene& scene, glm::dvec3 origin, std::span<const std::uint8_t> species,
           const Beams& beams, const LidarSettings& settings)
        : scene_(scene)
        , origin_(origin)
        , species_(species)
        , beams_(beams)
        , settings_(settings)
    {
    }

    void cast(std::uint64_t number, std::vector<RayEnd>& ends, LidarFound& found) const
    {
        const Beam beam = beams_.beam(number);
        requireUsage(std::abs(glm::length(beam.towards) - 1.0f) < 1e-3f,
                     "beam {}: its direction has the length {}", number, glm::length(beam.towards));
        ends.clear();
        const glm::vec3 from(beam.from - origin_);
        // An axis across that is not along the beam.
        const glm::vec3 z = glm::normalize(beam.towards);
        const glm::vec3 x = glm::normalize(
            glm::cross(z, std::abs(z.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0)));
        const glm::vec3 y = glm::cross(z, x);
        const float spread = std::tan(0.5f * settings_.divergence);
        const double turn = uniform(settings_.seed, number, 0);
        for (std::uint32_t ray = 0; ray < settings_.rays; ++ray) {
            // Vogel's spiral (1979) spreads points evenly over a disk; a single ray is the axis.
            const float radius =
                settings_.rays == 1 ? 0.0f : std::sqrt((float(ray) + 0.5f) / float(settings_.rays));
            const auto angle = static_cast<float>(
                2.0 * std::numbers::pi * (turn + ray / (std::numbers::phi * std::numbers::phi)));
            const glm::vec3 off = radius * (std::cos(angle) * x + std::sin(angle) * y);
            trace(from + 0.5f * settings_.exitWidth * off, glm::normalize(z + spread * off), ends,
                  found);
        }
        gather(number, beam, ends, found.returns);
    }

private:
    void trace(glm::vec3 from, glm::vec3 towards, std::vector<RayEnd>& ends,
               LidarFound& found) const
    {
        RayHit hit;
        if (!scene_.meets(from, towards, hit)) {
            ++found.freeRays;
            return;
        }
        const bool isGround = hit.part == Part::ground;
        found.groundRays += isGround ? 1 : 0;
        if (!(hit.distance >= settings_.nearest && hit.distance <= settings_.farthest))
            return;
        const std::uint32_t blade =
            isGround ? LidarReturn::ground : scene_.surfaces().strips[hit.strip].blade;
        const std::size_t last = settings_.leafReflectance.size() - 1;
        const float reflectance =
            isGround ? settings_.groundReflectance
                     : settings_.leafReflectance[std::min<std::size_t>(species_[blade], last)];
        const float cosine = glm::clamp(-glm::dot(hit.normal, towards), 0.0f, 1.0f);
        ends.push_back({double(hit.distance), reflectance * cosine / float(settings_.rays),
                        std::acos(cosine), blade});
    }

    // Neighbouring ends become returns.
    void gather(std::uint64_t number, const Beam& beam, std::vector<RayEnd>& ends,
                std::vector<LidarReturn>& returns) const
    {
        std::stable_sort(ends.begin(), ends.end(),
                         [](const RayEnd& a, const RayEnd& b) { return a.range < b.range; });
        const std::size_t first = returns.size();
        for (auto from = ends.begin();
             from != ends.end() && returns.size() - first < settings_.maxReturns;) {
            const auto to = std::find_if(from, ends.end(), [&](const RayEnd& end) {
                return end.range > from->range + double(settings_.resolution);
            });
            returns.push_back(returnOf(number, beam, {from, to}));
            from = to;
        }
        for (std::size_t i = first; i < returns.size(); ++i) {
            returns[i].number = static_cast<std::uint8_t>(i - first + 1);
            returns[i].returns = static_cast<std::uint8_t>(returns.size() - first);
        }
    }

    static LidarReturn returnOf(std::uint64_t number, const Beam& beam,
                                std::span<const RayEnd> ends)
    {
        LidarReturn made;
        made.beam = number;
        double weights = 0.0;
        std::size_t most = 0;
        for (const RayEnd& end : ends) {
            // Rays without power count as little as can be, so that a range is always defined.
            const double weight = std::max(double(end.power), 1e-12);
            made.range += weight * end.range;
            weights += weight;
            made.intensity += end.power;
            const auto same = static_cast<std::size_t>(
                std::count_if(ends.begin(), ends.end(),
                              [&](const RayEnd& other) { return other.blade == end.blade; }));
            if (same > most) {
                most = same;
                made.blade = end.blade;
                made.incidence = end.incidence;
            }
        }
        made.range /= weights;
        made.place = beam.from + made.range * glm::dvec3(beam.towards);
        return made;
    }

    const RayScene& scene_;
    glm::dvec3 origin_;
    std::span<const std::uint8_t> species_;
    const Beams& beams_;
    const LidarSettings& settings_;
};

} // namespace

LidarCounts scan(const RayScene& scene, glm::dvec3 origin, std::span<const std::uint8_t> species,
                 const Beams& beams, const LidarSettings& settings,
                 const std::function<void(std::span<const LidarReturn>)>& sink, Progress& progress)
{
    checkLidar(settings);
    const Sensor sensor(scene, origin, species, beams, settings);
    LidarCounts counts;
    std::vector<LidarFound> tasks;
    for (std::uint64_t first = 0; first < beams.count; first += beamsAtOnce) {
        const std::uint64_t end = std::min(beams.count, first + beamsAtOnce);
        tasks.assign((end - first + beamsOfTask - 1) / beamsOfTask, {});
        tbb::parallel_for(std::size_t(0), tasks.size(), [&](std::size_t task) {
            std::vector<RayEnd> ends;
            const std::uint64_t start = first + task * beamsOfTask;
            const std::uint64_t stop = std::min(end, start + beamsOfTask);
            for (std::uint64_t number = start; number < stop; ++number)
                sensor.cast(number, ends, tasks[task]);
        });
        for (const LidarFound& task : tasks) {
            sink(task.returns);
            counts.returns += task.returns.size();
            counts.groundRays += task.groundRays;
            counts.freeRays += task.freeRays;
        }
        counts.beams += end - first;
        progress.advance(end - first);
    }
    counts.rays = counts.beams * settings.rays;
    return counts;
}

} // namespace sward::trace
