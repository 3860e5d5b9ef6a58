// Growth beside the convex edges of solids: blades fan out over them.
#include "bake/bake.h"
#include "bake/filter/crease_blend.h"
#include "field/field.h"
#include "field/measure/leaf_area.h"
#include "support/meshes.h"
#include "unit/bake/bake_settings.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

namespace sward::bake {
namespace {

constexpr double half = 1.0; // [m] of a side of the cube
constexpr double reach = 0.5;

BakeSettings creaseSettings(double blend)
{
    BakeSettings settings = tests::plainSettings(3000.0);
    settings.meadow.species[0].height = {0.3, reach};
    settings.meadow.edges.creaseBlend = blend;
    return settings;
}

field::Field growBeside(const terrain::GroundMesh& ground, double blend = 1.0,
                        Sides sides = Sides::front)
{
    BakeSettings settings = creaseSettings(blend);
    settings.sides = sides;
    Diagnostics diagnostics;
    Progress progress;
    return bakeField(ground, settings, 2, diagnostics, progress).field;
}

terrain::GroundMesh insideOut(terrain::GroundMesh mesh)
{
    for (glm::uvec3& t : mesh.triangles)
        std::swap(t.y, t.z);
    for (glm::vec3& normal : mesh.normals)
        normal = -normal;
    return mesh;
}

// Calls visit(up, distance, beyond) for blades on the top of a cube that are nearer to its edge
// towards +x than to others by twice the reach: `beyond` is that direction.
template <typename Visit>
void forTopBlades(const field::Field& field, const Visit& visit)
{
    std::size_t count = 0;
    for (const shared::Patch& patch : field.patches)
        for (std::uint32_t i = 0; i < patch.bladeCount; ++i) {
            const shared::Blade blade =
                shared::unpackBlade(field.blades[patch.firstBlade + i], patch);
            const glm::dvec3 root(blade.root);
            if (root.y < half - 1e-3 || std::abs(root.z) > half - reach || root.x < 0.0 ||
                half - root.x < 1e-3)
                continue;
            visit(glm::dvec3(blade.up), half - root.x);
            ++count;
        }
    EXPECT_GT(count, 1000U);
}

bool haveSameBlades(const field::Field& a, const field::Field& b)
{
    return a.blades.size() == b.blades.size() &&
           std::memcmp(a.blades.data(), b.blades.data(),
                       a.blades.size() * sizeof(shared::PackedBlade)) == 0;
}

double degreesBetween(glm::dvec3 a, glm::dvec3 b)
{
    return std::acos(std::clamp(glm::dot(a, b), -1.0, 1.0)) * 57.29577951308232;
}

TEST(CreaseBlend, TurnsBladesToTheBisectorAtAnEdgeAndLeavesThoseBeyondABladesLength)
{
    const glm::dvec3 top(0, 1, 0);
    const glm::dvec3 bisector = glm::normalize(glm::dvec3(1, 1, 0));
    // The packed direction is within 0.64°.
    forTopBlades(growBeside(meshes::cube(2.0 * half)), [&](glm::dvec3 up, double distance) {
        if (distance < 0.01 * reach) {
            EXPECT_LT(degreesBetween(up, bisector), 2.0);
        }
        if (distance > reach) {
            EXPECT_EQ(up, top);
        }
        const double nearness = std::max(1.0 - distance / reach, 0.0);
        const double wanted = std::atan(nearness * nearness) * 57.29577951308232;
        EXPECT_NEAR(degreesBetween(up, top), wanted, 0.7) << distance;
        EXPECT_NEAR(up.z, 0.0, 0.02);
    });
}

TEST(CreaseBlend, MeetsOnTheDiagonalOfACorner)
{
    const terrain::GroundMesh cube = meshes::cube(2.0 * half);
    const auto creases = terrain::convexCreases(cube);
    const CreaseBlend blend(creases, reach, 1.0);
    const glm::dvec3 diagonal = glm::normalize(glm::dvec3(1.0));
    for (const glm::vec3 normal : {glm::vec3(1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0, 0, 1)}) {
        RootSample root{};
        root.position = glm::vec3(float(half)) - 1e-3f * (glm::vec3(1.0f) - normal);
        root.normal = normal;
        EXPECT_LT(degreesBetween(blend.normalAt(root), diagonal), 1.0);
    }
}

TEST(CreaseBlend, LeavesConcaveEdgesAndStepsBelowAlone)
{
    // In the corner of a room blades do not lean into the wall.
    const terrain::GroundMesh room = insideOut(meshes::cube(2.0 * half));
    EXPECT_TRUE(haveSameBlades(growBeside(room), growBeside(room, 0.0)));
    // From the other side the same walls are a solid.
    EXPECT_FALSE(haveSameBlades(growBeside(room, 1.0, Sides::back),
                                growBeside(room, 0.0, Sides::back)));
    // A lower tread, in front of the riser below an edge.
    const auto creases = terrain::convexCreases(meshes::cube(2.0 * half));
    const CreaseBlend blend(creases, reach, 1.0);
    RootSample root{};
    root.position = {half + 0.1, half - 0.2, 0.0};
    root.normal = {0, 1, 0};
    EXPECT_EQ(blend.normalAt(root), glm::dvec3(0, 1, 0));
}

TEST(CreaseBlend, ChangesNoByteOnFlatAndSmoothGround)
{
    for (const terrain::GroundMesh& ground :
         {meshes::grid(4, 2.0), meshes::hills(4.0, 32), meshes::sphere(32, 1.0),
          meshes::moved(meshes::sphere(48, 3.0), {64.0, 0.0, 0.0})})
        EXPECT_TRUE(haveSameBlades(growBeside(ground), growBeside(ground, 0.0)));
}

TEST(CreaseBlend, IsTheSameOnThinWallsOfBothSides)
{
    // On the top of a wall that is thinner than the reach both edges pull: in its middle they cancel.
    terrain::GroundMesh wall = meshes::cube(2.0);
    for (glm::vec3& position : wall.positions)
        position.x *= 0.1f;
    const auto creases = terrain::convexCreases(wall);
    const CreaseBlend blend(creases, reach, 1.0);
    const auto turned = [&](float x) {
        RootSample root{};
        root.position = {x, 1.0f, 0.0f};
        root.normal = {0, 1, 0};
        return blend.normalAt(root);
    };
    EXPECT_NEAR(turned(0.0f).x, 0.0, 1e-6);
    for (const float x : {0.02f, 0.05f, 0.09f}) {
        EXPECT_NEAR(turned(x).x, -turned(-x).x, 1e-6);
        EXPECT_GT(turned(x).x, 0.0);
    }
}

TEST(CreaseBlend, ThinsLeavesOverAConvexEdgeOnly)
{
    const field::Field solid = growBeside(meshes::cube(2.0 * half));
    const field::Field hollow = growBeside(insideOut(meshes::cube(2.0 * half)));
    const auto share = [](const field::Field& field) {
        const field::LeafAreaGrid grid = field::leafAreaOf(field::viewOf(field));
        double face = 0.0;
        double edge = 0.0;
        for (int i = -4; i <= 4; ++i) {
            const float z = 0.1f * float(i);
            face += double(shared::leafAreaAt(grid.view(), {0.0f, float(half), z}));
            edge += double(shared::leafAreaAt(grid.view(), {float(half), float(half), z}));
        }
        return edge / face;
    };
    EXPECT_LT(share(solid), 0.65);
    EXPECT_NEAR(share(hollow), 1.0, 0.15);
}

} // namespace
} // namespace sward::bake
