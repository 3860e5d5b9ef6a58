#include "bake/filter/exposure.h"

#include "bake/up_vector.h"
#include "core/exact_math.h"
#include "core/random.h"

#include <glm/geometric.hpp>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cmath>

namespace sward::bake {
namespace {

constexpr double goldenAngle = 2.39996322972865332;

// Ray offset from the surface as a share of the ray length; avoids hits on neighbouring triangles.
constexpr double skinShare = 1e-4;

} // namespace

Exposure::Exposure(const terrain::GroundMesh& ground, const BakeSettings& settings,
                   double rayLength, const terrain::SurfaceQuery& query)
    : ground_(ground)
    , query_(query)
    , seed_(settings.seed)
    , rayLength_(rayLength)
{
    for (int i = 0; i < settings.exposureRays; ++i) {
        const SinCos angle = exactSinCos(goldenAngle * i);
        spiral_.push_back({angle.cos, angle.sin});
    }
}

double Exposure::at(const RootSample& root) const
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
        open += query_.occluded(glm::dvec3(root.position), direction, rayLength_,
                                skinShare * rayLength_, {.one = root.triangle})
                    ? 0
                    : 1;
    }
    return double(open) / double(spiral_.size());
}

std::vector<float> castExposure(const Roots& roots, const terrain::GroundMesh& ground,
                                const BakeSettings& settings, double rayLength,
                                const terrain::SurfaceQuery& query, Progress& progress)
{
    const Exposure sky(ground, settings, rayLength, query);
    std::vector<float> exposure(roots.size());
    progress.begin("rays", roots.size());
    // Roots are in spatial order, so neighbouring rays visit neighbouring nodes.
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, roots.size(), 1024),
                      [&](const tbb::blocked_range<std::size_t>& range) {
                          for (std::size_t i = range.begin(); i < range.end(); ++i)
                              exposure[i] = static_cast<float>(sky.at(roots[i]));
                          progress.advance(range.size());
                      });
    return exposure;
}

} // namespace sward::bake
