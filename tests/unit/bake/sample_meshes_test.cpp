#include "bake/bake.h"
#include "bake/poisson/poisson_region.h"
#include "field/inspect.h"
#include "field/verify.h"
#include "shaders/shared/blade.h"
#include "support/meshes.h"
#include "terrain/procedural/landforms.h"
#include "terrain/procedural/primitives.h"
#include "unit/bake/bake_settings.h"
#include "unit/bake/sample/spread.h"

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

// Properties on difficult meshes.
namespace sward::bake {
namespace {

struct Ground {
    const char* name;
    std::function<terrain::GroundMesh()> make;
};

std::ostream& operator<<(std::ostream& out, const Ground& ground)
{
    return out << ground.name;
}

// Two sheets 2 mm apart that face away from each other, bent along x.
terrain::GroundMesh leaf()
{
    std::vector<glm::dvec3> positions;
    std::vector<glm::uvec3> triangles;
    for (const double side : {-0.001, 0.001}) {
        const auto first = static_cast<std::uint32_t>(positions.size());
        for (int i = 0; i <= 8; ++i)
            for (int j = 0; j <= 8; ++j)
                positions.emplace_back(0.25 * i, side + 0.01 * (i - 4) * (i - 4), 0.25 * j);
        for (std::uint32_t i = 0; i < 8; ++i)
            for (std::uint32_t j = 0; j < 8; ++j) {
                const std::uint32_t a = first + 9 * i + j;
                const glm::uvec3 low(a, a + 1, a + 9);
                const glm::uvec3 high(a + 9, a + 1, a + 10);
                triangles.push_back(side > 0.0 ? low : glm::uvec3(low.x, low.z, low.y));
                triangles.push_back(side > 0.0 ? high : glm::uvec3(high.x, high.z, high.y));
            }
    }
    return meshes::soup(positions, triangles);
}

// Level squares of 1/4 m², 1 m apart, each turned and lifted on its own.
terrain::GroundMesh islands(std::uint32_t count)
{
    std::vector<glm::dvec3> positions;
    std::vector<glm::uvec3> triangles;
    for (std::uint32_t i = 0; i < count; ++i) {
        const glm::dvec3 corner(i % 40, 0.1 * (i % 7), i / 40);
        const auto first = static_cast<std::uint32_t>(positions.size());
        for (const glm::dvec3 offset : {glm::dvec3(0, 0, 0), glm::dvec3(0, 0, 0.5),
                                        glm::dvec3(0.5, 0, 0), glm::dvec3(0.5, 0, 0.5)})
            positions.push_back(corner + offset);
        triangles.emplace_back(first, first + 1, first + 2);
        triangles.emplace_back(first + 2, first + 1, first + 3);
    }
    return meshes::soup(positions, triangles);
}

BakeResult bakeOf(const terrain::GroundMesh& ground, const BakeSettings& settings)
{
    Diagnostics diagnostics;
    Progress progress;
    BakeResult result = bakeField(ground, settings, 2, diagnostics, progress);
    return result;
}

std::vector<shared::Blade> bladesOf(const field::Field& field)
{
    std::vector<shared::Blade> blades;
    for (const shared::Patch& patch : field.patches)
        for (std::uint32_t i = 0; i < patch.bladeCount; ++i)
            blades.push_back(shared::unpackBlade(field.blades[patch.firstBlade + i], patch));
    return blades;
}

// Roots whose up-vectors are within 70° of `up`.
std::vector<glm::dvec3> sheetOf(const std::vector<shared::Blade>& blades, const glm::vec3& up)
{
    std::vector<glm::dvec3> places;
    for (const shared::Blade& blade : blades)
        if (glm::dot(blade.up, up) > 0.34f)
            places.emplace_back(blade.root);
    return places;
}

// Rounding of places to the patches of the file, twice [m].
constexpr double rounding = 1e-3;

class SampleMesh : public testing::TestWithParam<Ground> {};

TEST_P(SampleMesh, BearsItsAreaTimesDensityOnItsSurfaceAlongItsNormals)
{
    const terrain::GroundMesh ground = GetParam().make();
    const double area = meshes::totalArea(ground);
    const double density = 20'000.0 / area;
    BakeSettings settings = tests::plainSettings(density);
    settings.meadow.edges.creaseBlend = 0.0;
    const field::Field field = bakeOf(ground, settings).field;
    field::verify(field::viewOf(field), GetParam().name);
    // ⌊λA + u⌋ is off by a variance of at most 1/4 on each triangle.
    EXPECT_NEAR(double(field.blades.size()), 20'000.0,
                5.0 * std::sqrt(0.25 * double(ground.triangles.size())) + 1.0);

    std::size_t index = 0;
    for (const shared::Blade& blade : bladesOf(field)) {
        const field::BladeKey key = field.keys[index++];
        const glm::uvec3 corners = ground.triangles[key.triangle];
        const glm::dvec3 normal = ground.faceNormal(key.triangle);
        const glm::dvec3 first(ground.positions[corners.x]);
        ASSERT_NEAR(glm::dot(glm::dvec3(blade.root) - first, normal), 0.0, rounding);
        glm::dvec3 low = first;
        glm::dvec3 high = first;
        for (const std::uint32_t corner : {corners.y, corners.z}) {
            low = glm::min(low, glm::dvec3(ground.positions[corner]));
            high = glm::max(high, glm::dvec3(ground.positions[corner]));
        }
        ASSERT_TRUE(glm::all(glm::greaterThanEqual(glm::dvec3(blade.root), low - rounding)) &&
                    glm::all(glm::lessThanEqual(glm::dvec3(blade.root), high + rounding)));
        // No normal is smoothed over more than a crease, 45°.
        ASSERT_GT(glm::dot(glm::dvec3(blade.up), normal), 0.707) << key.triangle;
    }
}

TEST_P(SampleMesh, KeepsTheSpacingOfPoissonDisksOnEachSheet)
{
    const terrain::GroundMesh ground = GetParam().make();
    BakeSettings settings = tests::plainSettings(1.0);
    settings.density.reset();
    settings.spread = Spread::poisson;
    // About ten thousand roots; a few more along borders, beyond which nothing covers.
    settings.spacing = std::sqrt(tuningOf(settings).yield * meshes::totalArea(ground) / 10'000.0);
    const BakeResult result = bakeOf(ground, settings);
    EXPECT_GE(result.report.spacingMinimum, *settings.spacing);
    EXPECT_GE(result.report.relativeRadius.value_or(0.0), 0.69);
    EXPECT_GE(result.field.blades.size(), 9'800U);
    EXPECT_LE(result.field.blades.size(), 13'000U);
}

INSTANTIATE_TEST_SUITE_P(
    All, SampleMesh,
    testing::Values(Ground{"sphere", [] { return meshes::sphere(96, 2.0); }},
                    Ground{"hills", [] { return meshes::hills(60.0, 40); }},
                    Ground{"torus", [] { return terrain::makeTorus(); }},
                    Ground{"arch", [] { return terrain::makeArch(); }},
                    Ground{"cube", [] { return meshes::cube(3.0); }},
                    Ground{"book", [] { return meshes::book(); }},
                    Ground{"moebius", [] { return meshes::moebius(96); }},
                    Ground{"leaf", [] { return leaf(); }},
                    Ground{"islands", [] { return islands(1000); }},
                    Ground{"triangle", [] { return meshes::triangle(); }},
                    Ground{"far",
                           [] {
                               return meshes::moved(meshes::sphere(96, 2.0), {1e6, 0, -1e6});
                           }}),
    [](const testing::TestParamInfo<Ground>& tested) { return std::string(tested.param.name); });

TEST(PoissonField, OfATurnedMeshIsAsEvenAndAsDense)
{
    const glm::dquat turn(glm::dvec3(0.4, -1.1, 2.3));
    for (const terrain::GroundMesh& mesh :
         {meshes::sphere(96, 2.0), meshes::hills(20.0, 20), meshes::cube(3.0)}) {
        BakeSettings settings = tests::plainSettings(20'000.0 / meshes::totalArea(mesh));
        settings.spread = Spread::poisson;
        const Report still = bakeOf(mesh, settings).report;
        const Report turned = bakeOf(meshes::rotated(mesh, turn), settings).report;
        EXPECT_NEAR(double(turned.kept) / double(still.kept), 1.0, 0.01);
        EXPECT_NEAR(*turned.relativeRadius / *still.relativeRadius, 1.0, 0.01);
    }
}

TEST(Book, BearsTheSameOnEachOfItsThreePages)
{
    const BakeResult result = bakeOf(meshes::book(), tests::plainSettings(3'000.0));
    const std::vector<shared::Blade> blades = bladesOf(result.field);
    for (std::size_t page = 0; page < 3; ++page) {
        std::size_t count = 0;
        for (const field::BladeKey& key : result.field.keys)
            count += key.triangle / 2 == page ? 1 : 0;
        EXPECT_NEAR(double(count), 3'000.0, 2.0) << page;
    }
}

TEST(Leaf, HasTwoSheetsThatDoNotRepelEachOther)
{
    BakeSettings settings = tests::plainSettings(1.0);
    settings.density.reset();
    settings.spread = Spread::poisson;
    settings.spacing = 0.04;
    const std::vector<shared::Blade> blades = bladesOf(bakeOf(leaf(), settings).field);
    const std::vector<glm::dvec3> top = sheetOf(blades, {0.0f, 1.0f, 0.0f});
    const std::vector<glm::dvec3> bottom = sheetOf(blades, {0.0f, -1.0f, 0.0f});
    EXPECT_EQ(top.size() + bottom.size(), blades.size());
    EXPECT_NEAR(double(top.size()) / double(bottom.size()), 1.0, 0.03);
    std::vector<glm::dvec3> both = top;
    both.insert(both.end(), bottom.begin(), bottom.end());
    EXPECT_GE(tests::smallestDistance(top, 0.08), 0.04);
    EXPECT_GE(tests::smallestDistance(bottom, 0.08), 0.04);
    EXPECT_LT(tests::smallestDistance(both, 0.08), 0.01);
}

TEST(Islands, BearTheirShareEachAndNothingIfTheyAreTooSmall)
{
    const terrain::GroundMesh ground = islands(1000);
    BakeSettings settings = tests::plainSettings(40.0);
    const field::Field field = bakeOf(ground, settings).field;
    std::vector<std::size_t> counts(1000, 0);
    for (const field::BladeKey& key : field.keys)
        ++counts[key.triangle / 2];
    // Two triangles of five candidates each.
    EXPECT_GE(*std::min_element(counts.begin(), counts.end()), 8U);
    EXPECT_LE(*std::max_element(counts.begin(), counts.end()), 12U);
    settings.minIsland = 0.3;
    const BakeResult none = bakeOf(ground, settings);
    EXPECT_EQ(none.field.blades.size(), 0U);
    EXPECT_EQ(none.report.rejected[static_cast<std::size_t>(Reject::border)], none.report.proposed);
}

TEST(FarGround, BearsWhatTheSameGroundBearsAtTheOrigin)
{
    const glm::dvec3 by(1e6, 0.0, -1e6);
    const terrain::GroundMesh near = meshes::hills(60.0, 60);
    const terrain::GroundMesh far = meshes::moved(near, by);
    for (const Spread spread : {Spread::uniform, Spread::poisson}) {
        BakeSettings settings = tests::plainSettings(5.0);
        settings.spread = spread;
        settings.meadow.clumpSize = 0.7;
        const field::Field one = bakeOf(near, settings).field;
        const field::Field other = bakeOf(far, settings).field;
        const field::Comparison result =
            field::compare(field::viewOf(one), field::viewOf(other),
                           glm::translate(glm::dmat4(1.0), by), field::Match::id, 1e-3);
        EXPECT_TRUE(result.reasons.empty()) << (result.reasons.empty() ? "" : result.reasons[0]);
        EXPECT_GT(result.matched, 10'000U);
    }
}

} // namespace
} // namespace sward::bake
