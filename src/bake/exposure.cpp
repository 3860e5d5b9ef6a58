#include "bake/exposure.h"

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
constexpr double twoPi = 6.28318530717958648;

// Rays leave the surface by this share of their length, so that the root's neighbours do not catch
// them.
constexpr double skinShare = 1e-4;

// Share of the sky that one root sees.
double exposureOf(const RootSample& root, const terrain::GroundMesh& ground,
                  const BakeSettings& settings, double rayLength,
                  const terrain::SurfaceQuery& query)
{
    const glm::uvec3 corners = ground.triangles[root.triangle];
    const glm::dvec3 normal(root.normal);
    const glm::dvec3 tangent = surfaceTangent(normal, glm::dvec3(ground.positions[corners.x]),
                                              glm::dvec3(ground.positions[corners.y]),
                                              glm::dvec3(ground.positions[corners.z]));
    const glm::dvec3 bitangent = glm::cross(normal, tangent);
    const auto random = [&](Dimension dimension) {
        return uniform(settings.seed, keyBits(keyOf(ground, root)),
                       static_cast<std::uint32_t>(dimension));
    };
    const double turn = twoPi * random(Dimension::rayTurn);
    const double shift = random(Dimension::raySlope);

    // A spiral of equal shares of the projected hemisphere, turned at random for each root.
    int open = 0;
    for (int i = 0; i < settings.exposureRays; ++i) {
        const double squared = (i + shift) / settings.exposureRays;
        const double radius = std::sqrt(squared);
        const SinCos angle = exactSinCos(turn + goldenAngle * i);
        const glm::dvec3 direction = radius * angle.cos * tangent + radius * angle.sin * bitangent +
                                     std::sqrt(1.0 - squared) * normal;
        const auto hit =
            query.cast(glm::dvec3(root.position), direction, rayLength, skinShare * rayLength);
        open += hit.isHit() ? 0 : 1;
    }
    return double(open) / settings.exposureRays;
}

} // namespace

std::vector<float> castExposure(const Roots& roots, const terrain::GroundMesh& ground,
                                const BakeSettings& settings, double rayLength,
                                const terrain::SurfaceQuery& query, Progress& progress)
{
    std::vector<float> exposure(roots.size());
    progress.begin("rays", roots.size());
    // Roots lie in spatial order, so neighbouring rays meet neighbouring nodes.
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, roots.size(), 1024),
                      [&](const tbb::blocked_range<std::size_t>& range) {
                          for (std::size_t i = range.begin(); i < range.end(); ++i)
                              exposure[i] = static_cast<float>(
                                  exposureOf(roots[i], ground, settings, rayLength, query));
                          progress.advance(range.size());
                      });
    return exposure;
}

} // namespace sward::bake
