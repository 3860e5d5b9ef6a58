#include "trace/ray_scene.h"

#include "core/error.h"

#if SWARD_EMBREE == 3
#include <embree3/rtcore.h>
#else
#include <embree4/rtcore.h>
#endif
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace sward::trace {
namespace {

// No newer instruction set than this, so that newer CPUs give the same hits. Unlike
// terrain::SurfaceQuery, whose results stand in field files, CPUs without AVX2 may differ in one
// hit of a million: SSE2 alone takes half as long again.
constexpr const char* sceneSettings = "max_isa=avx2";

// Share of a place's largest coordinate by which a ray starts off its surface.
constexpr float startShare = 1e-6f;

// Embree 3 takes a ray's context as an argument, Embree 4 within the arguments.
#if SWARD_EMBREE == 3
void intersectScene(RTCScene scene, RTCRayHit& ray)
{
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(scene, &context, &ray);
}

void occludeScene(RTCScene scene, RTCRay& ray)
{
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded1(scene, &context, &ray);
}
#else
void intersectScene(RTCScene scene, RTCRayHit& ray)
{
    rtcIntersect1(scene, &ray, nullptr);
}

void occludeScene(RTCScene scene, RTCRay& ray)
{
    rtcOccluded1(scene, &ray, nullptr);
}
#endif

// Called inside Embree, which exceptions must not cross. The builder checks the code afterwards.
void keepSceneCode(void* code, RTCError now, const char*)
{
    *static_cast<RTCError*>(code) = now;
}

void requireScene(bool isMade, std::size_t primitives, RTCError code)
{
    if (isMade && code == RTC_ERROR_NONE)
        return;
    if (code == RTC_ERROR_UNSUPPORTED_CPU)
        fail(ErrorKind::unsupported, "tracing needs a CPU with SSE2");
    if (code == RTC_ERROR_OUT_OF_MEMORY || code == RTC_ERROR_NONE)
        fail(ErrorKind::runtime, "not enough memory to trace {} quads and triangles", primitives);
    fail(ErrorKind::runtime, "a scene of {} quads and triangles cannot be prepared", primitives);
}

RTCRay freeRay(glm::vec3 from, glm::vec3 direction)
{
    RTCRay ray = {};
    ray.org_x = from.x;
    ray.org_y = from.y;
    ray.org_z = from.z;
    ray.dir_x = direction.x;
    ray.dir_y = direction.y;
    ray.dir_z = direction.z;
    ray.tnear = 0.0f;
    ray.tfar = std::numeric_limits<float>::infinity();
    ray.mask = 0xffffffffU;
    return ray;
}

} // namespace

struct RayScene::Scene {
    Surfaces surfaces;
    RTCDevice device = nullptr;
    RTCScene scene = nullptr;

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

    std::size_t primitives() const
    {
        return surfaces.quads.size() + surfaces.groundTriangles.size();
    }

    // Attaches points and primitives, which Embree reads where they are, under the number of a
    // part.
    template <typename Primitive>
    void attach(Part part, RTCGeometryType type, RTCFormat format,
                const std::vector<glm::vec3>& points, const std::vector<Primitive>& primitives)
    {
        if (primitives.empty())
            return;
        RTCGeometry geometry = rtcNewGeometry(device, type);
        // Embree reads 16 bytes of each point; the last one stands behind all that count.
        rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                   points.data(), 0, sizeof(glm::vec3), points.size() - 1);
        rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, format, primitives.data(), 0,
                                   sizeof(Primitive), primitives.size());
        rtcCommitGeometry(geometry);
        rtcAttachGeometryByID(scene, geometry, static_cast<unsigned>(part));
        rtcReleaseGeometry(geometry);
    }

    void describe(RayHit& hit, float u, float v) const
    {
        if (hit.part == Part::ground) {
            const glm::uvec3 corners = surfaces.groundTriangles[hit.primitive];
            hit.shares = {1.0f - u - v, u, v};
            hit.position = hit.shares.x * surfaces.groundPoints[corners.x] +
                           hit.shares.y * surfaces.groundPoints[corners.y] +
                           hit.shares.z * surfaces.groundPoints[corners.z];
            return;
        }
        // Embree divides a quad into two triangles; v runs along the blade in both.
        const glm::uvec4 quad = surfaces.quads[hit.primitive];
        const auto point = [&](std::uint32_t i) { return surfaces.points[i]; };
        hit.position = u + v <= 1.0f
                           ? point(quad.x) + u * (point(quad.y) - point(quad.x)) +
                                 v * (point(quad.w) - point(quad.x))
                           : point(quad.z) + (1.0f - u) * (point(quad.w) - point(quad.z)) +
                                 (1.0f - v) * (point(quad.y) - point(quad.z));
        hit.strip = surfaces.quadStrip[hit.primitive];
        const Surfaces::Strip& strip = surfaces.strips[hit.strip];
        const std::uint32_t row =
            strip.firstRow + (hit.primitive - strip.firstQuad) / strip.columns;
        hit.along = glm::mix(surfaces.along[row], surfaces.along[row + 1], v);
        const std::uint32_t column = (hit.primitive - strip.firstQuad) % strip.columns;
        // In each of its triangles, u counts in widths of the row that has two corners of it.
        const float low = glm::length(point(quad.y) - point(quad.x));
        const float high = glm::length(point(quad.z) - point(quad.w));
        const float wide = std::max(glm::mix(low, high, v), 1e-12f);
        const float share = u + v <= 1.0f ? u * low / wide : 1.0f - (1.0f - u) * high / wide;
        hit.across = 2.0f * (float(column) + share) / float(strip.columns) - 1.0f;
    }
};

RayScene::RayScene(Surfaces surfaces)
    : scene_(std::make_unique<Scene>())
{
    scene_->surfaces = std::move(surfaces);
    const Surfaces& all = scene_->surfaces;
    const std::size_t primitives = scene_->primitives();
    scene_->device = rtcNewDevice(sceneSettings);
    RTCError trouble = scene_->device == nullptr ? rtcGetDeviceError(nullptr) : RTC_ERROR_NONE;
    requireScene(scene_->device != nullptr, primitives, trouble);
    rtcSetDeviceErrorFunction(scene_->device, keepSceneCode, &trouble);

    // Robust mode: no ray passes between two adjacent quads.
    scene_->scene = rtcNewScene(scene_->device);
    requireScene(scene_->scene != nullptr, primitives, trouble);
    rtcSetSceneFlags(scene_->scene, RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(scene_->scene, RTC_BUILD_QUALITY_MEDIUM);
    scene_->attach(Part::blades, RTC_GEOMETRY_TYPE_QUAD, RTC_FORMAT_UINT4, all.points, all.quads);
    scene_->attach(Part::ground, RTC_GEOMETRY_TYPE_TRIANGLE, RTC_FORMAT_UINT3, all.groundPoints,
                   all.groundTriangles);
    // Several threads would sort primitives of one leaf differently from run to run, and of two
    // hits at the same distance the first counts.
    tbb::task_arena alone(1);
    alone.execute([&] { rtcJoinCommitScene(scene_->scene); });
    requireScene(true, primitives, trouble);
    rtcSetDeviceErrorFunction(scene_->device, nullptr, nullptr);
}

RayScene::RayScene(RayScene&&) noexcept = default;
RayScene& RayScene::operator=(RayScene&&) noexcept = default;
RayScene::~RayScene() = default;

const Surfaces& RayScene::surfaces() const
{
    return scene_->surfaces;
}

bool RayScene::meets(glm::vec3 from, glm::vec3 direction, RayHit& hit) const
{
    RTCRayHit found = {};
    found.ray = freeRay(from, direction);
    found.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    intersectScene(scene_->scene, found);
    if (found.hit.geomID == RTC_INVALID_GEOMETRY_ID)
        return false;
    hit.part =
        found.hit.geomID == static_cast<unsigned>(Part::blades) ? Part::blades : Part::ground;
    hit.primitive = found.hit.primID;
    hit.distance = found.ray.tfar;
    glm::vec3 normal(found.hit.Ng_x, found.hit.Ng_y, found.hit.Ng_z);
    const float size = glm::length(normal);
    normal = size > 0.0f ? normal / size : -direction;
    hit.normal = glm::dot(normal, direction) > 0.0f ? -normal : normal;
    scene_->describe(hit, found.hit.u, found.hit.v);
    return true;
}

bool RayScene::isHidden(glm::vec3 from, glm::vec3 direction) const
{
    RTCRay ray = freeRay(from, direction);
    occludeScene(scene_->scene, ray);
    return ray.tfar < 0.0f;
}

glm::vec3 RayScene::leaving(const RayHit& hit, glm::vec3 direction)
{
    const glm::vec3 size = glm::abs(hit.position);
    const float largest = std::max({size.x, size.y, size.z, 1e-3f});
    const float side = glm::dot(hit.normal, direction) >= 0.0f ? 1.0f : -1.0f;
    return hit.position + (side * startShare * largest) * hit.normal;
}

} // namespace sward::trace
