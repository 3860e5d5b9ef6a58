#include "bake/filter/border_distance.h"

#include <glm/geometric.hpp>
#include <tbb/parallel_for.h>

#include <algorithm>

namespace sward::bake {

BorderDistance::BorderDistance(const terrain::GroundMesh& ground,
                               const std::vector<terrain::SurfaceFeatures::BorderEdge>& borders,
                               double limit)
    : limit_(limit)
{
    if (borders.empty())
        return;
    std::vector<glm::vec3> ends;
    std::vector<glm::uvec3> segments;
    for (const auto& border : borders) {
        const auto first = static_cast<std::uint32_t>(ends.size());
        ends.push_back(border.from);
        ends.push_back(border.to);
        segments.emplace_back(first, first + 1, first + 1);
    }
    segments_.emplace(ends, segments);

    // Most triangles are far from every border; skip the search for their roots.
    isNear_.resize(ground.triangles.size());
    tbb::parallel_for(std::size_t(0), isNear_.size(), [&](std::size_t t) {
        const glm::uvec3 corners = ground.triangles[t];
        const glm::dvec3 a(ground.positions[corners.x]);
        const glm::dvec3 b(ground.positions[corners.y]);
        const glm::dvec3 c(ground.positions[corners.z]);
        const glm::dvec3 middle = (a + b + c) / 3.0;
        const double radius =
            std::max({glm::length(a - middle), glm::length(b - middle), glm::length(c - middle)});
        // Rounding moves a root by far less than a hundredth of a percent of its triangle.
        constexpr double slack = 1.0001;
        const double reach = (limit + radius) * slack;
        isNear_[t] = segments_->nearest(middle, reach).triangle != terrain::SurfaceQuery::none;
    });
}

terrain::SurfaceQuery::Nearest BorderDistance::nearest(const RootSample& root) const
{
    if (!segments_ || isNear_[root.triangle] == 0)
        return {};
    return segments_->nearest(glm::dvec3(root.position), limit_);
}

} // namespace sward::bake
