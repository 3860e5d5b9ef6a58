#include "bake/filter/exposure.h"
#include "support/meshes.h"
#include "unit/bake/bake_settings.h"
#include "unit/bake/sample/place_trial.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace sward::bake {
namespace {

TEST(Exposure, IsTheCosineWeightedShareOfTheSky)
{
    // An infinite wall hides half of the sky of roots on either side.
    terrain::GroundMesh ground = meshes::square(2.0);
    terrain::GroundMesh wall = meshes::soup(
        {{-50, -50, 0}, {50, -50, 0}, {-50, 50, 0}, {50, 50, 0}}, {{0, 1, 2}, {2, 1, 3}});
    std::fill(wall.bears.begin(), wall.bears.end(), std::uint8_t(0));
    append(ground, wall);
    BakeSettings settings = tests::plainSettings(1.0);
    settings.exposureRays = 64;
    const terrain::SurfaceQuery query(ground);
    const Exposure exposure(ground, settings, 100.0, query);
    for (const RootSample& root : tests::evenRoots(ground, 30.0)) {
        if (std::fabs(root.position.z) > 0.02f) {
            ASSERT_NEAR(exposure.at(root), 0.5, 0.09);
        }
    }
}

TEST(Exposure, IsFullInTheOpenAndOnAConvexGround)
{
    BakeSettings settings = tests::plainSettings(1.0);
    settings.exposureRays = 16;
    for (const terrain::GroundMesh& mesh :
         {meshes::square(10.0), meshes::cube(), meshes::sphere(128, 3.0)}) {
        const terrain::SurfaceQuery query(mesh);
        const Exposure exposure(mesh, settings, 8.0, query);
        double sum = 0.0;
        const std::vector<RootSample> roots = tests::evenRoots(mesh, 20.0);
        for (const RootSample& root : roots)
            sum += exposure.at(root);
        EXPECT_GT(sum / double(roots.size()), 0.995);
    }
}

TEST(Exposure, LooksNoFartherThanItsRays)
{
    terrain::GroundMesh mesh = meshes::square(4.0);
    terrain::GroundMesh roof = meshes::square(40.0, 3.0);
    std::fill(roof.bears.begin(), roof.bears.end(), std::uint8_t(0));
    append(mesh, roof);
    BakeSettings settings = tests::plainSettings(1.0);
    settings.exposureRays = 200;
    const terrain::SurfaceQuery query(mesh);
    // Under a wide roof 3 m up, rays of r metres miss it at cosines below 3/r: a share of cos².
    for (const auto& [length, share] : {std::pair(2.9, 1.0), std::pair(6.0, 0.25)}) {
        const Exposure exposure(mesh, settings, length, query);
        for (const RootSample& root : tests::evenRoots(mesh, 2.0))
            ASSERT_NEAR(exposure.at(root), share, 0.02);
    }
}

} // namespace
} // namespace sward::bake
