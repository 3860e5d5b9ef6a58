#include "terrain/query/surface_query.h"

#include "core/error.h"
#include "terrain/query/height_rays.h"
#include "terrain/topology/triangle_geometry.h"

#if SWARD_EMBREE == 3
#include <embree3/rtcore.h>
#else
#include <embree4/rtcore.h>
#endif
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <mutex>
#include <string>
#include <vector>

namespace sward::terrain {
namespace {

// Lowest instruction set of any x86-64 CPU; others round differently. Embree also recommends
// flushing denormals (FTZ, DAZ) for speed; that would change the caller's arithmetic, so it is not
// done.
constexpr const char* deviceSettings = "isa=sse2";

// Relative error of Embree's distance; candidates within it are compared in double precision.
constexpr double relativeSlack = 1e-5;

// Share of a clearance below which a hit is the ground itself.
constexpr double groundShare = 1e-5;

// Embree 3 takes a ray's context as an argument, Embree 4 within the arguments.
#if SWARD_EMBREE == 3
using RayContext = RTCIntersectContext;

RayContext makeRayContext()
{
    RayContext context;
    rtcInitIntersectContext(&context);
    return context;
}

void intersect(RTCScene scene, RayContext& context, RTCRayHit& ray)
{
    rtcIntersect1(scene, &context, &ray);
}

void occlude(RTCScene scene, RayContext& context, RTCRay& ray)
{
    rtcOccluded1(scene, &context, &ray);
}
#else
using RayContext = RTCRayQueryContext;

RayContext makeRayContext()
{
    RayContext context;
    rtcInitRayQueryContext(&context);
    return context;
}

void intersect(RTCScene scene, RayContext& context, RTCRayHit& ray)
{
    RTCIntersectArguments arguments;
    rtcInitIntersectArguments(&arguments);
    arguments.context = &context;
    rtcIntersect1(scene, &ray, &arguments);
}

void occlude(RTCScene scene, RayContext& context, RTCRay& ray)
{
    RTCOccludedArguments arguments;
    rtcInitOccludedArguments(&arguments);
    arguments.context = &context;
    rtcOccluded1(scene, &ray, &arguments);
}
#endif

// Called inside Embree, which exceptions must not cross. The builder checks the code afterwards.
void keepCode(void* code, RTCError now, const char*)
{
    *static_cast<RTCError*>(code) = now;
}

void failIf(bool failed, std::size_t triangles, RTCError code)
{
    if (!failed && code == RTC_ERROR_NONE)
        return;
    if (code == RTC_ERROR_UNSUPPORTED_CPU)
        fail(ErrorKind::unsupported, "rays on the ground need a CPU with SSE2");
    if (code == RTC_ERROR_OUT_OF_MEMORY || code == RTC_ERROR_NONE)
        fail(ErrorKind::runtime, "not enough memory for rays on the ground of {} triangles",
             triangles);
    fail(ErrorKind::runtime, "rays on the ground of {} triangles cannot be prepared", triangles);
}

glm::vec3 roundToFloat(const glm::dvec3& v)
{
    return glm::vec3(v);
}

} // namespace

struct SurfaceQuery::Scene {
    struct Question;

    RTCDevice device = nullptr;
    RTCScene scene = nullptr;
    // Embree's buffers; also used for the double-precision tests.
    const glm::vec3* positions = nullptr;
    const glm::uvec3* triangles = nullptr;
    double extent = 0.0; // largest coordinate [m]
    // Of a grid of heights: answers all but nearest(). Embree's part is then built on demand.
    std::unique_ptr<const HeightRays> heights;
    std::once_flag building;

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

    // Bound of the distance error from rounding the ray's start to single precision.
    double shift(double limit) const { return (extent + limit) * 4e-7 + 1e-30; }

    // Makes Embree's part.
    void build(std::span<const glm::vec3> ownPositions, std::span<const glm::uvec3> ownTriangles);
    void buildOfHeights();

    // Answer of a grid of heights.
    Hit onHeights(const glm::dvec3& point, const glm::dvec3& direction, double limit, double skin,
                  const IgnoredTriangles& ignored, bool endsAtFirst) const
    {
        const HeightRays::Met met = heights->meet(
            {point, direction, skin, limit, ignored.one, ignored.marked, endsAtFirst});
        return {.triangle = met.triangle, .distance = met.distance};
    }

    Hit firstBehind(const glm::dvec3& point, const glm::dvec3& direction, double limit, double skin,
                    const IgnoredTriangles& ignored) const;

    // The nearest hit, or any if the ray ends at the first, of one traversal.
    Hit through(const glm::dvec3& point, const glm::dvec3& direction, double limit, double skin,
                const IgnoredTriangles& ignored, bool endsAtFirst) const;
};

// A ray that tests, in double precision, every triangle that Embree finds.
struct SurfaceQuery::Scene::Question {
    RayContext context; // must be first: Embree passes its address to the filter
    const Scene& ground;
    glm::dvec3 point;
    glm::dvec3 direction;
    double above; // exclusive
    double limit;
    const IgnoredTriangles& ignored;
    bool endsAtFirst; // else continues and keeps the nearest
    Hit best;

    // Whether the ray ends here.
    bool meets(std::uint32_t index)
    {
        if (index == ignored.one || (!ignored.marked.empty() && ignored.marked[index] != 0))
            return false;
        const double distance = planeDistance(ground.triangle(index), point, direction);
        if (!(distance > above && distance <= limit))
            return false;
        if (!best.isHit() || distance < best.distance ||
            (distance == best.distance && index < best.triangle))
            best = {.triangle = index, .distance = distance};
        return endsAtFirst;
    }

    static void filter(const RTCFilterFunctionNArguments* arguments)
    {
        auto& own = *reinterpret_cast<Question*>(arguments->context);
        if (!own.meets(RTCHitN_primID(arguments->hit, arguments->N, 0)))
            arguments->valid[0] = 0;
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

double largestCoordinate(std::span<const glm::vec3> positions)
{
    glm::vec3 largest(0.0f);
    for (const glm::vec3& position : positions)
        largest = glm::max(largest, glm::abs(position));
    return double(std::max({largest.x, largest.y, largest.z}));
}

} // namespace

SurfaceQuery::SurfaceQuery(const GroundMesh& mesh)
    : scene_(std::make_unique<Scene>())
{
    scene_->heights = HeightRays::of(mesh);
    if (scene_->heights == nullptr)
        scene_->build(mesh.positions, mesh.triangles);
}

SurfaceQuery::SurfaceQuery(std::span<const glm::vec3> positions,
                           std::span<const glm::uvec3> triangles)
    : scene_(std::make_unique<Scene>())
{
    scene_->build(positions, triangles);
}

void SurfaceQuery::Scene::buildOfHeights()
{
    std::call_once(building, [&] {
        std::vector<glm::vec3> corners;
        std::vector<glm::uvec3> numbers;
        for (const std::array<glm::vec3, 3>& one : heights->triangles()) {
            const auto first = static_cast<std::uint32_t>(corners.size());
            corners.insert(corners.end(), one.begin(), one.end());
            numbers.emplace_back(first, first + 1, first + 2);
        }
        build(corners, numbers);
    });
}

void SurfaceQuery::Scene::build(std::span<const glm::vec3> ownPositions,
                                std::span<const glm::uvec3> ownTriangles)
{
    device = rtcNewDevice(deviceSettings);
    failIf(device == nullptr, ownTriangles.size(), rtcGetDeviceError(nullptr));
    RTCError trouble = RTC_ERROR_NONE;
    rtcSetDeviceErrorFunction(device, keepCode, &trouble);

    // Copy the mesh into Embree's buffers, which add padding.
    const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    void* const vertexBuffer =
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                sizeof(glm::vec3), ownPositions.size());
    void* const indexBuffer =
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                sizeof(glm::uvec3), ownTriangles.size());
    if (vertexBuffer == nullptr || indexBuffer == nullptr) {
        rtcReleaseGeometry(geometry);
        failIf(true, ownTriangles.size(), trouble);
    }
    std::memcpy(vertexBuffer, ownPositions.data(), ownPositions.size_bytes());
    std::memcpy(indexBuffer, ownTriangles.data(), ownTriangles.size_bytes());
    positions = static_cast<const glm::vec3*>(vertexBuffer);
    triangles = static_cast<const glm::uvec3*>(indexBuffer);
    extent = largestCoordinate(ownPositions);
    rtcSetGeometryOccludedFilterFunction(geometry, Scene::Question::filter);
    rtcCommitGeometry(geometry);

    // Robust mode: no ray passes between two adjacent triangles.
    scene = rtcNewScene(device);
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_MEDIUM);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene);
    failIf(false, ownTriangles.size(), trouble);
    rtcSetDeviceErrorFunction(device, nullptr, nullptr);
}

SurfaceQuery::SurfaceQuery(SurfaceQuery&&) noexcept = default;
SurfaceQuery::~SurfaceQuery() = default;

SurfaceQuery::Hit SurfaceQuery::Scene::firstBehind(const glm::dvec3& point,
                                                   const glm::dvec3& direction, double limit,
                                                   double skin,
                                                   const IgnoredTriangles& ignored) const
{
    RayContext plain = makeRayContext();
    Question question{.context = makeRayContext(),
                      .ground = *this,
                      .point = point,
                      .direction = direction,
                      .above = skin,
                      .limit = limit,
                      .ignored = ignored,
                      .endsAtFirst = false,
                      .best = {}};

    double near = std::max(0.0, skin - shift(limit));
    const double far = limit + shift(limit);
    while (near <= far) {
        // Find the next triangle by Embree …
        RTCRayHit found = {};
        found.ray = rayOf(point, direction, near, far);
        found.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        intersect(scene, plain, found);
        if (found.hit.geomID == RTC_INVALID_GEOMETRY_ID)
            break;

        // … then compare all candidates of similar distance in double precision.
        const double distance = static_cast<double>(found.ray.tfar);
        const double slack = distance * relativeSlack + shift(limit);
        RTCRay window = rayOf(point, direction, std::max(near, distance - slack), distance + slack);
        occlude(scene, question.context, window);
        if (question.best.isHit())
            break;

        // No candidate counted: continue behind it.
        const auto behind = static_cast<double>(std::nextafter(static_cast<float>(distance + slack),
                                                               std::numeric_limits<float>::max()));
        near = std::max(behind, near * (1.0 + 1e-6) + 1e-30);
    }
    return question.best;
}

SurfaceQuery::Hit SurfaceQuery::cast(glm::dvec3 point, glm::dvec3 direction, double limit,
                                     double skin, const IgnoredTriangles& ignored) const
{
    return scene_->heights != nullptr
               ? scene_->onHeights(point, direction, limit, skin, ignored, false)
               : scene_->firstBehind(point, direction, limit, skin, ignored);
}

SurfaceQuery::Hit SurfaceQuery::Scene::through(const glm::dvec3& point, const glm::dvec3& direction,
                                               double limit, double skin,
                                               const IgnoredTriangles& ignored,
                                               bool endsAtFirst) const
{
    Question question{.context = makeRayContext(),
                      .ground = *this,
                      .point = point,
                      .direction = direction,
                      .above = skin,
                      .limit = limit,
                      .ignored = ignored,
                      .endsAtFirst = endsAtFirst,
                      .best = {}};
    RTCRay ray = rayOf(point, direction, std::max(0.0, skin - shift(limit)), limit + shift(limit));
    occlude(scene, question.context, ray);
    return question.best;
}

SurfaceQuery::Hit SurfaceQuery::castThrough(glm::dvec3 point, glm::dvec3 direction, double limit,
                                            double skin, const IgnoredTriangles& ignored) const
{
    return scene_->heights != nullptr
               ? scene_->onHeights(point, direction, limit, skin, ignored, false)
               : scene_->through(point, direction, limit, skin, ignored, false);
}

bool SurfaceQuery::occluded(glm::dvec3 point, glm::dvec3 direction, double limit, double skin,
                            const IgnoredTriangles& ignored) const
{
    return (scene_->heights != nullptr
                ? scene_->onHeights(point, direction, limit, skin, ignored, true)
                : scene_->through(point, direction, limit, skin, ignored, true))
        .isHit();
}

double SurfaceQuery::clearance(glm::dvec3 point, glm::dvec3 up, double limit,
                               std::uint32_t ownTriangle) const
{
    const Hit hit = cast(point, up, limit, limit * groundShare, {.one = ownTriangle});
    return hit.isHit() ? hit.distance : limit;
}

bool SurfaceQuery::isClear(glm::dvec3 point, glm::dvec3 up, double limit,
                           std::uint32_t ownTriangle) const
{
    return !occluded(point, up, limit, limit * groundShare, {.one = ownTriangle});
}

SurfaceQuery::Nearest SurfaceQuery::nearest(glm::dvec3 point, double limit) const
{
    struct Search {
        const Scene* scene;
        glm::dvec3 point;
        double slack;
        double limit;
        Nearest best;

        static bool visit(RTCPointQueryFunctionArguments* arguments)
        {
            auto& own = *static_cast<Search*>(arguments->userPtr);
            const glm::dvec3 on = nearestPoint(own.scene->triangle(arguments->primID), own.point);
            const double distance = glm::length(on - own.point);
            if (distance > own.limit || distance > own.best.distance ||
                (distance == own.best.distance && arguments->primID > own.best.triangle))
                return false;
            own.best = {.triangle = arguments->primID, .point = on, .distance = distance};
            // Keep triangles of equal distance in range: the lowest number wins.
            arguments->query->radius =
                static_cast<float>(distance * (1.0 + relativeSlack) + own.slack);
            return true;
        }
    };
    if (scene_->heights != nullptr)
        scene_->buildOfHeights();
    const double reach =
        std::max({std::fabs(point.x), std::fabs(point.y), std::fabs(point.z), scene_->extent});
    Search search{.scene = scene_.get(),
                  .point = point,
                  .slack = reach * 4e-7 + 1e-30,
                  .limit = limit,
                  .best = {}};
    const glm::vec3 at = roundToFloat(point);
    RTCPointQuery query = {};
    query.x = at.x;
    query.y = at.y;
    query.z = at.z;
    query.radius = static_cast<float>(limit * (1.0 + relativeSlack) + search.slack);
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    rtcPointQuery(scene_->scene, &query, &context, Search::visit, &search);
    return search.best;
}

} // namespace sward::terrain
