#include "bake/sample/surface_sampler.h"
#include "support/meshes.h"
#include "unit/bake/bake_settings.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace sward::bake {
namespace {

Sampling sampleOfMesh(const terrain::GroundMesh& mesh, const BakeSettings& settings)
{
    Progress progress;
    const RootFilter filter(mesh, settings, nullptr);
    return SurfaceSampler(mesh, settings, filter).sample({*settings.density}, progress);
}

// Which of the 16 congruent parts of a triangle barycentrics (b, c) lie in.
std::size_t sixteenthOf(float b, float c)
{
    const double x = 4.0 * double(b);
    const double y = 4.0 * double(c);
    const int i = std::min(static_cast<int>(x), 3);
    const int j = std::min(static_cast<int>(y), 3);
    // Row j has 2·(4 − j) − 1 parts: upright ones alternate with turned ones.
    const bool turned = (x - i) + (y - j) > 1.0;
    static constexpr int before[] = {0, 7, 12, 15};
    return static_cast<std::size_t>(before[j] + 2 * i + (turned ? 1 : 0));
}

TEST(SurfaceSampler, SpreadsRootsEvenlyOverATriangle)
{
    const Sampling sampling = sampleOfMesh(meshes::triangle(), tests::plainSettings(200'000.0));
    std::array<double, 16> counts{};
    for (const RootSample& root : sampling.roots)
        counts[sixteenthOf(root.barycentric.x, root.barycentric.y)] += 1.0;
    const double expected = double(sampling.roots.size()) / 16.0;
    double chiSquare = 0.0;
    for (const double count : counts)
        chiSquare += (count - expected) * (count - expected) / expected;
    // 15 degrees of freedom: 37.7 is passed once in a thousand.
    EXPECT_LT(chiSquare, 37.7) << "seed 0";
}

TEST(SurfaceSampler, GivesEachTriangleItsShareOfTheArea)
{
    const terrain::GroundMesh mesh = meshes::areaRatioPair();
    const Sampling sampling = sampleOfMesh(mesh, tests::plainSettings(2000.0));
    std::array<double, 2> counts{};
    for (const RootSample& root : sampling.roots)
        counts[root.triangle] += 1.0;
    // ⌊λA + u⌋ is within one of λA.
    EXPECT_NEAR(counts[0], 2000.0 * mesh.area(0), 1.0);
    EXPECT_NEAR(counts[1], 2000.0 * mesh.area(1), 1.0);
}

TEST(SurfaceSampler, IsRightInExpectationWhereATriangleBearsLessThanOneBlade)
{
    const terrain::GroundMesh mesh = meshes::sphere(64, 1.0);
    const double density = 0.2 * double(mesh.triangles.size()) / meshes::totalArea(mesh);
    double total = 0.0;
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
        BakeSettings settings = tests::plainSettings(density);
        settings.seed = seed;
        total += double(sampleOfMesh(mesh, settings).roots.size());
    }
    const double expected = 50.0 * density * meshes::totalArea(mesh);
    EXPECT_NEAR(total, expected, 5.0 * std::sqrt(expected));
}

TEST(SurfaceSampler, PutsEveryRootOnItsTriangle)
{
    const terrain::GroundMesh mesh = meshes::cube();
    for (const RootSample& root : sampleOfMesh(mesh, tests::plainSettings(2000.0)).roots) {
        const glm::uvec3 corners = mesh.triangles[root.triangle];
        const glm::dvec3 offset = glm::dvec3(root.position) - glm::dvec3(mesh.positions[corners.x]);
        ASSERT_NEAR(glm::dot(offset, mesh.faceNormal(root.triangle)), 0.0, 1e-6);
        ASSERT_GE(root.barycentric.x, 0.0f);
        ASSERT_GE(root.barycentric.y, 0.0f);
        ASSERT_LE(root.barycentric.x + root.barycentric.y, 1.0f + 1e-6f);
    }
}

TEST(SurfaceSampler, MoreDensityAddsRootsAndMovesNone)
{
    const terrain::GroundMesh mesh = meshes::cube();
    const Sampling few = sampleOfMesh(mesh, tests::plainSettings(50.0));
    const Sampling many = sampleOfMesh(mesh, tests::plainSettings(200.0));
    ASSERT_GT(many.roots.size(), few.roots.size());
    std::size_t at = 0;
    for (const RootSample& root : few.roots) {
        while (at < many.roots.size() &&
               keyBits(keyOf(mesh, many.roots[at])) != keyBits(keyOf(mesh, root)))
            ++at;
        ASSERT_LT(at, many.roots.size()) << "a root of the thin field is missing in the dense one";
        EXPECT_EQ(many.roots[at].position, root.position);
    }
}

TEST(SurfaceSampler, KeepsExactlyTheCount)
{
    const terrain::GroundMesh mesh = meshes::sphere();
    for (const std::uint64_t count : {1ULL, 17ULL, 1000ULL, 50'000ULL}) {
        BakeSettings settings = tests::plainSettings(1.0);
        settings.density.reset();
        settings.count = count;
        settings.slope = {0.0, 90.0, 0.0};
        Progress progress;
        const RootFilter filter(mesh, settings, nullptr);
        const SurfaceSampler sampler(mesh, settings, filter);
        const Sampling sampling = sampler.sample(sampler.amountFor(count, progress), progress);
        EXPECT_EQ(sampling.roots.size(), count);
        std::uint64_t rejected = 0;
        for (const std::uint64_t n : sampling.rejected)
            rejected += n;
        EXPECT_EQ(sampling.proposed, count + rejected);
        // Half of the sphere is steeper than 90°: as many are rejected as kept.
        if (count >= 1000) {
            EXPECT_NEAR(double(rejected), double(count), 5.0 * std::sqrt(2.0 * double(count)));
        }
    }
}

TEST(SurfaceSampler, CountsEveryCandidateOnce)
{
    BakeSettings settings = tests::plainSettings(5000.0);
    settings.slope = {20.0, 60.0, 10.0};
    settings.altitude = {-0.5, 0.9, 0.0};
    const Sampling sampling = sampleOfMesh(meshes::sphere(), settings);
    std::uint64_t rejected = 0;
    for (const std::uint64_t n : sampling.rejected)
        rejected += n;
    EXPECT_EQ(sampling.proposed, rejected + sampling.roots.size());
    EXPECT_GT(sampling.rejected[static_cast<std::size_t>(Reject::slope)], 0U);
    EXPECT_GT(sampling.rejected[static_cast<std::size_t>(Reject::altitude)], 0U);
}

TEST(SlopeFilter, KeepsWhatItSaysAndFadesOverItsSoftEdge)
{
    BakeSettings settings = tests::plainSettings(40'000.0);
    settings.slope = {0.0, 40.0, 20.0};
    std::array<double, 3> inside{};
    for (const RootSample& root : sampleOfMesh(meshes::sphere(128, 1.0), settings).roots) {
        const double slope = std::acos(double(root.normal.y)) * 57.29577951308232;
        ASSERT_LE(slope, 60.001);
        inside[slope <= 40.0 ? 0 : slope <= 50.0 ? 1 : 2] += 1.0;
    }
    // On a sphere the area between two slopes is proportional to the difference of their cosines;
    // on the soft edge the weight falls linearly.
    const auto cosine = [](double degrees) { return std::cos(degrees / 57.29577951308232); };
    const double full = inside[0] / (1.0 - cosine(40.0));
    EXPECT_NEAR(inside[1] / (full * (cosine(40.0) - cosine(50.0))), 0.75, 0.03);
    EXPECT_NEAR(inside[2] / (full * (cosine(50.0) - cosine(60.0))), 0.25, 0.03);
}

TEST(VertexColorMask, ThinsInProportion)
{
    terrain::GroundMesh mesh = meshes::square(2.0);
    mesh.hasColors = true;
    for (std::size_t v = 0; v < mesh.positions.size(); ++v)
        mesh.colors[v] = glm::vec4(mesh.positions[v].x > 0.0f ? 1.0f : 0.0f, 0.25f, 1.0f, 1.0f);
    BakeSettings settings = tests::plainSettings(20'000.0);
    settings.masks = {{.channel = 1}};
    EXPECT_NEAR(double(sampleOfMesh(mesh, settings).roots.size()), 20'000.0, 700.0);
    settings.masks = {{.channel = 1, .invert = true}};
    EXPECT_NEAR(double(sampleOfMesh(mesh, settings).roots.size()), 60'000.0, 700.0);
    // The red channel rises with x: the mean place moves to two thirds of the way.
    settings.masks = {{.channel = 0}};
    double sum = 0.0;
    const Sampling sampling = sampleOfMesh(mesh, settings);
    for (const RootSample& root : sampling.roots)
        sum += double(root.position.x);
    EXPECT_NEAR(sum / double(sampling.roots.size()), 1.0 / 3.0, 0.02);
}

TEST(Sides, ChooseWhereTheRootsLook)
{
    const terrain::GroundMesh mesh = meshes::square(2.0);
    BakeSettings settings = tests::plainSettings(1000.0);
    const auto ups = [&](Sides sides) {
        settings.sides = sides;
        std::pair<std::size_t, std::size_t> result{0, 0};
        for (const RootSample& root : sampleOfMesh(mesh, settings).roots)
            ++(root.normal.y > 0.0f ? result.first : result.second);
        return result;
    };
    EXPECT_EQ(ups(Sides::front).second, 0U);
    EXPECT_EQ(ups(Sides::back).first, 0U);
    const auto both = ups(Sides::both);
    EXPECT_NEAR(double(both.first), 4000.0, 3.0);
    EXPECT_NEAR(double(both.second), 4000.0, 3.0);
}

TEST(Occluders, BearNothing)
{
    terrain::GroundMesh mesh = meshes::square(2.0);
    mesh.bears[1] = 0;
    for (const RootSample& root : sampleOfMesh(mesh, tests::plainSettings(1000.0)).roots)
        ASSERT_EQ(root.triangle, 0U);
}

} // namespace
} // namespace sward::bake
