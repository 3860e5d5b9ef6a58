#include "trace/lidar.h"

#include "shaders/shared/lidar/ray_tree.h"

#include <glm/geometric.hpp>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace sward::trace {
namespace {

// Beams of one call of the sink, and of one task.
constexpr std::uint64_t beamsAtOnce = 1u << 17;
constexpr std::uint64_t beamsOfTask = 1024;

// What became of the rays of a task.
struct TaskRays {
    std::uint64_t ground = 0;
    std::uint64_t free = 0;
};

class Sensor {
public:
    Sensor(const RayScene& scene, glm::dvec3 origin, std::span<const std::uint8_t> species,
           const lidar::Beams& beams, const lidar::LidarSettings& settings)
        : scene_(scene)
        , origin_(origin)
        , species_(species)
        , beams_(beams)
        , seed_(settings.seed)
        , sensor_(lidar::sensorOf(settings))
        , places_(lidar::spiralOf(settings.rays))
        , reflectances_(lidar::reflectancesOf(settings))
    {
    }

    // Appends the returns of a beam; `ends` has room for its rays.
    void cast(std::uint64_t number, std::span<shared::LidarEnd> ends, TaskRays& rays,
              std::vector<lidar::LidarReturn>& returns) const
    {
        const lidar::Beam beam = beams_.beam(number);
        const shared::LidarBeam turned = lidar::castBeam(beam, number, origin_, seed_);
        for (std::size_t i = 0; i < places_.size(); ++i)
            ends[i] = endOf(shared::rayOfBeam(sensor_, turned, places_[i]), rays);
        shared::LidarEndTable table = {};
        table.at = ends.data();
        const std::uint32_t count = shared::countReturns(sensor_, table, 0);
        float nearest = shared::nextRange(sensor_, table, 0, shared::lidarBegin);
        for (std::uint32_t i = 0; i < count; ++i) {
            returns.push_back(lidar::returnOf(shared::echoAt(sensor_, table, 0, nearest), beam,
                                              number, i, count));
            nearest = shared::nextRange(sensor_, table, 0, nearest + sensor_.resolution);
        }
    }

private:
    shared::LidarEnd endOf(const shared::LidarRay& ray, TaskRays& rays) const
    {
        RayHit hit;
        if (!scene_.meets(ray.from, ray.towards, hit)) {
            ++rays.free;
            return shared::lidarMiss();
        }
        const bool isGround = hit.part == Part::ground;
        rays.ground += isGround ? 1 : 0;
        const std::uint32_t blade =
            isGround ? shared::lidarGround : scene_.surfaces().strips[hit.strip].blade;
        const std::uint32_t surface = isGround ? shared::rayGroundSurface : species_[blade];
        return shared::lidarEndAt(sensor_, hit.distance, -glm::dot(hit.normal, ray.towards), blade,
                                  reflectances_[surface]);
    }

    const RayScene& scene_;
    glm::dvec3 origin_;
    std::span<const std::uint8_t> species_;
    const lidar::Beams& beams_;
    std::uint64_t seed_;
    shared::LidarSensor sensor_;
    std::vector<glm::vec2> places_;
    std::vector<float> reflectances_;
};

} // namespace

lidar::LidarCounts scan(const RayScene& scene, glm::dvec3 origin,
                        std::span<const std::uint8_t> species, const lidar::Beams& beams,
                        const lidar::LidarSettings& settings, const lidar::ReturnSink& sink,
                        Progress& progress)
{
    lidar::requireSettings(settings);
    const Sensor sensor(scene, origin, species, beams, settings);
    lidar::LidarCounts counts;
    for (std::uint64_t first = 0; first < beams.count; first += beamsAtOnce) {
        const std::uint64_t end = std::min(beams.count, first + beamsAtOnce);
        lidar::ReturnParts found((end - first + beamsOfTask - 1) / beamsOfTask);
        std::vector<TaskRays> rays(found.size());
        tbb::parallel_for(std::size_t(0), found.size(), [&](std::size_t task) {
            std::vector<shared::LidarEnd> ends(settings.rays);
            const std::uint64_t start = first + task * beamsOfTask;
            const std::uint64_t stop = std::min(end, start + beamsOfTask);
            for (std::uint64_t number = start; number < stop; ++number)
                sensor.cast(number, ends, rays[task], found[task]);
        });
        for (std::size_t task = 0; task < found.size(); ++task) {
            counts.returns += found[task].size();
            counts.groundRays += rays[task].ground;
            counts.freeRays += rays[task].free;
        }
        sink(std::move(found));
        counts.beams += end - first;
        progress.advance(end - first);
    }
    counts.rays = counts.beams * settings.rays;
    return counts;
}

} // namespace sward::trace
