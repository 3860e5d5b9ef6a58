#include "terrain/surface_query.h"

#include "core/error.h"
#include "terrain/triangle_geometry.h"

#include <embree3/rtcore.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>

namespace sward::terrain {
namespace {

// The least instruction set of any x86-64 CPU: a better one would round other bits. Embree also
// advises to flush denormals (FTZ, DAZ) for speed; that would change the caller's arithmetic and is
// left alone.
constexpr const char* deviceSettings = "isa=sse2";

// How far Embree's single-precision distance may be off; whoever lies within is compared in double.
constexpr double relativeSlack = 1e-5;

// Called inside Embree, through which nothing may be thrown; whoever builds asks afterwards.
void keepMessage(void* text, RTCError code, const char* message)
{
    *static_cast<std::string*>(text) =
        fmt::format("error {}: {}", static_cast<int>(code), message == nullptr ? "" : message);
}

void failIf(bool failed, const char* doing, const std::string& trouble)
{
    if (failed || !trouble.empty())
        fail(ErrorKind::runtime, "Embree: {} failed: {}", doing, trouble);
}

glm::vec3 roundToFloat(const glm::dvec3& v)
{
    return glm::vec3(v);
}

} // namespace

struct SurfaceQuery::Scene {
    struct Collector;

    RTCDevice device = nullptr;
    RTCScene scene = nullptr;
    // Embree's own buffers; the triangles are read from them again in double precision.
    const glm::vec3* positions = nullptr;
    const glm::uvec3* triangles = nullptr;
    double extent = 0.0; // largest coordinate [m]

    Scene() = default;
    Scene(const Scene&) = delete;
    Scene& operator=(const Scene&) = delete;

    ~Scene()
    {
        if (scene != nullptr)
            rtcReleaseScene(scene);
        if (device != nullptr)
            rtcReleaseDevice(device);
    }

    Triangle triangle(std::uint32_t index) const
    {
        const glm::uvec3 t = triangles[index];
        return {glm::dvec3(positions[t.x]), glm::dvec3(positions[t.y]), glm::dvec3(positions[t.z])};
    }

    Hit firstBehind(const glm::dvec3& point, const glm::dvec3& direction, double limit, double skin,
                    std::uint32_t skipped) const;
};

// A ray that lets every triangle pass, and remembers the nearest by its distance in double
// precision.
struct SurfaceQuery::Scene::Collector {
    RTCIntersectContext context; // first: Embree gives the filter a pointer to it
    const Scene& ground;
    glm::dvec3 point;
    glm::dvec3 direction;
    double above; // exclusive
    double limit;
    std::uint32_t skipped;
    Hit best;

    static void filter(const RTCFilterFunctionNArguments* arguments)
    {
        auto& own = *reinterpret_cast<Collector*>(arguments->context);
        const std::uint32_t index = RTCHitN_primID(arguments->hit, arguments->N, 0);
        arguments->valid[0] = 0;
        if (index == own.skipped)
            return;
        const double distance = planeDistance(own.ground.triangle(index), own.point, own.direction);
        if (!(distance > own.above && distance <= own.limit))
            return;
        if (!own.best.isHit() || distance < own.best.distance ||
            (distance == own.best.distance && index < own.best.triangle))
            own.best = {.triangle = index, .distance = distance};
    }
};

namespace {

RTCRay rayOf(const glm::dvec3& point, const glm::dvec3& direction, double near, double far)
{
    const glm::vec3 from = roundToFloat(point);
    const glm::vec3 along = roundToFloat(direction);
    RTCRay ray = {};
    ray.org_x = from.x;
    ray.org_y = from.y;
    ray.org_z = from.z;
    ray.dir_x = along.x;
    ray.dir_y = along.y;
    ray.dir_z = along.z;
    ray.tnear = static_cast<float>(near);
    ray.tfar = static_cast<float>(far);
    ray.mask = 0xffffffffU;
    return ray;
}

} // namespace

SurfaceQuery::SurfaceQuery(const GroundMesh& mesh)
    : scene_(std::make_unique<Scene>())
{
    scene_->device = rtcNewDevice(deviceSettings);
    failIf(scene_->device == nullptr, "making a device", "");
    std::string trouble;
    rtcSetDeviceErrorFunction(scene_->device, keepMessage, &trouble);

    // Copy the mesh into Embree's buffers, which it pads as it needs.
    const RTCGeometry geometry = rtcNewGeometry(scene_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    void* const positions =
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                sizeof(glm::vec3), mesh.positions.size());
    void* const triangles =
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                sizeof(glm::uvec3), mesh.triangles.size());
    if (positions == nullptr || triangles == nullptr) {
        rtcReleaseGeometry(geometry);
        failIf(true, "making room for the mesh", trouble);
    }
    std::memcpy(positions, mesh.positions.data(), mesh.positions.size() * sizeof(glm::vec3));
    std::memcpy(triangles, mesh.triangles.data(), mesh.triangles.size() * sizeof(glm::uvec3));
    scene_->positions = static_cast<const glm::vec3*>(positions);
    scene_->triangles = static_cast<const glm::uvec3*>(triangles);
    const Aabb box = mesh.bounds();
    for (std::size_t axis = 0; axis < 3; ++axis)
        scene_->extent = std::max({scene_->extent, std::fabs(static_cast<double>(box.low[axis])),
                                   std::fabs(static_cast<double>(box.high[axis]))});
    rtcSetGeometryOccludedFilterFunction(geometry, Scene::Collector::filter);
    rtcCommitGeometry(geometry);

    // Robust: a ray never slips through the edge between two triangles.
    scene_->scene = rtcNewScene(scene_->device);
    rtcSetSceneFlags(scene_->scene, RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(scene_->scene, RTC_BUILD_QUALITY_MEDIUM);
    rtcAttachGeometry(scene_->scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_->scene);
    failIf(false, "building a scene", trouble);
    rtcSetDeviceErrorFunction(scene_->device, nullptr, nullptr);
}

SurfaceQuery::SurfaceQuery(SurfaceQuery&&) noexcept = default;
SurfaceQuery::~SurfaceQuery() = default;

SurfaceQuery::Hit SurfaceQuery::Scene::firstBehind(const glm::dvec3& point,
                                                   const glm::dvec3& direction, double limit,
                                                   double skin, std::uint32_t skipped) const
{
    // The ray's start is rounded to single precision: by so much its distances shift.
    const double shift = (extent + limit) * 4e-7 + 1e-30;
    RTCIntersectContext plain;
    rtcInitIntersectContext(&plain);

    Collector collector{.context = {},
                        .ground = *this,
                        .point = point,
                        .direction = direction,
                        .above = skin,
                        .limit = limit,
                        .skipped = skipped,
                        .best = {}};
    rtcInitIntersectContext(&collector.context);

    double near = std::max(0.0, skin - shift);
    const double far = limit + shift;
    while (near <= far) {
        // Ask Embree for the next triangle …
        RTCRayHit found = {};
        found.ray = rayOf(point, direction, near, far);
        found.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        rtcIntersect1(scene, &plain, &found);
        if (found.hit.geomID == RTC_INVALID_GEOMETRY_ID)
            break;

        // … then for everything that may be as near, and let double precision decide.
        const double distance = static_cast<double>(found.ray.tfar);
        const double slack = distance * relativeSlack + shift;
        RTCRay window = rayOf(point, direction, std::max(near, distance - slack), distance + slack);
        rtcOccluded1(scene, &collector.context, &window);
        if (collector.best.isHit())
            break;

        // Nothing there counted: go on behind it.
        const auto behind = static_cast<double>(std::nextafter(static_cast<float>(distance + slack),
                                                               std::numeric_limits<float>::max()));
        near = std::max(behind, near * (1.0 + 1e-6) + 1e-30);
    }
    return collector.best;
}

SurfaceQuery::Hit SurfaceQuery::cast(glm::dvec3 point, glm::dvec3 direction, double limit,
                                     double skin) const
{
    return scene_->firstBehind(point, direction, limit, skin, Hit{}.triangle);
}

double SurfaceQuery::clearance(glm::dvec3 point, glm::dvec3 up, double limit,
                               std::uint32_t ownTriangle) const
{
    constexpr double groundShare = 1e-5; // of the limit: what is nearer is the ground itself
    const Hit hit = scene_->firstBehind(point, up, limit, limit * groundShare, ownTriangle);
    return hit.isHit() ? hit.distance : limit;
}

SurfaceQuery::Nearest SurfaceQuery::nearest(glm::dvec3 point) const
{
    struct Search {
        const Scene* scene;
        glm::dvec3 point;
        double slack;
        Nearest best;

        static bool visit(RTCPointQueryFunctionArguments* arguments)
        {
            auto& own = *static_cast<Search*>(arguments->userPtr);
            const glm::dvec3 on = nearestPoint(own.scene->triangle(arguments->primID), own.point);
            const double distance = glm::length(on - own.point);
            if (distance > own.best.distance ||
                (distance == own.best.distance && arguments->primID > own.best.triangle))
                return false;
            own.best = {.triangle = arguments->primID, .point = on, .distance = distance};
            // Keep equals in reach: the lowest number wins.
            arguments->query->radius =
                static_cast<float>(distance * (1.0 + relativeSlack) + own.slack);
            return true;
        }
    };
    const double reach =
        std::max({std::fabs(point.x), std::fabs(point.y), std::fabs(point.z), scene_->extent});
    Search search{.scene = scene_.get(),
                  .point = point,
                  .slack = reach * 4e-7 + 1e-30,
                  .best = {.triangle = 0xffffffffU,
                           .point = point,
                           .distance = std::numeric_limits<double>::infinity()}};
    const glm::vec3 at = roundToFloat(point);
    RTCPointQuery query = {};
    query.x = at.x;
    query.y = at.y;
    query.z = at.z;
    query.radius = std::numeric_limits<float>::infinity();
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    rtcPointQuery(scene_->scene, &query, &context, Search::visit, &search);
    return search.best;
}

} // namespace sward::terrain
