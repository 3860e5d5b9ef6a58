#include "core/random.h"
#include "support/meshes.h"
#include "terrain/procedural/landforms.h"
#include "terrain/query/surface_query.h"
#include "terrain/topology/triangle_geometry.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace sward::terrain {
namespace {

glm::dvec3 randomPoint(std::uint64_t index, double reach)
{
    return reach * glm::dvec3(2.0 * uniform(7, index, 0) - 1.0, 2.0 * uniform(7, index, 1) - 1.0,
                              2.0 * uniform(7, index, 2) - 1.0);
}

Triangle triangleOf(const GroundMesh& mesh, std::size_t index)
{
    const glm::uvec3 t = mesh.triangles[index];
    return {glm::dvec3(mesh.positions[t.x]), glm::dvec3(mesh.positions[t.y]),
            glm::dvec3(mesh.positions[t.z])};
}

TEST(SurfaceQuery, MeasuresTheFreeHeightUnderABox)
{
    const SurfaceQuery query(meshes::boxAbovePlane());
    const glm::dvec3 up(0, 1, 0);
    EXPECT_NEAR(query.clearance({0.3, 0, 0.2}, up, 10.0, 0), 1.0, 1e-9);
    EXPECT_EQ(query.clearance({3, 0, 3}, up, 10.0, 0), 10.0);
    EXPECT_EQ(query.clearance({0.3, 0, 0.2}, up, 0.5, 0), 0.5) << "the limit lies below the box";
}

TEST(SurfaceQuery, NeverCountsTheOwnTriangle)
{
    // A ray from 1 m below its own triangle: what is hit is the box behind it.
    const SurfaceQuery query(meshes::boxAbovePlane());
    const glm::dvec3 below(0.3, -1.0, 0.2);
    const SurfaceQuery::Hit own = query.cast(below, {0, 1, 0}, 10.0, 0.0);
    ASSERT_TRUE(own.isHit());
    ASSERT_LT(own.triangle, 2U);
    EXPECT_NEAR(query.clearance(below, {0, 1, 0}, 10.0, own.triangle), 2.0, 1e-9);
    EXPECT_NEAR(query.clearance(below, {0, 1, 0}, 10.0, 1 - own.triangle), 1.0, 1e-9);
}

TEST(SurfaceQuery, StandsFreeOnEveryTriangleOfASphere)
{
    const GroundMesh mesh = meshes::sphere(32, 10.0);
    const SurfaceQuery query(mesh);
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
        const Triangle t = triangleOf(mesh, i);
        const glm::dvec3 middle = (t.a + t.b + t.c) / 3.0;
        EXPECT_EQ(query.clearance(middle, glm::normalize(middle), 5.0, i), 5.0) << "triangle " << i;
        EXPECT_LT(query.clearance(middle, -glm::normalize(middle), 50.0, i), 20.0)
            << "triangle " << i;
    }
}

TEST(SurfaceQuery, SkipsTheSkin)
{
    const SurfaceQuery query(meshes::boxAbovePlane());
    EXPECT_NEAR(query.cast({0, -1, 0}, {0, 1, 0}, 10.0, 1.5).distance, 2.0, 1e-9);
    EXPECT_FALSE(query.cast({0, -1, 0}, {0, 1, 0}, 10.0, 4.5).isHit());
    EXPECT_FALSE(query.cast({0, -1, 0}, {0, -1, 0}, 10.0, 0.0).isHit());
}

TEST(SurfaceQuery, AgreesWithEveryTriangleTriedInTurn)
{
    const GroundMesh mesh = makeHills({.grid = {glm::dvec2(20.0), glm::uvec2(24U)}});
    const SurfaceQuery query(mesh);
    int hits = 0;
    for (std::uint64_t i = 0; i < 2000; ++i) {
        const glm::dvec3 from = randomPoint(i, 12.0);
        const glm::dvec3 to = glm::normalize(randomPoint(i + 100'000, 1.0));

        // Möller & Trumbore 1997, away from edges, where the two may see another triangle first.
        double best = std::numeric_limits<double>::infinity();
        bool edge = false;
        for (std::size_t j = 0; j < mesh.triangles.size(); ++j) {
            const Triangle t = triangleOf(mesh, j);
            const glm::dvec3 p = glm::cross(to, t.c - t.a);
            const double determinant = glm::dot(p, t.b - t.a);
            const glm::dvec3 s = from - t.a;
            const double u = glm::dot(s, p) / determinant;
            const glm::dvec3 q = glm::cross(s, t.b - t.a);
            const double v = glm::dot(to, q) / determinant;
            const double distance = glm::dot(t.c - t.a, q) / determinant;
            const double inside = std::min({u, v, 1.0 - u - v});
            edge = edge || (std::fabs(inside) < 1e-3 && distance > -0.01 && distance < 15.0);
            if (inside >= 0.0 && distance > 0.0 && distance <= 15.0)
                best = std::min(best, distance);
        }
        if (edge)
            continue;
        const SurfaceQuery::Hit hit = query.cast(from, to, 15.0, 0.0);
        ASSERT_EQ(hit.isHit(), std::isfinite(best)) << "ray " << i;
        if (hit.isHit()) {
            EXPECT_NEAR(hit.distance, best, 1e-9 * (1.0 + best)) << "ray " << i;
            ++hits;
        }
    }
    EXPECT_GT(hits, 300);
}

TEST(SurfaceQuery, FindsTheSameByOneTraversal)
{
    // Two sheets, of which rays meet several triangles; also along edges and through corners.
    GroundMesh mesh = makeHills({.grid = {glm::dvec2(20.0), glm::uvec2(24U)}});
    append(mesh, meshes::grid(24, 20.0));
    const SurfaceQuery query(mesh);
    int hits = 0;
    const auto compare = [&](const glm::dvec3& from, const glm::dvec3& to, double skin) {
        const SurfaceQuery::Hit meant = query.cast(from, to, 9.0, skin);
        const SurfaceQuery::Hit found = query.castThrough(from, to, 9.0, skin);
        EXPECT_EQ(found.triangle, meant.triangle);
        EXPECT_EQ(found.distance, meant.distance);
        hits += found.isHit() ? 1 : 0;
    };
    for (std::uint64_t i = 0; i < 3000; ++i)
        compare(randomPoint(i, 11.0), glm::normalize(randomPoint(i + 100'000, 1.0)),
                i % 3 == 0 ? 1.0 : 0.0);
    for (const glm::vec3& position : mesh.positions)
        compare(glm::dvec3(position) + glm::dvec3(0, 4, 0), {0, -1, 0}, 0.0);
    EXPECT_GT(hits, 1500);
}

TEST(SurfaceQuery, LetsNoRayThroughTheEdgesBetweenTriangles)
{
    const GroundMesh mesh = meshes::sphere(48, 3.0);
    const SurfaceQuery query(mesh);
    for (const glm::uvec3& t : mesh.triangles)
        for (glm::length_t e = 0; e < 3; ++e) {
            const glm::dvec3 a(mesh.positions[t[e]]);
            const glm::dvec3 b(mesh.positions[t[(e + 1) % 3]]);
            for (const double share : {0.0, 0.37, 0.5})
                EXPECT_TRUE(
                    query.cast(glm::dvec3(0.0), glm::normalize(a + share * (b - a)), 4.0, 0.0)
                        .isHit());
        }
}

TEST(SurfaceQuery, GivesTheLowestTriangleAmongEquals)
{
    // The same square three times, one upon the other.
    GroundMesh mesh = meshes::square(2.0);
    append(mesh, meshes::square(2.0));
    append(mesh, meshes::square(2.0));
    const SurfaceQuery query(mesh);
    for (std::uint64_t i = 0; i < 200; ++i) {
        glm::dvec3 from = randomPoint(i, 0.9);
        from.y = 1.0;
        EXPECT_LT(query.cast(from, {0, -1, 0}, 2.0, 0.0).triangle, 2U);
        EXPECT_LT(query.nearest(from).triangle, 2U);
    }
}

TEST(SurfaceQuery, FindsTheNearestPointOfAll)
{
    GroundMesh mesh = makeHills({.grid = {glm::dvec2(20.0), glm::uvec2(20U)}});
    append(mesh, meshes::boxAbovePlane());
    const SurfaceQuery query(mesh);
    for (std::uint64_t i = 0; i < 500; ++i) {
        const glm::dvec3 point = randomPoint(i, 15.0);
        double best = std::numeric_limits<double>::infinity();
        for (std::size_t j = 0; j < mesh.triangles.size(); ++j)
            best = std::min(best, glm::length(nearestPoint(triangleOf(mesh, j), point) - point));
        const SurfaceQuery::Nearest nearest = query.nearest(point);
        EXPECT_EQ(nearest.distance, best) << "point " << i;
        EXPECT_NEAR(glm::length(nearest.point - point), best, 1e-12);
    }
}

TEST(SurfaceQuery, OneRayAndTwoAgreeWhetherSomethingIsInTheWay)
{
    // Hills with a box, near the origin and where floats are coarse; rays that start on triangles.
    for (const double offset : {0.0, 900.0}) {
        GroundMesh mesh = makeHills({.grid = {glm::dvec2(20.0), glm::uvec2(24U)}});
        append(mesh, meshes::boxAbovePlane());
        for (glm::vec3& position : mesh.positions)
            position += glm::vec3(glm::dvec3(offset));
        const SurfaceQuery query(mesh);
        int blocked = 0;
        for (std::uint64_t i = 0; i < 20'000; ++i) {
            const auto own = static_cast<std::uint32_t>(i % mesh.triangles.size());
            const Triangle t = triangleOf(mesh, own);
            const double u = uniform(8, i, 0);
            const glm::dvec3 from =
                t.a + (1.0 - u) * (t.b - t.a) + u * uniform(8, i, 1) * (t.c - t.b);
            const glm::dvec3 to = glm::normalize(randomPoint(i + 50'000, 1.0));
            const double skin = i % 3 == 0 ? 0.0 : 1e-4;
            const std::uint32_t skipped = i % 2 == 0 ? own : SurfaceQuery::none;
            const bool one = query.occluded(from, to, 6.0, skin, {.one = skipped});
            if (skipped == SurfaceQuery::none) {
                ASSERT_EQ(one, query.cast(from, to, 6.0, skin).isHit()) << "ray " << i;
            } else if (skin > 0.0) {
                ASSERT_EQ(query.isClear(from, to, 6.0, own),
                          query.clearance(from, to, 6.0, own) == 6.0)
                    << "ray " << i;
            }
            blocked += one ? 1 : 0;
        }
        EXPECT_GT(blocked, 2000);
        EXPECT_LT(blocked, 18'000);
    }
}

TEST(SurfaceQuery, PassesThroughWhatIsIgnored)
{
    const GroundMesh mesh = meshes::boxAbovePlane();
    const SurfaceQuery query(mesh);
    std::vector<std::uint8_t> box(mesh.triangles.size(), 1);
    box[0] = box[1] = 0;
    const glm::dvec3 from(0.3, 5.0, 0.2);
    EXPECT_NEAR(query.cast(from, {0, -1, 0}, 9.0, 0.0).distance, 2.0, 1e-9);
    EXPECT_NEAR(query.cast(from, {0, -1, 0}, 9.0, 0.0, {.marked = box}).distance, 5.0, 1e-9);
    EXPECT_FALSE(query.occluded(from, {0, -1, 0}, 4.5, 0.0, {.marked = box}));
    EXPECT_TRUE(query.occluded(from, {0, -1, 0}, 5.5, 0.0, {.marked = box}));
}

TEST(SurfaceQuery, WhatLiesBeyondReachChangesNoAnswer)
{
    const GroundMesh part = makeHills({.grid = {glm::dvec2(20.0), glm::uvec2(24U)}});
    GroundMesh whole = part;
    GroundMesh far = meshes::cube(50.0);
    for (glm::vec3& position : far.positions)
        position += glm::vec3(1000.0f, 0.0f, 0.0f);
    append(whole, far);
    const SurfaceQuery near(part);
    const SurfaceQuery all(whole);
    for (std::uint64_t i = 0; i < 5000; ++i) {
        const glm::dvec3 from = randomPoint(i, 10.0);
        const glm::dvec3 to = glm::normalize(randomPoint(i + 200'000, 1.0));
        const SurfaceQuery::Hit a = near.cast(from, to, 8.0, 1e-4);
        const SurfaceQuery::Hit b = all.cast(from, to, 8.0, 1e-4);
        ASSERT_EQ(a.triangle, b.triangle);
        ASSERT_EQ(a.distance, b.distance);
        ASSERT_EQ(near.occluded(from, to, 8.0, 1e-4), all.occluded(from, to, 8.0, 1e-4));
        ASSERT_EQ(near.nearest(from).point, all.nearest(from).point);
    }
}

TEST(SurfaceQuery, FindsNothingNearestBeyondTheLimit)
{
    const SurfaceQuery query(meshes::square(2.0));
    EXPECT_NEAR(query.nearest({0.3, 0.25, 0.1}, 0.26).distance, 0.25, 1e-12);
    EXPECT_EQ(query.nearest({0.3, 0.25, 0.1}, 0.24).triangle, SurfaceQuery::none);
    EXPECT_EQ(query.nearest({0.3, 0.25, 0.1}, 0.25).distance, 0.25) << "the limit counts";
}

TEST(SurfaceQuery, MeasuresTheDistanceToSegments)
{
    // A triangle without width is a segment.
    const std::vector<glm::vec3> ends = {{0, 0, 0}, {4, 0, 0}, {4, 0, 3}};
    const std::vector<glm::uvec3> segments = {{0, 1, 1}, {1, 2, 2}};
    const SurfaceQuery query(ends, segments);
    EXPECT_NEAR(query.nearest({1.0, 2.0, -0.5}, 9.0).distance, std::sqrt(4.25), 1e-12);
    EXPECT_EQ(query.nearest({4.5, 0.0, 2.0}, 9.0).triangle, 1U);
    EXPECT_NEAR(query.nearest({7.0, 0.0, 7.0}, 9.0).distance, 5.0, 1e-12);
    EXPECT_EQ(query.nearest({7.0, 0.0, 7.0}, 4.9).triangle, SurfaceQuery::none);
}

TEST(NearestPoint, IsNeverBeatenByAPointOfTheTriangle)
{
    for (std::uint64_t i = 0; i < 300; ++i) {
        const Triangle t{randomPoint(4 * i, 1.0), randomPoint(4 * i + 1, 1.0),
                         randomPoint(4 * i + 2, 1.0)};
        const glm::dvec3 point = randomPoint(4 * i + 3, 2.0);
        const double found = glm::length(nearestPoint(t, point) - point);
        for (int u = 0; u <= 20; ++u)
            for (int v = 0; u + v <= 20; ++v) {
                const glm::dvec3 on = t.a + (t.b - t.a) * (u / 20.0) + (t.c - t.a) * (v / 20.0);
                ASSERT_LE(found, glm::length(on - point) + 1e-12) << "triangle " << i;
            }
    }
}

} // namespace
} // namespace sward::terrain
