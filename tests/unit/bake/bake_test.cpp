#include "bake/bake.h"
#include "core/error.h"
#include "field/verify.h"
#include "support/meshes.h"
#include "unit/bake/bake_settings.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace sward::bake {
namespace {

BakeResult bake(const terrain::GroundMesh& mesh, const BakeSettings& settings, int threads = 2)
{
    Diagnostics diagnostics;
    Progress progress;
    return bakeField(mesh, settings, threads, diagnostics, progress);
}

template <typename T>
bool sameBytes(const T& a, const T& b)
{
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])) == 0;
}

TEST(Bake, GivesTheSameBytesForAnyNumberOfThreads)
{
    const terrain::GroundMesh mesh = meshes::boxAbovePlane();
    BakeSettings settings = tests::plainSettings(400.0);
    settings.exposureRays = 8;
    settings.clearance = 0.5;
    settings.meadow.clumpSize = 0.5;
    const field::Field one = bake(mesh, settings, 1).field;
    EXPECT_GT(one.blades.size(), 20'000U);
    for (const int threads : {2, 7}) {
        const field::Field other = bake(mesh, settings, threads).field;
        EXPECT_TRUE(sameBytes(one.blades, other.blades)) << threads;
        EXPECT_TRUE(sameBytes(one.keys, other.keys)) << threads;
        EXPECT_TRUE(sameBytes(one.patches, other.patches)) << threads;
        EXPECT_EQ(one.provenance, other.provenance);
    }
}

TEST(Bake, YieldsAFieldThatPassesVerification)
{
    const field::Field field = bake(meshes::cube(), tests::plainSettings(3000.0)).field;
    EXPECT_NO_THROW(field::verify(field::viewOf(field), "field"));
}

TEST(Bake, StandsBladesAlongTheNormalOfASphere)
{
    const field::Field field = bake(meshes::sphere(128, 5.0), tests::plainSettings(100.0)).field;
    double largest = 0.0;
    for (const shared::Patch& patch : field.patches)
        for (std::uint32_t i = 0; i < patch.bladeCount; ++i) {
            const shared::Blade blade =
                shared::unpackBlade(field.blades[patch.firstBlade + i], patch);
            const glm::dvec3 radial = glm::normalize(glm::dvec3(blade.root));
            largest =
                std::max(largest, std::acos(std::min(glm::dot(radial, glm::dvec3(blade.up)), 1.0)));
        }
    // Error of packing and of the interpolated normal of a 128-sided sphere.
    EXPECT_LE(largest, double(shared::octahedralMaxError) + 1e-3);
}

TEST(Bake, KeepsRootsOnTheSurfaceAfterPackingFarFromTheWorldsOrigin)
{
    const glm::dvec3 far(1e6, -2e5, 3.3e6);
    const terrain::GroundMesh mesh = meshes::moved(meshes::square(30.0, 0.0), far);
    const field::Field field = bake(mesh, tests::plainSettings(20.0)).field;
    for (const shared::Patch& patch : field.patches) {
        const double bound = std::max(0.0005, 65535.0 * double(patch.rootStep) / 65535.0);
        for (std::uint32_t i = 0; i < patch.bladeCount; ++i) {
            const shared::Blade blade =
                shared::unpackBlade(field.blades[patch.firstBlade + i], patch);
            const glm::dvec3 world = field.origin + glm::dvec3(blade.root);
            ASSERT_NEAR(world.y, far.y, bound);
            ASSERT_LE(std::abs(world.x - far.x), 15.0 + bound);
            ASSERT_LE(std::abs(world.z - far.z), 15.0 + bound);
        }
    }
}

TEST(Bake, NeedsFreeRoomWhereClearanceIsAskedFor)
{
    BakeSettings settings = tests::plainSettings(300.0);
    settings.clearance = 2.0;
    const BakeResult result = bake(meshes::boxAbovePlane(), settings);
    EXPECT_GT(result.report.rejected[static_cast<std::size_t>(Reject::clearance)], 500U);
    for (const shared::Patch& patch : result.field.patches)
        for (std::uint32_t i = 0; i < patch.bladeCount; ++i) {
            const shared::Blade blade =
                shared::unpackBlade(result.field.blades[patch.firstBlade + i], patch);
            if (blade.root.y < 0.5f) {
                ASSERT_GT(std::max(std::abs(blade.root.x), std::abs(blade.root.z)), 0.999f)
                    << "a root under the box";
            }
        }
}

TEST(Exposure, IsFullInTheOpenAndLowUnderARoof)
{
    BakeSettings settings = tests::plainSettings(50.0);
    settings.exposureRays = 32;
    const field::Field field = bake(meshes::boxAbovePlane(), settings).field;
    for (const shared::Patch& patch : field.patches)
        for (std::uint32_t i = 0; i < patch.bladeCount; ++i) {
            const shared::Blade blade =
                shared::unpackBlade(field.blades[patch.firstBlade + i], patch);
            if (blade.root.y > 0.5f)
                continue;
            const float fromMiddle = glm::length(glm::vec2(blade.root.x, blade.root.z));
            if (fromMiddle < 0.3f) {
                ASSERT_LT(blade.exposure, 0.65f);
            }
            if (fromMiddle > 4.5f) {
                ASSERT_GT(blade.exposure, 0.9f);
            }
        }
}

TEST(Bake, SaysWhyNothingGrows)
{
    BakeSettings settings = tests::plainSettings(100.0);
    settings.slope = {80.0, 90.0, 0.0};
    Diagnostics diagnostics;
    Progress progress;
    const BakeResult result = bakeField(meshes::square(4.0), settings, 1, diagnostics, progress);
    EXPECT_EQ(result.report.kept, 0U);
    EXPECT_TRUE(result.field.blades.empty());
    ASSERT_FALSE(diagnostics.warnings().empty());
    EXPECT_NE(diagnostics.warnings()[0].find("slope 1600"), std::string::npos)
        << diagnostics.warnings()[0];
    EXPECT_NO_THROW(field::verify(field::viewOf(result.field), "field"));
}

TEST(Bake, StopsWhenCancelled)
{
    Diagnostics diagnostics;
    Progress progress;
    progress.cancel();
    try {
        bakeField(meshes::square(4.0), tests::plainSettings(100.0), 1, diagnostics, progress);
        FAIL() << "went on";
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::interrupted);
    }
}

TEST(EstimateBake, IsWithinFivePerCentOfTheBake)
{
    BakeSettings settings = tests::plainSettings(60'000.0);
    settings.slope = {0.0, 70.0, 10.0};
    Diagnostics diagnostics;
    Progress progress;
    const terrain::GroundMesh mesh = meshes::sphere(64, 1.0);
    const Report estimate = estimateBake(mesh, settings, 2, diagnostics, progress);
    const BakeResult result = bake(mesh, settings);
    EXPECT_NEAR(double(estimate.kept), double(result.report.kept),
                0.05 * double(result.report.kept));
    EXPECT_GT(result.report.kept, 200'000U);
}

} // namespace
} // namespace sward::bake
