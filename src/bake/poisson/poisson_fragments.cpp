#include "bake/poisson/poisson_fragments.h"

#include "core/error.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace sward::bake {
namespace {

// Finest level at which candidate numbers of a triangle stay unique.
constexpr int finestLevel = 12;

struct Corners {
    glm::dvec3 corner, first, second; // a corner and its two edges

    Corners(const terrain::GroundMesh& ground, std::size_t triangle)
    {
        const glm::uvec3 t = ground.triangles[triangle];
        corner = glm::dvec3(ground.positions[t.x]);
        first = glm::dvec3(ground.positions[t.y]) - corner;
        second = glm::dvec3(ground.positions[t.z]) - corner;
    }

    glm::dvec3 at(double b, double c) const { return corner + b * first + c * second; }

    double longestEdge() const
    {
        const glm::dvec3 third = second - first;
        return std::sqrt(
            std::max({glm::dot(first, first), glm::dot(second, second), glm::dot(third, third)}));
    }
};

// Lowest level that cuts edges of this length to at most `longest`.
int levelFor(double edge, double longest)
{
    int level = 0;
    while (edge > longest) {
        edge *= 0.5;
        ++level;
    }
    return level;
}

class Sorter {
public:
    Sorter(const terrain::GroundMesh& ground, const PoissonLattice& lattice, double longest)
        : ground_(ground)
        , lattice_(lattice)
        , longest_(longest)
    {
    }

    void add(std::size_t triangle, bool back, std::vector<RegionPiece>& pieces)
    {
        const Corners corners(ground_, triangle);
        const int level = std::min(levelFor(corners.longestEdge(), 0.5 * lattice_.side()),
                                   fragmentLevel(ground_, triangle, longest_));
        const auto rows = std::uint32_t(1) << level;
        for (std::uint32_t j = 0; j < rows; ++j)
            for (std::uint32_t i = 0; i + j < rows; ++i)
                for (const bool turned : {false, true}) {
                    if (turned && i + j + 1 >= rows)
                        continue;
                    const Fragment part = fragmentAt(level, i, j, turned);
                    const auto b = double(part.b);
                    const auto c = double(part.c);
                    const auto size = double(part.size);
                    const glm::dvec3 p0 = corners.at(b, c);
                    const glm::dvec3 p1 = corners.at(b + size, c);
                    const glm::dvec3 p2 = corners.at(b, c + size);
                    keys_.clear();
                    lattice_.addRegionsOf(glm::min(glm::min(p0, p1), p2),
                                          glm::max(glm::max(p0, p1), p2), keys_);
                    for (const PoissonLattice::Key key : keys_)
                        pieces.push_back(
                            {key, static_cast<std::uint32_t>(triangle),
                             static_cast<std::uint16_t>(i), static_cast<std::uint16_t>(j),
                             static_cast<std::uint8_t>(level), turned, keys_.size() == 1, back});
                }
    }

private:
    const terrain::GroundMesh& ground_;
    const PoissonLattice& lattice_;
    double longest_;
    std::vector<PoissonLattice::Key> keys_;
};

} // namespace

int fragmentLevel(const terrain::GroundMesh& ground, std::size_t triangle, double longest)
{
    const double edge = Corners(ground, triangle).longestEdge();
    const int level = levelFor(edge, longest);
    if (level > finestLevel)
        fail(ErrorKind::input,
             "triangle {} has an edge of {:.4g} m; for this spacing at most {:.4g} m can be "
             "sampled (cut the triangle, or take a wider spacing)",
             ground.source(triangle), edge, longest * double(1 << finestLevel));
    return level;
}

std::vector<RegionPiece> piecesByRegion(const terrain::GroundMesh& ground, Sides sides,
                                        const PoissonLattice& lattice, double longest)
{
    tbb::enumerable_thread_specific<std::vector<RegionPiece>> parts;
    constexpr std::size_t grain = 4096;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, ground.triangles.size(), grain),
                      [&](const tbb::blocked_range<std::size_t>& range) {
                          Sorter sorter(ground, lattice, longest);
                          std::vector<RegionPiece>& own = parts.local();
                          for (std::size_t t = range.begin(); t < range.end(); ++t) {
                              if (ground.bears[t] == 0 || !(ground.area(t) > 0.0))
                                  continue;
                              if (sides != Sides::back)
                                  sorter.add(t, false, own);
                              if (sides != Sides::front)
                                  sorter.add(t, true, own);
                          }
                      });
    std::size_t count = 0;
    for (const std::vector<RegionPiece>& part : parts)
        count += part.size();
    std::vector<RegionPiece> pieces;
    pieces.reserve(count);
    for (std::vector<RegionPiece>& part : parts) {
        pieces.insert(pieces.end(), part.begin(), part.end());
        part = {};
    }
    tbb::parallel_sort(
        pieces.begin(), pieces.end(), [](const RegionPiece& a, const RegionPiece& b) {
            return std::tie(a.region, a.triangle, a.row, a.column, a.turned, a.back) <
                   std::tie(b.region, b.triangle, b.row, b.column, b.turned, b.back);
        });
    return pieces;
}

} // namespace sward::bake
