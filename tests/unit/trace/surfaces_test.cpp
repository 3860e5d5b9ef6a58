#include "field/measure/leaf_area.h"
#include "shaders/shared/look/blade_colors.h"
#include "support/fields/fields.h"
#include "trace/ray_scene.h"
#include "trace/surfaces.h"
#include "unit/field/sample_field.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace sward::trace {
namespace {

Surfaces surfacesAtRest(const field::Field& meadow)
{
    const field::FieldView view = field::viewOf(meadow);
    return surfacesOf(view, field::restingPoses(view), {});
}

// [m²] of all blades, one side.
double areaOf(const Surfaces& surfaces)
{
    double area = 0.0;
    for (const glm::uvec4& quad : surfaces.quads) {
        const glm::vec3 a = surfaces.points[quad.z] - surfaces.points[quad.x];
        const glm::vec3 b = surfaces.points[quad.w] - surfaces.points[quad.y];
        area += 0.5 * double(glm::length(glm::cross(a, b)));
    }
    return area;
}

TEST(Surfaces, HaveAStripForEachBladeInTheColoursOfTheRenderer)
{
    const field::Field meadow = test::makeField({.blades = 300});
    const field::FieldView view = field::viewOf(meadow);
    const Surfaces surfaces = surfacesAtRest(meadow);
    ASSERT_EQ(surfaces.strips.size(), meadow.blades.size());
    field::LeafAreaGrid grid = field::leafAreaOf(view);
    field::describeUndergrowth(view, grid.shape);
    grid.shape.thatch = 1.0f;
    const shared::Cover cover = grid.view();
    std::set<std::uint32_t> blades;
    for (const Surfaces::Strip& strip : surfaces.strips) {
        blades.insert(strip.blade);
        const auto cell =
            std::find_if(meadow.patches.begin(), meadow.patches.end(), [&](const shared::Patch& p) {
                return strip.blade >= p.firstBlade && strip.blade < p.firstBlade + p.bladeCount;
            });
        const shared::Blade blade = shared::unpackBlade(meadow.blades[strip.blade], *cell);
        const shared::BladeColors colors = shared::bladeColors(
            cover, blade, meadow.species[0].look, shared::leafAreaAt(cover, blade.root));
        EXPECT_EQ(strip.root, colors.root);
        EXPECT_EQ(strip.tip, colors.tip);
        EXPECT_EQ(strip.translucency, meadow.species[0].look.translucency);
        // A place between two veins, at the middle of the blade.
        const glm::vec2 place(0.4f, 0.5f);
        const glm::vec3 wanted =
            glm::mix(colors.root, colors.tip, shared::tipShareAt(0.5f)) *
            shared::toneAlong(shared::finishGrass, 0.5f, blade.seed) *
            shared::veinsAt(shared::finishGrass, place, 255.0f, blade.seed).tone;
        EXPECT_LT(glm::length(leafAt(strip, place).reflection - wanted), 1e-5f);
    }
    EXPECT_EQ(blades.size(), meadow.blades.size());
}

TEST(Surfaces, StripsHaveTheAreaOfTheirOutlines)
{
    field::Field meadow = test::makeField({.blades = 50});
    for (std::uint32_t shape = 0; shape < shared::shapeCount; ++shape) {
        shared::Species& look = meadow.species[0].look;
        look.shape = shape;
        look.fold = 0.0f;
        const Surfaces surfaces = surfacesAtRest(meadow);
        double wanted = 0.0;
        for (const shared::Patch& cell : meadow.patches)
            for (std::uint32_t i = 0; i < cell.bladeCount; ++i) {
                const shared::Blade blade =
                    shared::unpackBlade(meadow.blades[cell.firstBlade + i], cell);
                wanted += double(blade.height * blade.width *
                                 shared::outlineArea(look.shape, look.tipThreshold));
            }
        // The parameter of a curve is not its length: the halves of a bent blade differ.
        EXPECT_NEAR(areaOf(surfaces) / wanted, 1.0, 0.08) << shape;
    }
}

TEST(Surfaces, FarBladesHaveFewerQuadsAndTheSameArea)
{
    const field::Field meadow = test::makeField({.blades = 200});
    const field::FieldView view = field::viewOf(meadow);
    const std::vector<field::BladePose> poses = field::restingPoses(view);
    const auto seenFrom = [&](float distance) {
        return surfacesOf(view, poses,
                          {.seen = Seen{.eye = {0.0f, distance, 0.0f}, .pixel = 0.001f}});
    };
    const Surfaces whole = surfacesOf(view, poses, {});
    const Surfaces near = seenFrom(0.0f);
    const Surfaces far = seenFrom(300.0f);
    EXPECT_EQ(near.quads.size(), whole.quads.size());
    EXPECT_LT(2 * far.quads.size(), whole.quads.size());
    EXPECT_NEAR(areaOf(far) / areaOf(whole), 1.0, 0.03);
    EXPECT_EQ(groundOf(view).groundTriangles.size(), whole.groundTriangles.size());
}

TEST(Surfaces, RayAcrossABladeFindsItsPlace)
{
    const field::Field meadow = test::makeField({.blades = 60, .hasGround = false});
    const std::vector<field::BladePose> poses = field::restingPoses(field::viewOf(meadow));
    Surfaces made = surfacesOf(field::viewOf(meadow), poses, {});
    const RayScene scene(std::move(made));
    int found = 0;
    for (std::size_t blade = 0; blade < poses.size(); ++blade) {
        const field::BladePose& pose = poses[blade];
        const glm::vec3 place = shared::bezierPoint(pose.v0, pose.v1, pose.v2, 0.4f);
        const glm::vec3 tangent =
            glm::normalize(shared::bezierTangent(pose.v0, pose.v1, pose.v2, 0.4f));
        const glm::vec3 normal = glm::cross(tangent, pose.axis);
        RayHit hit;
        if (!scene.meets(place + 0.01f * normal, -normal, hit) ||
            scene.surfaces().strips[hit.strip].blade != blade)
            continue; // another blade is between
        ++found;
        EXPECT_NEAR(hit.along, 0.4f, 0.02f);
        EXPECT_NEAR(hit.across, 0.0f, 0.05f);
        EXPECT_NEAR(glm::length(hit.position - place), 0.0f, 2e-3f);
        EXPECT_GT(glm::dot(hit.normal, normal), 0.95f);
    }
    EXPECT_GT(found, 50);
}

TEST(Surfaces, GroundHasTheColoursOfItsMaterialImageAndVertices)
{
    field::Field meadow = tests::sampleField(0);
    meadow.patches.clear();
    meadow.blades.clear();
    meadow.keys.clear();
    meadow.ground.images[0].rgba = {255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 0, 0, 0, 255};
    meadow.ground.materials[0].baseColor = glm::vec4(0.5f, 0.5f, 0.5f, 1.0f);
    const Surfaces surfaces = surfacesAtRest(meadow);
    // The second corner, uv (8, 0): midway between all four texels; images repeat.
    const glm::vec3 corner = groundAlbedo(surfaces, 0, {0.0f, 0.0f, 1.0f});
    EXPECT_NEAR(corner.x, 0.125f, 1e-5f);
    EXPECT_NEAR(corner.z, 0.125f, 1e-5f);
    // uv (2.75, 2.25): the texel of the upper right.
    const float x = 2.75f / 8.0f;
    const float z = 2.25f / 8.0f;
    const glm::vec3 texel = groundAlbedo(surfaces, 0, {1.0f - x, z, x - z});
    EXPECT_NEAR(texel.y, 0.5f, 1e-4f);
    EXPECT_NEAR(texel.x + texel.z, 0.0f, 1e-4f);
}

} // namespace
} // namespace sward::trace
