#include "bake/session/cell_triangles.h"

#include <algorithm>
#include <cmath>
#include <unordered_set>

namespace sward::bake {
namespace {

// A triangle that touches more cells is near all of them.
constexpr double cellsOfOneTriangle = 1e4;

} // namespace

CellTriangles::CellTriangles(const terrain::GroundMesh& ground)
{
    for (std::uint32_t t = 0; t < ground.triangles.size(); ++t) {
        Aabb box;
        for (glm::length_t corner = 0; corner < 3; ++corner)
            box.add(ground.positions[ground.triangles[t][corner]]);
        const CellNumber first = cellOf(ground.origin, box.low - 0.01f);
        const CellNumber last = cellOf(ground.origin, box.high + 0.01f);
        double touched = 1.0;
        for (std::size_t axis = 0; axis < 3; ++axis)
            touched *= double(last[axis] - first[axis] + 1);
        if (touched > cellsOfOneTriangle) {
            everywhere_.push_back(t);
            continue;
        }
        for (std::int64_t x = first[0]; x <= last[0]; ++x)
            for (std::int64_t y = first[1]; y <= last[1]; ++y)
                for (std::int64_t z = first[2]; z <= last[2]; ++z)
                    inCell_[packCell({x, y, z})].push_back(t);
    }
}

std::vector<std::uint32_t> CellTriangles::near(const std::vector<CellNumber>& cells,
                                               double margin) const
{
    const auto around = static_cast<std::int64_t>(std::ceil(margin / widestPatch));
    std::vector<std::uint32_t> triangles = everywhere_;
    std::unordered_set<std::uint64_t> seen;
    for (const CellNumber& cell : cells)
        for (std::int64_t x = -around; x <= around; ++x)
            for (std::int64_t y = -around; y <= around; ++y)
                for (std::int64_t z = -around; z <= around; ++z) {
                    const std::uint64_t key = packCell({cell[0] + x, cell[1] + y, cell[2] + z});
                    if (const auto found = inCell_.find(key);
                        found != inCell_.end() && seen.insert(key).second)
                        triangles.insert(triangles.end(), found->second.begin(),
                                         found->second.end());
                }
    std::sort(triangles.begin(), triangles.end());
    triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
    return triangles;
}

} // namespace sward::bake
