// Which ground is a heightfield in all but name.

#include "bake/filter/default_slope.h"
#include "support/meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace sward::bake {
namespace {

const GroundUp upward{};

/// A ground of triangles that share no corner.
terrain::GroundMesh soupOf(const std::vector<glm::dvec3>& corners)
{
    std::vector<glm::uvec3> triangles;
    for (std::uint32_t i = 0; i < corners.size(); i += 3)
        triangles.emplace_back(i, i + 1, i + 2);
    return meshes::soup(corners, triangles);
}

/// Level squares of `side` [m]: their middles, as a soup.
terrain::GroundMesh squares(const std::vector<glm::dvec3>& middles, double side)
{
    std::vector<glm::dvec3> corners;
    const double h = 0.5 * side;
    for (const glm::dvec3& m : middles)
        for (const glm::dvec3& corner :
             {glm::dvec3(-h, 0, -h), glm::dvec3(-h, 0, h), glm::dvec3(h, 0, h),
              glm::dvec3(-h, 0, -h), glm::dvec3(h, 0, h), glm::dvec3(h, 0, -h)})
            corners.push_back(m + corner);
    return soupOf(corners);
}

/// A row of 100 squares of 1 m, and a roof over the first `roofs` of them, sorted by `roofsFirst`.
terrain::GroundMesh row(int roofs, bool roofsFirst)
{
    std::vector<glm::dvec3> middles;
    for (int i = 0; i < 100; ++i)
        middles.emplace_back(i, 0.0, 0.0);
    for (int i = 0; i < roofs; ++i)
        middles.emplace_back(i, 3.0, 0.0);
    if (roofsFirst)
        std::rotate(middles.begin(), middles.begin() + 100, middles.end());
    return squares(middles, 1.0);
}

TEST(DefaultSlope, HeightfieldsAreOneLayerSeenFromAbove)
{
    EXPECT_TRUE(isHeightfield(meshes::square(), upward));
    EXPECT_TRUE(isHeightfield(meshes::hills(100.0, 40), upward));
    std::vector<glm::dvec3> islands;
    for (int i = 0; i < 30; ++i)
        islands.emplace_back(7.0 * (i % 6), 0.3 * i, 7.0 * (i / 6));
    EXPECT_TRUE(isHeightfield(squares(islands, 5.0), upward));

    EXPECT_FALSE(isHeightfield(meshes::sphere(), upward));
    EXPECT_FALSE(isHeightfield(meshes::cube(), upward));
    EXPECT_FALSE(isHeightfield(meshes::moebius(), upward));
    EXPECT_FALSE(isHeightfield(meshes::book(), upward));
    EXPECT_FALSE(isHeightfield(terrain::GroundMesh{}, upward));
}

TEST(DefaultSlope, AFiftiethOfTheGroundMayLieBelowAnother)
{
    for (const bool roofsFirst : {false, true}) {
        EXPECT_TRUE(isHeightfield(row(1, roofsFirst), upward)) << roofsFirst;
        EXPECT_FALSE(isHeightfield(row(4, roofsFirst), upward)) << roofsFirst;
    }
}

TEST(DefaultSlope, AFanOfSliversIsOneLayer)
{
    std::vector<glm::dvec3> corners;
    constexpr int slivers = 20'000;
    const auto rim = [](int i) {
        const double angle = 2.0 * std::numbers::pi * i / slivers;
        return glm::dvec3(std::cos(angle), 0.0, -std::sin(angle));
    };
    for (int i = 0; i < slivers; ++i)
        for (const glm::dvec3& corner : {glm::dvec3(0.0), rim(i), rim(i + 1)})
            corners.push_back(corner);
    EXPECT_TRUE(isHeightfield(soupOf(corners), upward));
}

TEST(DefaultSlope, TurnsWithGroundUp)
{
    terrain::GroundMesh ground = meshes::hills(100.0, 40);
    for (auto& p : ground.positions)
        p = {p.x, -p.z, p.y}; // y-up to z-up
    GroundUp up;
    up.direction = {0.0, 0.0, 1.0};
    EXPECT_TRUE(isHeightfield(ground, up));
    EXPECT_FALSE(isHeightfield(ground, upward));
    up.direction = {0.0, 0.0, -1.0};
    EXPECT_FALSE(isHeightfield(ground, up));
    up.radial = true;
    EXPECT_FALSE(isHeightfield(ground, up));
}

TEST(DefaultSlope, LeavesOnlyCliffsOfHeightfieldsBare)
{
    const SoftRange cliffs = defaultSlope(meshes::hills(100.0, 40), upward);
    EXPECT_EQ(cliffs.weight(44.9), 1.0);
    EXPECT_GT(cliffs.weight(52.0), 0.0);
    EXPECT_LT(cliffs.weight(52.0), 1.0);
    EXPECT_EQ(cliffs.weight(60.1), 0.0);
    EXPECT_EQ(defaultSlope(meshes::sphere(), upward).weight(180.0), 1.0);
}

} // namespace
} // namespace sward::bake
