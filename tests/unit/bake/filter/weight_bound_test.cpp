#include "bake/bake.h"
#include "bake/filter/root_filter.h"
#include "bake/filter/weight_bound.h"
#include "bake/sample/triangle_points.h"
#include "core/random.h"
#include "support/meshes.h"
#include "unit/bake/bake_settings.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

namespace sward::bake {
namespace {

constexpr std::uint64_t seed = 20'261'128;

struct BoundCase {
    std::string name;
    terrain::GroundMesh ground;
    BakeSettings settings;
};

// 64² pixels, white in a disk and grey around it, black elsewhere.
Mask spot(bool invert)
{
    auto image = std::make_shared<terrain::ChannelImage>();
    image->width = image->height = 64;
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x) {
            const double distance = std::hypot(x - 20.0, y - 40.0);
            image->values.push_back(distance < 16.0 ? 65535 : distance < 20.0 ? 30'000 : 0);
        }
    Mask mask;
    mask.source = Mask::Source::texture;
    mask.invert = invert;
    mask.image = std::move(image);
    return mask;
}

// Ground whose texture repeats, mirrored and turned, and whose red rises along x from below 0.
terrain::GroundMesh painted()
{
    terrain::GroundMesh ground = meshes::hills(20.0, 24);
    ground.hasColors = true;
    for (std::size_t v = 0; v < ground.positions.size(); ++v) {
        const glm::vec3 p = ground.positions[v];
        ground.uvs[v] = {-0.07f * p.x + 0.03f * p.z, 0.05f * p.z + 0.02f * p.x - 3.0f};
        ground.colors[v].x = std::fmax(0.0f, 0.1f * p.x);
    }
    return ground;
}

std::vector<BoundCase> cases()
{
    const BakeSettings plain = tests::plainSettings(1.0);
    std::vector<BoundCase> list;
    const auto add = [&](std::string name, terrain::GroundMesh ground) -> BakeSettings& {
        return list.emplace_back(BoundCase{std::move(name), std::move(ground), plain}).settings;
    };
    add("slope", meshes::hills(20.0, 24)).slope = {5.0, 20.0, 0.0};
    add("soft slope", meshes::sphere(24, 5.0)).slope = {30.0, 60.0, 20.0};
    add("altitude", meshes::hills(20.0, 24)).altitude = {0.2, 0.5, 0.3};
    add("water", meshes::sphere(12, 5.0)).water = {1.0, unbounded, 0.5};
    BakeSettings& planet = add("planet", meshes::hills(20.0, 24));
    planet.groundUp.radial = true;
    planet.groundUp.centre = {1.0, -9.0, 2.0};
    planet.slope = {0.0, 25.0, 10.0};
    planet.altitude = {9.5, 12.0, 1.0};
    BakeSettings& inside = add("centre inside", meshes::cube(2.0));
    inside.groundUp.radial = true;
    inside.slope = {0.0, 30.0, 5.0};
    inside.altitude = {0.0, 1.2, 0.1};
    BakeSettings& back = add("back", meshes::sphere(24, 5.0));
    back.sides = Sides::back;
    back.slope = {0.0, 45.0, 15.0};
    add("image", painted()).masks = {spot(false)};
    add("inverted image", painted()).masks = {spot(true)};
    Mask red;
    add("colours", painted()).masks = {red};
    red.invert = true;
    add("inverted colours", painted()).masks = {red, spot(false)};
    BakeSettings& species = add("species", meshes::hills(20.0, 24));
    species.meadow.species.resize(2);
    species.meadow.species[0].habitat.slope = {0.0, 8.0, 3.0};
    species.meadow.species[0].cover = 0.6;
    species.meadow.species[1].habitat.altitude = {0.4, unbounded, 0.1};
    return list;
}

// A part of a triangle's side, of any level from 0 to 4.
GroundPart somePart(const terrain::GroundMesh& ground, bool back, std::uint64_t number)
{
    const auto pick = [&](std::uint32_t purpose, std::uint32_t count) {
        return static_cast<std::uint32_t>(uniform(seed, number, purpose) * count);
    };
    GroundPart part;
    part.triangle = pick(0, static_cast<std::uint32_t>(ground.triangles.size()));
    part.back = back;
    const std::uint32_t rows = 1U << pick(1, 5);
    const std::uint32_t i = pick(2, rows);
    const std::uint32_t j = pick(3, rows - i);
    const bool turned = i + j + 1 < rows && pick(4, 2) == 1;
    part.size = (turned ? -1.0 : 1.0) / rows;
    part.b = (turned ? i + 1.0 : double(i)) / rows;
    part.c = (turned ? j + 1.0 : double(j)) / rows;
    return part;
}

TEST(WeightBounds, AreAboveTheWeightOfEveryRootOfAPart)
{
    for (const BoundCase& one : cases()) {
        const RootFilter filter(one.ground, one.settings, nullptr);
        ASSERT_TRUE(filter.bounds().lowersAny()) << one.name;
        std::uint64_t bare = 0;
        std::uint64_t lowered = 0;
        const bool back = one.settings.sides == Sides::back;
        constexpr std::uint64_t parts = 4000;
        for (std::uint64_t number = 0; number < parts; ++number) {
            const GroundPart part = somePart(one.ground, back, number);
            const WeightBound bound = filter.bounds().on(part);
            ASSERT_LE(bound.weight, 1.0) << one.name;
            bare += std::uint64_t(bound.isBare());
            lowered += std::uint64_t(bound.weight < 1.0);
            const TrianglePoints points(one.ground, part.triangle);
            for (std::uint32_t i = 0; i < 12; ++i) {
                // The corners, which have the extremes, and places between them.
                double u = uniform(seed, number, 10 + 2 * i);
                double v = (1.0 - u) * uniform(seed, number, 11 + 2 * i);
                if (i < 3) {
                    u = i == 1 ? 1.0 : 0.0;
                    v = i == 2 ? 1.0 : 0.0;
                }
                const RootSample root =
                    points.at(static_cast<float>(part.b + part.size * u),
                              static_cast<float>(part.c + part.size * v), back ? backSide : 0U);
                Reject reason = Reject::mask;
                ASSERT_LE(filter.weigh(root, 0.0, reason), bound.weight)
                    << one.name << ", part " << number;
            }
        }
        // A bound that never says anything would be above as well.
        EXPECT_GT(lowered, parts / 20) << one.name;
        EXPECT_GT(bare, parts / 20) << one.name;
    }
}

TEST(WeightBounds, SayNothingWithoutFilters)
{
    const terrain::GroundMesh ground = meshes::square(10.0);
    const BakeSettings settings = tests::plainSettings(1.0);
    const WeightBounds bounds(ground, settings, nullptr);
    EXPECT_FALSE(bounds.lowersAny());
    EXPECT_EQ(bounds.on({}).weight, 1.0);
}

BakeSettings diskSettings(std::uint64_t count)
{
    BakeSettings settings = tests::plainSettings(1.0);
    settings.density.reset();
    settings.count = count;
    settings.spread = Spread::poisson;
    return settings;
}

double bakedRadius(const terrain::GroundMesh& ground, const BakeSettings& settings)
{
    Diagnostics diagnostics;
    Progress progress;
    const Report report = bakeField(ground, settings, 2, diagnostics, progress).report;
    return report.relativeRadius.value_or(-1.0);
}

TEST(RelativeRadius, IsThatOfTheGroundThatBears)
{
    // A quarter, a third and a fifth of the ground bear: ρ is as without a filter.
    const terrain::GroundMesh sphere = meshes::sphere(64, 1.0);
    BakeSettings settings = diskSettings(20'000);
    const double whole = bakedRadius(sphere, settings);
    EXPECT_NEAR(whole, 0.705, 0.015);
    settings.slope = {0.0, 60.0, 0.0};
    EXPECT_NEAR(bakedRadius(sphere, settings), whole, 0.02);
    settings.slope = {};
    settings.altitude = {0.333, unbounded, 0.0};
    EXPECT_NEAR(bakedRadius(sphere, settings), whole, 0.02);
    settings.altitude = {};
    settings.spread = Spread::poissonDense;
    settings.slope = {0.0, 60.0, 0.0};
    EXPECT_NEAR(bakedRadius(sphere, settings), 0.75, 0.02);
}

TEST(RelativeRadius, IsNotToldWhereStrokesThinTheRoots)
{
    const terrain::GroundMesh ground = meshes::square(10.0);
    BakeSettings settings = diskSettings(2000);
    Stroke clear;
    clear.kind = StrokeKind::clear;
    clear.radius = 2.0;
    clear.points = {{0, 0, 0}, {1000, 0, 0}};
    settings.strokes.list = {clear};
    Diagnostics diagnostics;
    Progress progress;
    EXPECT_FALSE(bakeField(ground, settings, 1, diagnostics, progress).report.relativeRadius);
}

} // namespace
} // namespace sward::bake
