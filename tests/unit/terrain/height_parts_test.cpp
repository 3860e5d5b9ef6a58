// Parts of a grid of heights are parts of its ground, bit by bit; rays on a grid find what Embree
// finds.
#include "core/random.h"
#include "terrain/heightmap/heightfield.h"
#include "terrain/query/surface_query.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <vector>

namespace sward::terrain {
namespace {

constexpr std::uint32_t sideOfParts = 97;

// Rough hills far from the origin, with a step, a hole and single gaps.
std::vector<double> roughHeights()
{
    std::vector<double> heights;
    for (std::uint32_t j = 0; j < sideOfParts; ++j)
        for (std::uint32_t i = 0; i < sideOfParts; ++i) {
            const bool isGap =
                (i > 40 && i < 47 && j > 60 && j < 70) || (i * 131 + j * 71) % 977 == 0;
            heights.push_back(isGap ? std::numeric_limits<double>::quiet_NaN()
                                    : 300.0 + 4.0 * std::sin(0.1 * i) + 3.0 * std::cos(0.13 * j) +
                                          0.3 * uniform(3, j * sideOfParts + i, 0) +
                                          (i > 70 ? 5.0 : 0.0));
        }
    return heights;
}

HeightGrid roughGrid()
{
    return {.extent = {48.0, 72.0},
            .cells = {sideOfParts - 1, sideOfParts - 1},
            .middle = {9013.0, -4711.0}};
}

TEST(HeightParts, AreThoseOfTheWholeBitByBit)
{
    const std::vector<double> heights = roughHeights();
    const GroundMesh whole = heightfield(roughGrid(), heights, {}, "whole");
    const glm::uvec2 first(32, 20), cells(40, 55);
    HeightPart part;
    part.first = first - 1U;
    part.points = cells + 3U;
    part.firstCell = {1, 1};
    part.cells = cells;
    part.origin = whole.origin;
    std::vector<std::uint32_t> rows;
    // Triangles of the whole in its order: the first of each row at or behind the first column.
    const HeightCells& all = *whole.heightCells;
    for (std::uint32_t j = first.y; j < first.y + cells.y; ++j) {
        std::uint32_t i = first.x;
        while (all.triangles[std::size_t(j) * all.count.x + i] % 4 == 0)
            ++i;
        rows.push_back(all.triangles[std::size_t(j) * all.count.x + i] / 4);
    }
    part.firstTriangle = rows;
    std::vector<double> own;
    for (std::uint32_t j = 0; j < part.points.y; ++j)
        for (std::uint32_t i = 0; i < part.points.x; ++i)
            own.push_back(heights[std::size_t(part.first.y + j) * sideOfParts + part.first.x + i]);
    const GroundMesh ground = heightfield(roughGrid(), part, own, "part");
    ASSERT_GT(ground.triangles.size(), 3000U);
    ASSERT_EQ(ground.sourceOf.size(), ground.triangles.size());
    for (std::size_t t = 0; t < ground.triangles.size(); ++t)
        for (glm::length_t k = 0; k < 3; ++k) {
            const std::uint32_t there = whole.triangles[ground.source(t)][k];
            const std::uint32_t here = ground.triangles[t][k];
            ASSERT_EQ(ground.positions[here], whole.positions[there]) << t;
            ASSERT_EQ(ground.normals[here], whole.normals[there]) << t;
            ASSERT_EQ(ground.uvs[here], whole.uvs[there]) << t;
        }
}

TEST(HeightParts, ThinOutToTheLastLine)
{
    HeightPart part;
    part.stride = 7; // 96 cells are no multiple
    part.points = {15, 15};
    part.cells = {14, 14};
    const GroundMesh ground =
        heightfield(roughGrid(), part, std::vector<double>(15 * 15, 2.0), "overview");
    const Aabb box = ground.bounds();
    EXPECT_NEAR(double(box.high.x - box.low.x), 48.0, 1e-3);
    EXPECT_NEAR(double(box.high.z - box.low.z), 72.0, 1e-3);
    EXPECT_EQ(ground.heightCells, nullptr);
}

class HeightRaysOnHills : public testing::Test {
protected:
    HeightRaysOnHills()
        : ground(heightfield(roughGrid(), roughHeights(), {}, "hills"))
        , grid(ground)
        , embree(ground.positions, ground.triangles)
    {
    }

    struct Start {
        glm::dvec3 point;
        glm::dvec3 direction;
        std::uint32_t triangle;
    };

    // A place on the ground, as a root is, and a direction of any kind.
    Start start(std::uint64_t n) const
    {
        const auto t =
            static_cast<std::uint32_t>(uniform(1, n, 0) * double(ground.triangles.size()));
        const glm::uvec3 corners = ground.triangles[t];
        double u = uniform(1, n, 1), v = uniform(1, n, 2);
        if (n % 5 == 0) // a corner
            u = v = 0.0;
        if (u + v > 1.0)
            u = 1.0 - u, v = 1.0 - v;
        const glm::dvec3 a(ground.positions[corners.x]), b(ground.positions[corners.y]),
            c(ground.positions[corners.z]);
        const glm::vec3 rounded(a + u * (b - a) + v * (c - a));
        glm::dvec3 direction(uniform(2, n, 0) - 0.5, uniform(2, n, 1) - 0.2,
                             uniform(2, n, 2) - 0.5);
        if (n % 7 == 0)
            direction = {0.0, n % 2 == 0 ? 1.0 : -1.0, 0.0};
        const double lift = n % 3 == 0 ? 3.0 * uniform(2, n, 3) : 0.0;
        return {glm::dvec3(rounded) + glm::dvec3(0.0, lift, 0.0), glm::normalize(direction), t};
    }

    GroundMesh ground;
    SurfaceQuery grid;
    SurfaceQuery embree;
};

TEST_F(HeightRaysOnHills, MeetWhatEmbreeMeets)
{
    // Rounding may decide otherwise where a ray passes an edge: Embree works in single precision.
    // A ray that starts in a corner begins on the edges of five triangles that it does not ignore.
    std::array<std::array<int, 3>, 2> differences{}; ///< of rays from within; of rays from a corner
    int hits = 0;
    constexpr int rays = 20'000;
    for (std::uint64_t n = 0; n < rays; ++n) {
        const Start from = start(n);
        const double limit = n % 4 == 0 ? 40.0 : 8.0;
        const IgnoredTriangles own{.one = from.triangle};
        std::array<int, 3>& differ = differences[n % 5 == 0 ? 1 : 0];
        const bool isHit = grid.occluded(from.point, from.direction, limit, 8e-4, own);
        hits += isHit ? 1 : 0;
        differ[0] += isHit != embree.occluded(from.point, from.direction, limit, 8e-4, own) ? 1 : 0;
        const SurfaceQuery::Hit a = grid.cast(from.point, from.direction, limit, 8e-4, own),
                                b = embree.cast(from.point, from.direction, limit, 8e-4, own);
        EXPECT_EQ(a.isHit(), isHit) << n;
        const SurfaceQuery::Hit c = grid.castThrough(from.point, from.direction, limit, 8e-4, own);
        EXPECT_EQ(a.triangle, c.triangle);
        differ[1] += a.isHit() != b.isHit() ? 1 : 0;
        differ[2] += a.isHit() && b.isHit() && std::fabs(a.distance - b.distance) > 1e-6 ? 1 : 0;
    }
    EXPECT_GT(hits, rays / 10);
    EXPECT_LT(hits, rays * 9 / 10);
    for (const int count : differences[0])
        EXPECT_LE(count, rays * 4 / 5 / 2000);
    for (const int count : differences[1])
        EXPECT_LE(count, rays / 5 / 100);
}

TEST_F(HeightRaysOnHills, KnowTheNearestPoint)
{
    for (std::uint64_t n = 0; n < 50; ++n) {
        const Start from = start(n);
        const glm::dvec3 above = from.point + glm::dvec3(0.0, 1.0, 0.0);
        EXPECT_EQ(grid.nearest(above, 5.0).triangle, embree.nearest(above, 5.0).triangle);
    }
}

TEST_F(HeightRaysOnHills, AreNotAskedOfGroundThatWasMoved)
{
    for (glm::vec3& position : ground.positions)
        position.x += 10.0f;
    const SurfaceQuery moved(ground), other(ground.positions, ground.triangles);
    for (std::uint64_t n = 0; n < 500; ++n) {
        const Start from = start(n);
        EXPECT_EQ(moved.cast(from.point, from.direction, 20.0, 8e-4).triangle,
                  other.cast(from.point, from.direction, 20.0, 8e-4).triangle);
    }
}

} // namespace
} // namespace sward::terrain
