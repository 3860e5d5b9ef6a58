#include "core/math/exact_math.h"
#include "support/meshes.h"
#include "terrain/heightmap/heightfield.h"
#include "terrain/procedural/landforms.h"
#include "terrain/procedural/primitives.h"
#include "terrain/topology/surface_features.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace sward::terrain {
namespace {

using testing::Each;
using testing::FloatNear;

std::vector<float> curvatureOf(const GroundMesh& mesh)
{
    return meanCurvature(mesh, analyse(mesh));
}

SurfaceFeatures featuresOf(const GroundMesh& mesh)
{
    return findFeatures(mesh, analyse(mesh), {.curvature = true, .islands = true, .borders = true});
}

double borderLength(const SurfaceFeatures& features)
{
    double length = 0.0;
    for (const SurfaceFeatures::BorderEdge& edge : features.borders)
        length += double(glm::length(edge.to - edge.from));
    return length;
}

TEST(MeanCurvature, OfASphereIsOneOverItsRadius)
{
    for (const double radius : {0.01, 1.0, 250.0}) {
        const auto share = static_cast<float>(1.0 / radius);
        EXPECT_THAT(curvatureOf(meshes::sphere(128, radius)),
                    Each(FloatNear(share, 0.001f * share)));
    }
}

TEST(MeanCurvature, IsNegativeInsideASphere)
{
    GroundMesh hollow = meshes::sphere(128, 2.0);
    for (glm::uvec3& t : hollow.triangles)
        std::swap(t.y, t.z);
    EXPECT_THAT(curvatureOf(hollow), Each(FloatNear(-0.5f, 0.0005f)));
}

TEST(MeanCurvature, OfAPlaneIsZeroUpToItsBorder)
{
    const GroundMesh plane =
        heightfield({glm::dvec2(8.0), glm::uvec2(16U)}, [](double, double) { return 1.25; });
    EXPECT_THAT(curvatureOf(plane), Each(0.0f));
}

TEST(MeanCurvature, OfATorusChangesFromItsOuterToItsInnerSide)
{
    // κ₁ = 1/r, κ₂ = cos φ/(R + r cos φ).
    const double ring = 3.0;
    const double tube = 1.0;
    const GroundMesh mesh = makeTorus(
        {.majorRadius = ring, .minorRadius = tube, .majorSegments = 256, .minorSegments = 128});
    const std::vector<float> curvature = curvatureOf(mesh);
    for (std::size_t v = 0; v < curvature.size(); ++v) {
        const glm::dvec3 p = mesh.origin + glm::dvec3(mesh.positions[v]);
        const double out = std::sqrt(p.x * p.x + p.z * p.z);
        const double cosine = (out - ring) / tube;
        ASSERT_NEAR(double(curvature[v]), 0.5 * (1.0 / tube + cosine / out), 0.02)
            << "vertex " << v;
    }
}

TEST(MeanCurvature, OfASaddleIsZeroAndOfAValleyNegative)
{
    const auto middle = [](auto height) {
        const GroundMesh mesh = heightfield({glm::dvec2(2.0), glm::uvec2(64U)}, height);
        const std::vector<float> curvature = curvatureOf(mesh);
        std::size_t nearest = 0;
        for (std::size_t v = 0; v < mesh.positions.size(); ++v)
            if (glm::length(glm::vec2(mesh.positions[v].x, mesh.positions[v].z)) <
                glm::length(glm::vec2(mesh.positions[nearest].x, mesh.positions[nearest].z)))
                nearest = v;
        return double(curvature[nearest]);
    };
    EXPECT_NEAR(middle([](double x, double z) { return 0.3 * (x * x - z * z); }), 0.0, 1e-3);
    EXPECT_NEAR(middle([](double x, double) { return 0.25 * x * x; }), -0.25, 5e-3);
    EXPECT_NEAR(middle([](double x, double) { return -0.25 * x * x; }), 0.25, 5e-3);
}

TEST(MeanCurvature, IsTheSameFarFromTheOriginAndInAnyPosition)
{
    const GroundMesh sphere = meshes::sphere(64, 5.0);
    EXPECT_THAT(curvatureOf(meshes::moved(sphere, {1e6, -1e6, 1e6})),
                Each(FloatNear(0.2f, 0.001f)));
    EXPECT_THAT(curvatureOf(meshes::rotated(sphere, glm::dquat(glm::dvec3(0.4, 1.0, -2.0)))),
                Each(FloatNear(0.2f, 0.001f)));
}

TEST(MeanCurvature, OfACubeIsThatOfTheSphereThroughItsCorners)
{
    EXPECT_THAT(curvatureOf(meshes::cube(2.0)),
                Each(FloatNear(static_cast<float>(1.0 / std::sqrt(3.0)), 1e-6f)));
}

TEST(MeanCurvature, IsZeroWhereNothingCanBeSaid)
{
    EXPECT_THAT(curvatureOf(meshes::triangle()), Each(0.0f));
    // The pages of a book are flat; at its spine three triangles give no curvature.
    EXPECT_THAT(curvatureOf(meshes::book()), Each(0.0f));
    // Two triangles back to back: they meet at a rim that turns over.
    const GroundMesh leaf = meshes::soup({{0, 0, 0}, {0, 0, 1}, {1, 0, 0}}, {{0, 1, 2}, {0, 2, 1}});
    EXPECT_THAT(curvatureOf(leaf), Each(testing::Truly([](float c) { return std::isfinite(c); })));
    EXPECT_THAT(curvatureOf(meshes::moebius(64)),
                Each(testing::Truly([](float c) { return std::fabs(c) < 2.0f; })));
}

TEST(MeanCurvature, CountsATriangleThatIsThereTwiceOnce)
{
    GroundMesh twice = meshes::sphere(64, 1.0);
    const std::size_t triangles = twice.triangles.size();
    twice.triangles.insert(twice.triangles.end(), twice.triangles.begin(), twice.triangles.end());
    for (auto* perTriangle : {&twice.materialOf, &twice.nodeOf})
        perTriangle->resize(2 * triangles, 0);
    twice.bears.resize(2 * triangles, 1);
    EXPECT_THAT(curvatureOf(twice), Each(FloatNear(1.0f, 0.001f)));
}

TEST(BorderEdges, AreTheRimOfAnOpenSquareAndNoneOfAClosedMesh)
{
    EXPECT_DOUBLE_EQ(borderLength(featuresOf(meshes::square(3.0))), 12.0);
    EXPECT_TRUE(featuresOf(meshes::cube()).borders.empty());
    EXPECT_TRUE(featuresOf(meshes::sphere()).borders.empty());
    EXPECT_EQ(featuresOf(meshes::moebius(32)).borders.size(), 64U);
    EXPECT_EQ(featuresOf(meshes::book()).borders.size(), 9U) << "the spine is no border";
}

TEST(BorderEdges, AreThoseOfBearingTrianglesAlone)
{
    GroundMesh mesh = meshes::square(3.0);
    append(mesh, meshes::square(1.0, 2.0));
    std::fill(mesh.bears.begin() + 2, mesh.bears.end(), std::uint8_t(0));
    EXPECT_DOUBLE_EQ(borderLength(featuresOf(mesh)), 12.0);
}

TEST(BareEdges, AreBesideLevelGroundThatBearsNothing)
{
    // Four strips along z: two bear, one is bare and level, one is a bare wall.
    GroundMesh mesh =
        meshes::soup({{0, 0, 0}, {0, 0, 3}, {1, 0, 0}, {1, 0, 3}}, {{0, 1, 2}, {2, 1, 3}});
    const GroundMesh strip = mesh;
    append(mesh, meshes::moved(strip, {1, 0, 0}));
    append(mesh, meshes::moved(strip, {2, 0, 0}));
    append(mesh,
           meshes::soup({{0, 1, 0}, {0, 1, 3}, {0, 0, 0}, {0, 0, 3}}, {{0, 1, 2}, {2, 1, 3}}));
    EXPECT_TRUE(bareEdges(mesh).empty());
    for (const std::size_t bare : {4U, 5U, 6U, 7U})
        mesh.bears[bare] = 0;
    const std::vector<SurfaceFeatures::BorderEdge> edges = bareEdges(mesh);
    ASSERT_EQ(edges.size(), 1U) << "no wall, no rim";
    EXPECT_EQ(edges[0].from.x, 2.0f);
    EXPECT_EQ(edges[0].to.x, 2.0f);
    EXPECT_EQ(glm::length(edges[0].to - edges[0].from), 3.0f);
    std::fill(mesh.bears.begin(), mesh.bears.end(), std::uint8_t(0));
    EXPECT_TRUE(bareEdges(mesh).empty());
}

TEST(IslandArea, IsThatOfTheConnectedPiece)
{
    // A thousand islands in a grid, island i of side 1 + i/1000.
    std::vector<glm::dvec3> positions;
    std::vector<glm::uvec3> triangles;
    for (std::uint32_t i = 0; i < 1000; ++i) {
        const double side = 1.0 + i / 1000.0;
        const glm::dvec3 corner(3.0 * (i % 32), 0.0, 3.0 * (i / 32));
        const std::uint32_t first = 4 * i;
        for (const glm::dvec3 offset : {glm::dvec3(0.0), glm::dvec3(0, 0, side),
                                        glm::dvec3(side, 0, 0), glm::dvec3(side, 0, side)})
            positions.push_back(corner + offset);
        triangles.emplace_back(first, first + 1, first + 2);
        triangles.emplace_back(first + 2, first + 1, first + 3);
    }
    const SurfaceFeatures features = featuresOf(meshes::soup(positions, triangles));
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        const double side = 1.0 + double(t / 2) / 1000.0;
        ASSERT_NEAR(double(features.islandArea[t]), side * side, 1e-4) << "triangle " << t;
    }
    EXPECT_THAT(featuresOf(meshes::book()).islandArea, Each(FloatNear(3.0f, 1e-6f)));
}

TEST(SurfaceFeatures, OfAPartAreThoseOfTheWhole)
{
    const GroundMesh mesh = heightfield({glm::dvec2(16.0), glm::uvec2(16U)},
                                        [](double x, double) { return 0.1 * x * x; });
    const SurfaceFeatures whole = featuresOf(mesh);
    const std::vector<std::uint32_t> vertices = {7, 3, 100};
    const std::vector<std::uint32_t> triangles = {0, 31, 500};
    Aabb box;
    box.add(glm::vec3(-8.0f, 0.0f, -8.0f));
    box.add(glm::vec3(-6.0f, 9.0f, -6.0f));
    const SurfaceFeatures part = partOf(whole, vertices, triangles, box, 1.5);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(part.curvature[i], whole.curvature[vertices[i]]);
        EXPECT_EQ(part.islandArea[i], whole.islandArea[triangles[i]]);
    }
    // Of either side that meets in the corner, the four edges up to 1.5 m beyond the box.
    EXPECT_EQ(part.borders.size(), 8U);
}

TEST(ConvexCreases, AreTheEdgesOfACube)
{
    GroundMesh cube = meshes::cube(2.0);
    const std::vector<ConvexCrease> creases = convexCreases(cube);
    ASSERT_EQ(creases.size(), 12U);
    for (const ConvexCrease& crease : creases) {
        EXPECT_FLOAT_EQ(glm::length(crease.to - crease.from), 2.0f);
        EXPECT_NEAR(glm::dot(crease.normals[0], crease.normals[1]), 0.0f, 1e-6f);
        // Both normals point away from the middle of the solid.
        for (const glm::vec3& normal : crease.normals)
            EXPECT_NEAR(glm::dot(normal, 0.5f * (crease.from + crease.to)), 1.0f, 1e-6f);
    }
    EXPECT_TRUE(convexCreases(cube, {.front = false, .back = true}).empty());
    std::fill(cube.bears.begin(), cube.bears.end(), std::uint8_t(0));
    EXPECT_TRUE(convexCreases(cube).empty());
}

TEST(ConvexCreases, OfARoomLieOnItsOuterSide)
{
    GroundMesh room = meshes::cube(2.0);
    for (glm::uvec3& t : room.triangles)
        std::swap(t.y, t.z);
    for (glm::vec3& normal : room.normals)
        normal = -normal;
    EXPECT_TRUE(convexCreases(room).empty());
    const auto creases = convexCreases(room, {.front = false, .back = true});
    ASSERT_EQ(creases.size(), 12U);
    for (const ConvexCrease& crease : creases)
        EXPECT_GT(glm::dot(crease.normals[0], crease.from), 0.0f);
}

TEST(ConvexCreases, AreNotOnSmoothFlatOrBrokenGround)
{
    for (const GroundMesh& mesh : {meshes::grid(8, 4.0), meshes::hills(10.0, 16), meshes::book(),
                                   meshes::sphere(16, 1.0)})
        EXPECT_TRUE(convexCreases(mesh).empty());
    // A coarse ball whose file has one normal for each vertex is smooth in spite of its facets.
    GroundMesh cube = meshes::cube(2.0);
    for (std::size_t v = 0; v < cube.positions.size(); ++v)
        cube.normals[v] = glm::normalize(cube.positions[v]);
    EXPECT_TRUE(convexCreases(cube).empty());
}

} // namespace
} // namespace sward::terrain
