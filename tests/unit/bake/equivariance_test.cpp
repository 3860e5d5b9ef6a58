#include "bake/bake.h"
#include "field/inspect.h"
#include "support/meshes.h"
#include "unit/bake/bake_settings.h"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <gtest/gtest.h>

namespace sward::bake {
namespace {

field::Field grow(const terrain::GroundMesh& mesh)
{
    BakeSettings settings = tests::plainSettings(2000.0);
    settings.meadow.clumpSize = 0.4;
    settings.exposureRays = 4;
    Diagnostics diagnostics;
    Progress progress;
    return bakeField(mesh, settings, 2, diagnostics, progress).field;
}

class Equivariance : public testing::TestWithParam<glm::dvec3> {};

TEST_P(Equivariance, ATurnedMeshBakesToTheTurnedField)
{
    const glm::dvec3 angles = GetParam();
    const glm::dquat turn(angles);
    for (const terrain::GroundMesh& mesh :
         {meshes::sphere(48, 1.0), meshes::cube(1.5), meshes::moebius()}) {
        const field::Field still = grow(mesh);
        const field::Field turned = grow(meshes::rotated(mesh, turn));
        const field::Comparison result =
            field::compare(field::viewOf(still), field::viewOf(turned), glm::mat4_cast(turn),
                           field::Match::id, 1e-3);
        EXPECT_TRUE(result.reasons.empty()) << (result.reasons.empty() ? "" : result.reasons[0]);
        EXPECT_GT(result.matched, 5000U);
    }
}

INSTANTIATE_TEST_SUITE_P(Turns, Equivariance,
                         testing::Values(glm::dvec3(0.3, 0.0, 0.0), glm::dvec3(1.1, -0.7, 2.9),
                                         glm::dvec3(0.0, 1.5707963267948966, 0.0)));

} // namespace
} // namespace sward::bake
