#include "support/meshes.h"
#include "terrain/loading/plausibility.h"
#include "terrain/procedural/landforms.h"
#include "terrain/procedural/primitives.h"

#include <glm/gtc/quaternion.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sward::terrain {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::vector<std::string> warningsOf(const GroundMesh& ground, bool hasUnits,
                                    const ImportSettings& settings = {})
{
    Diagnostics diagnostics;
    warnOfImplausible(ground, settings, hasUnits, "file", diagnostics);
    return diagnostics.warnings();
}

GroundMesh scaled(GroundMesh mesh, float factor)
{
    for (glm::vec3& position : mesh.positions)
        position *= factor;
    return mesh;
}

GroundMesh hills()
{
    return makeHills({.grid = {.extent = {40.0, 40.0}, .cells = {40, 40}}, .height = 4.0});
}

// As a program with Z up would write it.
GroundMesh zUp(const GroundMesh& mesh)
{
    return meshes::rotated(mesh, glm::angleAxis(glm::radians(90.0), glm::dvec3(1, 0, 0)));
}

TEST(Plausibility, SaysNothingOfGroundThatLiesRight)
{
    for (const bool hasUnits : {false, true}) {
        EXPECT_THAT(warningsOf(hills(), hasUnits), IsEmpty());
        EXPECT_THAT(warningsOf(makeSphere(), hasUnits), IsEmpty());
        EXPECT_THAT(warningsOf(makeTorus(), hasUnits), IsEmpty());
        EXPECT_THAT(warningsOf(makeArch(), hasUnits), IsEmpty());
        EXPECT_THAT(warningsOf(meshes::cube(), hasUnits), IsEmpty());
        EXPECT_THAT(warningsOf(meshes::moebius(), hasUnits), IsEmpty());
        EXPECT_THAT(warningsOf(meshes::boxAbovePlane(), hasUnits), IsEmpty());
        // A kilometre of two triangles, and a county in fine ones.
        EXPECT_THAT(warningsOf(meshes::square(5000.0), hasUnits), IsEmpty());
        EXPECT_THAT(warningsOf(scaled(makeHills(), 20.0f), hasUnits), IsEmpty());
    }
}

TEST(Plausibility, NamesTheAxisThatGroundLooksAlong)
{
    for (const bool hasUnits : {false, true})
        EXPECT_THAT(warningsOf(zUp(hills()), hasUnits), ElementsAre(HasSubstr("--up-axis z")));
    const GroundMesh down =
        meshes::rotated(hills(), glm::angleAxis(glm::radians(-90.0), glm::dvec3(1, 0, 0)));
    EXPECT_THAT(warningsOf(down, false), ElementsAre(HasSubstr("--up-axis -z")));
    const GroundMesh aside =
        meshes::rotated(hills(), glm::angleAxis(glm::radians(-90.0), glm::dvec3(0, 0, 1)));
    EXPECT_THAT(warningsOf(aside, false), ElementsAre(HasSubstr("--up-axis x")));
}

TEST(Plausibility, TrustsAnAxisAndUnitsThatAreGiven)
{
    EXPECT_THAT(warningsOf(zUp(hills()), false, {.upAxis = "-z"}), IsEmpty());
    EXPECT_THAT(warningsOf(scaled(hills(), 1000.0f), false, {.units = "ft"}), IsEmpty());
    EXPECT_THAT(warningsOf(scaled(hills(), 1000.0f), false, {.scale = 2.0}), IsEmpty());
}

TEST(Plausibility, LooksOnlyAtWhatBears)
{
    GroundMesh mesh = zUp(hills());
    for (std::uint8_t& bears : mesh.bears)
        bears = 0;
    EXPECT_THAT(warningsOf(mesh, false), IsEmpty());
}

TEST(Plausibility, SuspectsCentimetresAndMillimetres)
{
    EXPECT_THAT(warningsOf(scaled(hills(), 100.0f), false), ElementsAre(HasSubstr("--units cm")));
    EXPECT_THAT(warningsOf(scaled(hills(), 1e3f), false), ElementsAre(HasSubstr("--units cm")));
    EXPECT_THAT(warningsOf(scaled(hills(), 1e5f), false), ElementsAre(HasSubstr("--units mm")));
    // glTF is in metres: warn only of extreme sizes.
    EXPECT_THAT(warningsOf(scaled(hills(), 100.0f), true), IsEmpty());
    EXPECT_THAT(warningsOf(scaled(hills(), 1e3f), true), IsEmpty());
    EXPECT_THAT(warningsOf(scaled(hills(), 1e4f), true), ElementsAre(HasSubstr("--units cm")));
}

} // namespace
} // namespace sward::terrain
