#include "bake/filter/exposure.h"

#include "bake/filter/up_vector.h"
#include "core/math/exact_math.h"
#include "core/random.h"
#include "terrain/topology/triangle_geometry.h"

#include <glm/geometric.hpp>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace sward::bake {
namespace {

constexpr double goldenAngle = 2.39996322972865332;

// Ray offset from the surface as a share of the ray length; avoids hits on neighbouring triangles.
constexpr double skinShare = 1e-4;

// Cosine of the least angle between an occluder and the plane of a root.
constexpr double steepCosine = 0.70710678118654752;

// Sine of the least angle, 20°, at which rays look for occluders. Lower rays meet mostly far hills.
constexpr double minRise = 0.34202014332566873;

// How many of a root's blocked rays look for occluders.
constexpr std::size_t footRays = 2;

} // namespace

Exposure::Exposure(const terrain::GroundMesh& ground, const BakeSettings& settings,
                   double rayLength, const terrain::SurfaceQuery& query, double footReach)
    : ground_(ground)
    , query_(query)
    , seed_(settings.seed)
    , rayLength_(rayLength)
    , footReach_(std::min(footReach, rayLength))
{
    for (int i = 0; i < settings.exposureRays; ++i) {
        const SinCos angle = exactSinCos(goldenAngle * i);
        spiral_.push_back({angle.cos, angle.sin});
    }
}

template <typename Blocked>
double Exposure::openShare(const RootSample& root, Blocked blocked) const
{
    if (spiral_.empty())
        return 1.0;
    const glm::uvec3 corners = ground_.triangles[root.triangle];
    const glm::dvec3 normal(root.normal);
    const glm::dvec3 along = surfaceTangent(normal, glm::dvec3(ground_.positions[corners.x]),
                                            glm::dvec3(ground_.positions[corners.y]),
                                            glm::dvec3(ground_.positions[corners.z]));
    const auto random = [&](Dimension dimension) {
        return uniform(seed_, keyBits(keyOf(ground_, root)), static_cast<std::uint32_t>(dimension));
    };
    const SinCos turn = exactSinCos(exactTwoPi * random(Dimension::rayTurn));
    const double shift = random(Dimension::raySlope);
    const glm::dvec3 tangent = turn.cos * along + turn.sin * glm::cross(normal, along);
    const glm::dvec3 bitangent = glm::cross(normal, tangent);

    // Rays form a spiral of equal projected solid angles, rotated randomly for each root.
    int open = 0;
    double step = shift;
    for (const Direction& ray : spiral_) {
        const double squared = step / double(spiral_.size());
        step += 1.0;
        const double radius = std::sqrt(squared);
        const glm::dvec3 direction = radius * ray.cos * tangent + radius * ray.sin * bitangent +
                                     std::sqrt(1.0 - squared) * normal;
        const bool isBlocked = query_.occluded(glm::dvec3(root.position), direction, rayLength_,
                                               skinShare * rayLength_, {.one = root.triangle});
        open += isBlocked ? 0 : 1;
        if (isBlocked)
            blocked(direction);
    }
    return double(open) / double(spiral_.size());
}

double Exposure::footDistance(const RootSample& root, glm::dvec3 direction) const
{
    const glm::dvec3 place(root.position);
    const auto hit = query_.cast(place, direction, std::min(2.0 * footReach_, rayLength_),
                                 skinShare * rayLength_, {.one = root.triangle});
    if (!hit.isHit() || std::fabs(glm::dot(ground_.faceNormal(hit.triangle),
                                           glm::dvec3(root.normal))) > steepCosine)
        return std::numeric_limits<double>::infinity();
    const glm::uvec3 corners = ground_.triangles[hit.triangle];
    const terrain::Triangle triangle{glm::dvec3(ground_.positions[corners.x]),
                                     glm::dvec3(ground_.positions[corners.y]),
                                     glm::dvec3(ground_.positions[corners.z])};
    return glm::length(terrain::nearestPoint(triangle, place) - place);
}

double Exposure::at(const RootSample& root) const
{
    return openShare(root, [](glm::dvec3) {});
}

Surroundings Exposure::around(const RootSample& root) const
{
    // The lowest rays come last.
    std::array<glm::dvec3, footRays> low{};
    std::size_t count = 0;
    const double open = openShare(root, [&](glm::dvec3 direction) {
        if (glm::dot(direction, glm::dvec3(root.normal)) > minRise)
            low[count++ % footRays] = direction;
    });
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; footReach_ > 0.0 && i < std::min(count, footRays); ++i)
        nearest = std::min(nearest, footDistance(root, low[i]));
    Surroundings found{static_cast<float>(open), 0.0f};
    if (nearest < footReach_) {
        const double near = 1.0 - nearest / footReach_;
        found.foot = static_cast<float>(near * near * (3.0 - 2.0 * near));
    }
    return found;
}

std::vector<Surroundings> castExposure(const Roots& roots, const terrain::GroundMesh& ground,
                                       const BakeSettings& settings, double scale,
                                       const terrain::SurfaceQuery& query, Progress& progress)
{
    const Exposure sky(ground, settings, settings.rayLength * scale, query,
                       settings.meadow.edges.occluderReach * scale);
    std::vector<Surroundings> found(roots.size());
    progress.begin("rays", roots.size());
    // Roots are in spatial order, so neighbouring rays visit neighbouring nodes.
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, roots.size(), 1024),
                      [&](const tbb::blocked_range<std::size_t>& range) {
                          for (std::size_t i = range.begin(); i < range.end(); ++i)
                              found[i] = sky.around(roots[i]);
                          progress.advance(range.size());
                      });
    return found;
}

} // namespace sward::bake
