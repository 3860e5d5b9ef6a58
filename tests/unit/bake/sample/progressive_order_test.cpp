#include "bake/bake.h"
#include "bake/patches/local_ranks.h"
#include "bake/sample/progressive_order.h"
#include "shaders/shared/blade.h"
#include "support/meshes.h"
#include "unit/bake/bake_settings.h"
#include "unit/bake/sample/spread.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace sward::bake {
namespace {

field::Field bakeSpread(const terrain::GroundMesh& ground, Spread spread, std::uint64_t count)
{
    BakeSettings settings = tests::plainSettings(1.0);
    settings.density.reset();
    settings.count = count;
    settings.spread = spread;
    Diagnostics diagnostics;
    Progress progress;
    return bakeField(ground, settings, 2, diagnostics, progress).field;
}

// Roots of the blades with a rank below `share`, as the runtime draws them.
std::vector<glm::dvec3> drawn(const field::Field& field, double share)
{
    std::vector<glm::dvec3> roots;
    for (const shared::Patch& patch : field.patches)
        for (std::uint32_t i = 0; i < patch.bladeCount; ++i) {
            const double rank = double(patch.rankLow) + double(patch.rankHigh - patch.rankLow) *
                                                            (i + 0.5) / patch.bladeCount;
            if (rank < share)
                roots.emplace_back(
                    shared::unpackBlade(field.blades[patch.firstBlade + i], patch).root);
        }
    return roots;
}

TEST(ProgressiveOrder, EveryShareOfAPoissonFieldIsItselfEvenlySpread)
{
    // Across patches, levels of the tree and 32 m cells alike.
    for (const terrain::GroundMesh& ground : {meshes::square(70.0), meshes::sphere(96, 20.0)}) {
        const field::Field field = bakeSpread(ground, Spread::poisson, 60'000);
        const double area = meshes::totalArea(ground);
        for (const double share : {1.0, 1.0 / 2.0, 1.0 / 8.0, 1.0 / 64.0}) {
            const std::vector<glm::dvec3> roots = drawn(field, share);
            EXPECT_NEAR(double(roots.size()), 60'000.0 * share, 0.01 * 60'000.0 * share) << share;
            EXPECT_GE(tests::relativeRadius(roots, area), 0.55) << share;
        }
    }
}

TEST(ProgressiveOrder, AFewOfUniformRootsAreEvenlySpread)
{
    const terrain::GroundMesh ground = meshes::square(40.0);
    const field::Field field = bakeSpread(ground, Spread::uniform, 60'000);
    for (const double share : {1.0 / 8.0, 1.0 / 64.0})
        EXPECT_GE(tests::relativeRadius(drawn(field, share), meshes::totalArea(ground)), 0.55);
    // All of them are not.
    EXPECT_LT(tests::relativeRadius(drawn(field, 1.0), meshes::totalArea(ground)), 0.3);
}

TEST(ProgressiveOrder, ADrawnShareHasNoPeakAtThePitchOfThePatches)
{
    // Power of the drawn roots at wave lengths of 32, 16, 8, 4 and 2 m along the axes: a set of
    // independent points has 1 on average; blue noise has less.
    const field::Field field = bakeSpread(meshes::square(128.0), Spread::poisson, 120'000);
    for (const double share : {1.0 / 2.0, 1.0 / 8.0, 1.0 / 64.0}) {
        const std::vector<glm::dvec3> roots = drawn(field, share);
        for (const double wave : {32.0, 16.0, 8.0, 4.0, 2.0})
            for (const glm::length_t axis : {0, 2}) {
                double sine = 0.0;
                double cosine = 0.0;
                for (const glm::dvec3& root : roots) {
                    const double angle = 6.283185307179586 * root[axis] / wave;
                    sine += std::sin(angle);
                    cosine += std::cos(angle);
                }
                const double power = (sine * sine + cosine * cosine) / double(roots.size());
                EXPECT_LT(power, 4.0) << "share " << share << ", wave " << wave;
            }
    }
}

TEST(ProgressiveOrder, TakesPointsInOnePlaceAndNone)
{
    EXPECT_TRUE(progressiveOrder({}, {}, evenPoissonShare).empty());
    Roots roots(300);
    for (std::uint32_t i = 0; i < 300; ++i)
        roots[i] = {i, 0, {}, glm::vec3(5.0f), glm::vec3(0.0f, 1.0f, 0.0f)};
    const std::vector<std::uint64_t> order = progressiveOrder({}, roots, evenPoissonShare);
    EXPECT_EQ(std::set<std::uint64_t>(order.begin(), order.end()).size(), 300U);
}

} // namespace
} // namespace sward::bake
