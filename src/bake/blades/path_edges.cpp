#include "bake/blades/path_edges.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace sward::bake {

PathEdges::PathEdges(const terrain::GroundMesh& ground, const BakeSettings& settings,
                     const RootFilter& filter, const terrain::SurfaceFeatures* features,
                     double scale)
    : ground_(ground)
    , filter_(filter)
    , reach_(settings.meadow.edges.pathReach * scale)
{
    if (reach_ > 0.0 && features != nullptr && !features->bareEdges.empty())
        bare_.emplace(ground, features->bareEdges, reach_);
}

glm::dvec3 PathEdges::slopeOfWeight(const RootSample& root, double weight) const
{
    const glm::uvec3 corners = ground_.triangles[root.triangle];
    const glm::dvec3 p0(ground_.positions[corners.x]);
    const glm::dvec3 right = glm::dvec3(ground_.positions[corners.y]) - p0;
    const glm::dvec3 left = glm::dvec3(ground_.positions[corners.z]) - p0;
    const glm::dvec3 normal = glm::cross(right, left);
    const double squared = glm::dot(normal, normal);
    if (squared <= 0.0)
        return glm::dvec3(0.0);

    // Weigh two places a step aside, in the plane of the root's triangle. A step is small, so that
    // going on over the triangle's edges does not lead far.
    const double step = 0.1 * reach_;
    const glm::dvec3 along = right / std::sqrt(glm::dot(right, right));
    const glm::dvec3 across = glm::cross(normal, along) / std::sqrt(squared);
    glm::dvec3 slope(0.0);
    for (const glm::dvec3& direction : {along, across}) {
        const glm::dvec3 offset = step * direction;
        RootSample aside = root;
        aside.position += glm::vec3(offset);
        aside.barycentric += glm::vec2(glm::dot(glm::cross(offset, left), normal) / squared,
                                       glm::dot(glm::cross(right, offset), normal) / squared);
        Reject ignored = Reject::mask;
        slope += (filter_.weigh(aside, 0.0, ignored) - weight) / step * direction;
    }
    return slope;
}

PathEdges::Edge PathEdges::at(const RootSample& root, double weight) const
{
    Edge edge;
    if (reach_ <= 0.0)
        return edge;
    if (bare_) {
        const auto found = bare_->nearest(root);
        if (found.distance < reach_) {
            const double near = 1.0 - found.distance / reach_;
            edge.nearness = near * near * (3.0 - 2.0 * near);
            if (found.distance > 1e-6 * reach_)
                edge.away = (glm::dvec3(root.position) - found.point) / found.distance;
        }
    }
    if (weight > 0.0 && weight < 1.0) {
        const glm::dvec3 slope = slopeOfWeight(root, weight);
        const double steepness = std::sqrt(glm::dot(slope, slope));
        // 1 where the weight falls to 0 within the reach, 0 where it takes five reaches.
        const double sharpness = std::clamp(1.25 * steepness * reach_ - 0.25, 0.0, 1.0);
        const double nearness = (1.0 - weight) * sharpness;
        if (nearness > edge.nearness)
            edge = {nearness, slope / steepness};
    }
    return edge;
}

} // namespace sward::bake
