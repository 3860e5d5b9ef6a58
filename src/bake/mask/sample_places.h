#pragma once

#include "bake/ground/root_sample.h"
#include "core/random.h"
#include "terrain/ground_mesh.h"

#include <cmath>
#include <cstdint>
#include <vector>

namespace sward::bake {

/// Calls `visit(root)` for `places` places of bearing ground, one in each of equal parts of its
/// area, until it returns false. None if nothing bears.
template <typename Visit>
void forEachPlace(const terrain::GroundMesh& ground, std::uint64_t places, Visit visit)
{
    std::vector<double> upTo; // area of the bearing triangles up to each
    double area = 0.0;
    for (std::size_t t = 0; t < ground.triangles.size(); ++t)
        upTo.push_back(area += ground.bears[t] != 0 ? ground.area(t) : 0.0);
    if (!(area > 0.0))
        return;
    std::size_t triangle = 0;
    for (std::uint64_t i = 0; i < places; ++i) {
        const double at = (double(i) + uniform(0, i, 0)) / double(places) * area;
        while (triangle + 1 < upTo.size() && upTo[triangle] <= at)
            ++triangle;
        const double s = std::sqrt(uniform(0, i, 1));
        const double v = uniform(0, i, 2);
        RootSample root{};
        root.triangle = static_cast<std::uint32_t>(triangle);
        root.barycentric = glm::vec2(glm::dvec2(s * (1.0 - v), s * v));
        if (!visit(root))
            return;
    }
}

} // namespace sward::bake
