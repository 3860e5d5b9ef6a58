#include "bake/paint/painting.h"
#include "support/meshes.h"
#include "unit/bake/bake_settings.h"
#include "unit/bake/paint/strokes.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace sward::bake {
namespace {

using tests::hardStroke;

const glm::dvec3 middle(0.0);

double countIn(const Roots& roots, double radius)
{
    return double(std::count_if(roots.begin(), roots.end(), [&](const RootSample& root) {
        return glm::length(glm::dvec2(root.position.x, root.position.z)) < radius;
    }));
}

// Blades per m² within `radius` of the middle, relative to the bake's density.
double densityIn(const terrain::GroundMesh& ground, const BakeSettings& settings, double radius)
{
    return countIn(tests::paintedRoots(ground, settings).roots, radius) /
           (std::numbers::pi * radius * radius * *settings.density);
}

struct DensityCase {
    const char* name;
    std::vector<Stroke> strokes;
    double expected;
};

std::ostream& operator<<(std::ostream& out, const DensityCase& one)
{
    return out << one.name;
}

Stroke dab(StrokeKind kind, double value, double strength = 1.0)
{
    Stroke stroke = hardStroke(kind, {middle}, 15.0, value);
    stroke.strength = strength;
    return stroke;
}

class PaintedDensity : public testing::TestWithParam<DensityCase> {};

// Within 1 % on two triangles, on many, and on so many that each has one candidate or two.
TEST_P(PaintedDensity, IsWhatTheStrokesSay)
{
    BakeSettings settings = tests::plainSettings(700.0);
    settings.strokes.list = GetParam().strokes;
    for (const terrain::GroundMesh& ground :
         {meshes::square(32.0), meshes::grid(60, 32.0), meshes::grid(500, 32.0)})
        EXPECT_NEAR(densityIn(ground, settings, 14.9), GetParam().expected,
                    0.01 * GetParam().expected)
            << ground.triangles.size();
}

INSTANTIATE_TEST_SUITE_P(
    Strokes, PaintedDensity,
    testing::Values(
        DensityCase{"add", {dab(StrokeKind::add, 2.6)}, 2.6},
        DensityCase{"addHalf", {dab(StrokeKind::add, 3.0, 0.5)}, 2.0},
        DensityCase{"addBelow", {dab(StrokeKind::add, 0.5)}, 1.0},
        DensityCase{"erase", {dab(StrokeKind::erase, 1.0)}, 0.0},
        DensityCase{"eraseSome", {dab(StrokeKind::erase, 1.0, 0.3)}, 0.7},
        DensityCase{"setLow", {dab(StrokeKind::set, 0.25)}, 0.25},
        DensityCase{"setHigh", {dab(StrokeKind::set, 8.0)}, 8.0},
        DensityCase{"eraseThenAdd", {dab(StrokeKind::erase, 1.0), dab(StrokeKind::add, 0.4)}, 0.4},
        DensityCase{
            "addThenErase", {dab(StrokeKind::add, 4.0), dab(StrokeKind::erase, 1.0, 0.5)}, 2.0},
        DensityCase{
            "smoothEven",
            {hardStroke(StrokeKind::set, {middle}, 40.0, 0.5), dab(StrokeKind::smooth, 1.0)},
            0.5}),
    [](const testing::TestParamInfo<DensityCase>& tested) {
        return std::string(tested.param.name);
    });

TEST(Painting, FallsOffAsTheHardnessSays)
{
    BakeSettings settings = tests::plainSettings(900.0);
    for (const double hardness : {0.0, 0.5}) {
        Stroke stroke = dab(StrokeKind::erase, 1.0);
        stroke.hardness = hardness;
        settings.strokes.list = {stroke};
        // ∫ (1 − f) 2x dx over the disk, f by the formula of docs/painting.md.
        double expected = 0.0;
        constexpr int steps = 20'000;
        for (int i = 0; i < steps; ++i) {
            const double x = (i + 0.5) / steps;
            const double t = x <= hardness ? 1.0 : 1.0 - (x - hardness) / (1.0 - hardness);
            expected += (1.0 - t * t * (3.0 - 2.0 * t)) * 2.0 * x / steps;
        }
        EXPECT_NEAR(densityIn(meshes::square(32.0), settings, 15.0), expected, 0.01 * expected);
    }
}

TEST(Painting, OverridesMasksAndSlopeButNotHoles)
{
    BakeSettings settings = tests::plainSettings(700.0);
    terrain::GroundMesh ground = meshes::grid(40, 32.0);
    ground.hasColors = true;
    for (glm::vec4& color : ground.colors)
        color = glm::vec4(0.25f);
    settings.masks = {Mask()};
    EXPECT_NEAR(densityIn(ground, settings, 14.9), 0.25, 0.0025);
    settings.strokes.list = {dab(StrokeKind::add, 0.8)};
    EXPECT_NEAR(densityIn(ground, settings, 14.9), 0.8, 0.008);
    settings.strokes.list = {dab(StrokeKind::add, 2.0)};
    EXPECT_NEAR(densityIn(ground, settings, 14.9), 2.0, 0.02);
    settings.slope = {50.0, 180.0, 0.0};
    EXPECT_NEAR(densityIn(ground, settings, 14.9), 2.0, 0.02);

    settings = tests::plainSettings(700.0);
    ground = meshes::grid(40, 32.0);
    ground.materials[0].alphaCutoff = 0.5f;
    ground.materials[0].baseColor.w = 0.1f;
    settings.strokes.list = {dab(StrokeKind::set, 1.0)};
    EXPECT_EQ(tests::paintedRoots(ground, settings).roots.size(), 0U);
}

TEST(Painting, KeepsTheDensityOfACountWithoutStrokes)
{
    BakeSettings settings = tests::plainSettings(0.0);
    settings.density.reset();
    settings.count = 700'000;
    const terrain::GroundMesh ground = meshes::grid(40, 32.0);
    const double before = countIn(tests::paintedRoots(ground, settings).roots, 14.9);
    for (const double density : {0.4, 3.0}) {
        settings.strokes.list = {dab(StrokeKind::set, density)};
        const Roots after = tests::paintedRoots(ground, settings).roots;
        EXPECT_NEAR(countIn(after, 14.9), density * before, 0.01 * density * before);
        EXPECT_NEAR(double(after.size()),
                    700'000.0 + (density - 1.0) * 700'000.0 * std::numbers::pi * 225.0 / 1024.0,
                    5000.0);
    }
}

TEST(Painting, ThinsPoissonDisksAndAddsNone)
{
    const terrain::GroundMesh ground = meshes::grid(40, 32.0);
    BakeSettings settings = tests::plainSettings(700.0);
    settings.spread = Spread::poisson;
    const Roots before = tests::paintedRoots(ground, settings).roots;
    settings.strokes.list = {dab(StrokeKind::set, 0.6)};
    const Roots thinned = tests::paintedRoots(ground, settings).roots;
    EXPECT_NEAR(countIn(thinned, 14.9), 0.6 * countIn(before, 14.9), 0.006 * countIn(before, 14.9));
    // Those that are left stand where they stood.
    const auto isKnown = [&, next = before.begin()](const RootSample& root) mutable {
        next = std::find_if(next, before.end(), [&](const RootSample& other) {
            return other.position == root.position && other.candidate == root.candidate;
        });
        return next != before.end();
    };
    EXPECT_TRUE(std::all_of(thinned.begin(), thinned.end(), isKnown));
    settings.strokes.list = {dab(StrokeKind::add, 3.0)};
    EXPECT_EQ(tests::paintedRoots(ground, settings).roots.size(), before.size());
}

// What is kept of the ground's two sheets: those that face up, and those that face down.
std::pair<std::size_t, std::size_t> sheets(const terrain::GroundMesh& ground,
                                           const BakeSettings& settings)
{
    std::pair<std::size_t, std::size_t> counts;
    for (const RootSample& root : tests::paintedRoots(ground, settings).roots)
        ++(root.normal.y > 0.0f ? counts.first : counts.second);
    return counts;
}

terrain::GroundMesh turnedOver(double side, double height)
{
    terrain::GroundMesh under = meshes::square(side, height);
    for (glm::uvec3& triangle : under.triangles)
        std::swap(triangle.y, triangle.z);
    for (glm::vec3& normal : under.normals)
        normal = -normal;
    return under;
}

TEST(Painting, LeavesTheOtherSideOfAThinSheetAlone)
{
    // A sheet of two squares a millimetre apart, a single square that bears on both sides, and a
    // cave whose roof hangs half a metre above its floor.
    terrain::GroundMesh sheet = meshes::square(10.0);
    append(sheet, turnedOver(10.0, -0.001));
    terrain::GroundMesh cave = meshes::square(10.0);
    append(cave, turnedOver(10.0, 0.5));
    terrain::GroundMesh leaf = meshes::square(10.0);
    for (terrain::GroundMesh* const ground : {&sheet, &cave, &leaf}) {
        BakeSettings settings = tests::plainSettings(100.0);
        settings.sides = ground == &leaf ? Sides::both : Sides::front;
        const auto before = sheets(*ground, settings);
        EXPECT_GT(before.second, 9000U);
        settings.strokes.list = {dab(StrokeKind::erase, 1.0)};
        EXPECT_EQ(sheets(*ground, settings), std::pair(std::size_t(0), before.second));
        settings.strokes.list[0].normals = {{0, -1000, 0}};
        EXPECT_EQ(sheets(*ground, settings), std::pair(before.first, std::size_t(0)));
        settings.strokes.list[0].normals.clear();
        EXPECT_EQ(sheets(*ground, settings), std::pair(std::size_t(0), std::size_t(0)));
        // More than the density, too.
        settings.strokes.list = {dab(StrokeKind::add, 3.0)};
        EXPECT_EQ(sheets(*ground, settings).second, before.second);
    }
}

TEST(Painting, ReachesNoFartherAlongTheNormalThanItsDepth)
{
    terrain::GroundMesh storeys = meshes::square(10.0);
    append(storeys, meshes::square(10.0, 3.0));
    BakeSettings settings = tests::plainSettings(100.0);
    Stroke stroke = dab(StrokeKind::erase, 1.0);
    const auto upper = [&] {
        settings.strokes.list = {stroke};
        const Roots roots = tests::paintedRoots(storeys, settings).roots;
        EXPECT_EQ(std::count_if(roots.begin(), roots.end(),
                                [](const RootSample& root) { return root.position.y < 1.0f; }),
                  0);
        return roots.size();
    };
    EXPECT_EQ(upper(), 0U);
    stroke.depth = 2.0;
    EXPECT_GT(upper(), 9000U);
}

TEST(Painting, SmoothsTheEdgesOfStrokes)
{
    // Across the edge of a bare disk.
    Strokes strokes;
    strokes.list = {hardStroke(StrokeKind::erase, {middle}, 10.0)};
    const Aabb ground{glm::vec3(-32.0f), glm::vec3(32.0f)};
    const glm::vec3 up(0.0f, 1.0f, 0.0f);
    const auto steepest = [&] {
        const Painting painting(strokes, middle, ground);
        double result = 0.0;
        double last = painting.densityAt({0.0f, 0.0f, 0.0f}, up, 1.0);
        for (float x = 0.05f; x < 20.0f; x += 0.05f) {
            const double density = painting.densityAt({x, 0.0f, 0.0f}, up, 1.0);
            EXPECT_GE(density, 0.0);
            EXPECT_LE(density, 1.0);
            result = std::max(result, std::fabs(density - last));
            last = density;
        }
        return result;
    };
    EXPECT_EQ(steepest(), 1.0);
    strokes.list.push_back(hardStroke(StrokeKind::smooth, {{10.0, 0.0, 0.0}}, 4.0));
    EXPECT_LT(steepest(), 0.2);
}

TEST(Painting, OfATranslatedWorldIsTheSame)
{
    const glm::dvec3 by(320.0, -64.0, 3200.0);
    const Strokes strokes = tests::allKinds();
    Strokes moved = strokes;
    for (Stroke& stroke : moved.list)
        for (auto& point : stroke.points)
            for (std::size_t axis = 0; axis < 3; ++axis)
                point[axis] += std::llround(by[int(axis)] * 1000.0);
    const Aabb ground{glm::vec3(-32.0f), glm::vec3(32.0f)};
    const Painting here(strokes, middle, ground);
    const Painting there(moved, by, ground);
    const glm::vec3 up(0.0f, 1.0f, 0.0f);
    for (const RootSample& root :
         tests::paintedRoots(meshes::grid(9, 30.0), tests::plainSettings(20.0)).roots) {
        const PaintedLook a = here.lookAt(root.position, up);
        const PaintedLook b = there.lookAt(root.position, up);
        EXPECT_EQ(a.height, b.height);
        EXPECT_EQ(a.dryness, b.dryness);
        EXPECT_EQ(a.lean, b.lean);
        EXPECT_EQ(here.densityAt(root.position, up, 0.7), there.densityAt(root.position, up, 0.7));
        EXPECT_EQ(here.speciesAt(root.position, up).share,
                  there.speciesAt(root.position, up).share);
    }
}

// The index finds what a search through all capsules finds.
TEST(Painting, FindsEveryStrokeThatReachesAPoint)
{
    Strokes strokes;
    for (std::uint64_t i = 0; i < 300; ++i) {
        const auto random = [&](std::uint32_t dimension) { return uniform(7, i, dimension); };
        std::vector<glm::dvec3> points;
        for (std::uint32_t p = 0; p < 1 + i % 4; ++p)
            points.emplace_back(60.0 * random(3 * p) - 30.0, random(3 * p + 1) - 0.5,
                                60.0 * random(3 * p + 2) - 30.0);
        // From 5 mm to 3 m.
        strokes.list.push_back(hardStroke(StrokeKind::height, points,
                                          0.005 * std::exp(6.5 * random(50)), 0.5 + random(51)));
    }
    const Painting painting(strokes, middle, {glm::vec3(-32.0f), glm::vec3(32.0f)});
    const glm::vec3 up(0.0f, 1.0f, 0.0f);
    std::size_t painted = 0;
    for (std::uint64_t i = 0; i < 5000; ++i) {
        const glm::vec3 place(60.0 * uniform(8, i, 0) - 30.0, 0.1 * uniform(8, i, 1),
                              60.0 * uniform(8, i, 2) - 30.0);
        double expected = 1.0;
        for (const Stroke& stroke : strokes.list)
            if (tests::isInReach(stroke, glm::dvec3(place)))
                expected = stroke.value;
        EXPECT_EQ(painting.lookAt(place, up).height, expected);
        painted += std::size_t(expected != 1.0);
    }
    EXPECT_GT(painted, 1000U);
    EXPECT_LT(painted, 5000U);
}

} // namespace
} // namespace sward::bake
