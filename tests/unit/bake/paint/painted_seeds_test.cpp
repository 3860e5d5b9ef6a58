// Seeds of painted ground: the blades that grow from them are those of a plain bake with the same
// strokes.
#include "bake/bake.h"
#include "bake/seeds/grow_field.h"
#include "bake/seeds/seeded_field.h"
#include "bake/settings/meadow.h"
#include "core/error.h"
#include "core/math/exact_math.h"
#include "field/inspect.h"
#include "field/verify.h"
#include "support/meshes.h"
#include "unit/bake/bake_settings.h"
#include "unit/bake/paint/strokes.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace sward::bake {
namespace {

using tests::hardStroke;

field::Field plantedField(const terrain::GroundMesh& ground, BakeSettings settings, SeedUse seeds)
{
    settings.seeds = seeds;
    Diagnostics diagnostics;
    Progress progress;
    return bakeField(ground, settings, 2, diagnostics, progress).field;
}

field::Field grownWith(const terrain::GroundMesh& ground, const BakeSettings& settings)
{
    const field::Field seeded = plantedField(ground, settings, SeedUse::always);
    Progress progress;
    field::Field grown = growField(field::viewOf(seeded), {}, 2, "seeded", progress);
    field::verify(field::viewOf(grown), "grown");
    return grown;
}

BakeSettings paintedSettings(double density, const terrain::GroundMesh& ground, Strokes strokes)
{
    BakeSettings settings = tests::meadowSettings(density);
    const bool isLevel = ground.triangles.size() == 2;
    settings.strokes = isLevel ? std::move(strokes) : tests::laidOn(ground, std::move(strokes));
    for (Stroke& stroke : settings.strokes.list)
        if (stroke.kind == StrokeKind::species)
            stroke.slot = 1;
    return settings;
}

std::set<std::uint64_t> keysIn(const field::Field& field)
{
    std::set<std::uint64_t> keys;
    const field::FieldView view = field::viewOf(field);
    for (std::size_t i = 0; i < view.blades.size(); ++i)
        if (!view.isRibbon(i))
            keys.insert(keyBits(view.keys[i]));
    return keys;
}

struct Differences {
    double heights = 0.0;   ///< mean, in mean heights
    double stiffness = 0.0; ///< mean
    double dried = 0.0;     ///< share of blades that are dried in one alone
    double species = 0.0;   ///< share of blades of another species
    double facings = 0.0;   ///< mean angle between width axes
    std::size_t count = 0;
};

std::map<std::uint64_t, shared::Blade> bladesByKey(const field::Field& field)
{
    const field::FieldView view = field::viewOf(field);
    const std::vector<std::uint32_t> patches = field::patchOfBlades(view);
    std::map<std::uint64_t, shared::Blade> blades;
    for (std::size_t i = 0; i < view.blades.size(); ++i)
        blades[keyBits(view.keys[i])] =
            shared::unpackBlade(view.blades[i], view.patches[patches[i]]);
    return blades;
}

Differences differencesOf(const field::Field& a, const field::Field& b, const Strokes& within)
{
    Differences found;
    const std::map<std::uint64_t, shared::Blade> first = bladesByKey(a);
    double heights = 0.0;
    for (const auto& [key, blade] : bladesByKey(b)) {
        const auto other = first.find(key);
        if (other == first.end() || !tests::isInReach(within, glm::dvec3(blade.root)))
            continue;
        ++found.count;
        heights += double(other->second.height);
        found.heights += std::abs(double(blade.height - other->second.height));
        found.stiffness += std::abs(double(blade.stiffness - other->second.stiffness));
        const auto isDried = [](const shared::Blade& one) {
            return one.clump == shared::driedClump;
        };
        found.dried += isDried(blade) != isDried(other->second) ? 1.0 : 0.0;
        found.species += blade.species != other->second.species ? 1.0 : 0.0;
        const double turn = std::abs(double(blade.facing - other->second.facing));
        found.facings += std::min(turn, exactTwoPi - turn);
    }
    const auto count = double(std::max<std::size_t>(found.count, 1));
    found.stiffness /= count;
    found.dried /= count;
    found.species /= count;
    found.facings /= count;
    found.heights /= std::max(heights, 1e-9);
    return found;
}

// Share of the stalks of two fields that one of them alone has.
double differingStalks(const field::Field& plain, const field::Field& grown)
{
    const std::set<std::uint64_t> meant = keysIn(plain);
    const std::set<std::uint64_t> found = keysIn(grown);
    std::vector<std::uint64_t> differ;
    std::set_symmetric_difference(meant.begin(), meant.end(), found.begin(), found.end(),
                                  std::back_inserter(differ));
    EXPECT_GT(meant.size(), 50'000U);
    return double(differ.size()) / double(meant.size());
}

void expectPaintedBlades(const terrain::GroundMesh& ground, const BakeSettings& settings)
{
    const field::Field plain = plantedField(ground, settings, SeedUse::never);
    const field::Field grown = grownWith(ground, settings);
    EXPECT_LE(differingStalks(plain, grown), 1e-4);
    const Differences traits = differencesOf(plain, grown, settings.strokes);
    ASSERT_GT(traits.count, 20'000U);
    EXPECT_LT(traits.heights, 0.01);
    EXPECT_LT(traits.stiffness, 0.001);
    EXPECT_LT(traits.dried, 0.002);
    EXPECT_LT(traits.species, 0.002);
    EXPECT_LT(traits.facings, 0.005);
}

TEST(PaintedSeeds, GrowTheBladesOfAPaintedBake)
{
    const terrain::GroundMesh hills = meshes::hills(24.0, 24);
    expectPaintedBlades(hills, paintedSettings(150.0, hills, tests::allKinds()));
    const terrain::GroundMesh level = meshes::square(24.0);
    expectPaintedBlades(level, paintedSettings(150.0, level, tests::allKinds()));
}

TEST(PaintedSeeds, GrowThemWhereSpeciesAreMixedByTheGround)
{
    const terrain::GroundMesh hills = meshes::hills(24.0, 24);
    BakeSettings settings = paintedSettings(150.0, hills, tests::allKinds());
    settings.meadow.species[1].habitat.slope = {0.0, 8.0, 4.0};
    const field::Field plain = plantedField(hills, settings, SeedUse::never);
    const field::Field grown = grownWith(hills, settings);
    EXPECT_LE(differingStalks(plain, grown), 0.01) << "as without strokes";
    // Shares have a byte, of which seldom species have little.
    EXPECT_LT(differencesOf(plain, grown, settings.strokes).species, 0.05);
}

TEST(PaintedSeeds, GrowNothingWhereAStrokeSaysNone)
{
    const terrain::GroundMesh level = meshes::square(24.0);
    Strokes strokes;
    strokes.list = {
        tests::hardStroke(StrokeKind::erase, {{-6.1, 0.0, -3.0}, {5.3, 0.0, 4.2}}, 0.9),
        tests::hardStroke(StrokeKind::erase, {{4.0, 0.0, -8.0}, {4.5, 0.0, 2.0}}, 0.04)};
    const field::Field grown = grownWith(level, paintedSettings(400.0, level, strokes));
    ASSERT_GT(grown.blades.size(), 100'000U);
    for (const auto& [key, blade] : bladesByKey(grown))
        EXPECT_FALSE(tests::isInReach(strokes, glm::dvec3(blade.root), -1e-3));
}

TEST(PaintedSeeds, AreTheSameInTiles)
{
    const terrain::GroundMesh ground = meshes::hills(80.0, 40);
    BakeSettings settings = paintedSettings(8.0, ground, tests::allKinds());
    settings.seeds = SeedUse::always;
    settings.exposureRays = 4;
    TileLimits tiles;
    tiles.trianglesInOne = 100;
    tiles.trianglesInTile = 800;
    Diagnostics diagnostics;
    Progress progress;
    const auto seedsOf = [&](const TileLimits& limits) {
        return bakeSeededField(ground, settings, 2, limits, diagnostics, progress).field.seeds;
    };
    const auto whole = seedsOf({});
    const auto parts = seedsOf(tiles);
    EXPECT_GT(whole->seeds.cells.size(), 4U);
    EXPECT_TRUE(std::ranges::equal(whole->seeds.data, parts->seeds.data));
}

TEST(PaintedSeeds, AreVerifiedWithMoreCandidatesThanExpected)
{
    const terrain::GroundMesh level = meshes::square(10.0);
    Strokes strokes;
    strokes.list = {tests::hardStroke(StrokeKind::set, {{0.0, 0.0, 0.0}}, 3.0, 4.0)};
    const field::Field field =
        plantedField(level, paintedSettings(50.0, level, strokes), SeedUse::always);
    field::SeedCell cell;
    std::size_t dense = 0;
    for (std::size_t i = 0; i < field.seeds->view.cells.size(); ++i) {
        cell = field::readSeedCell(field.seeds->view, i, "painted");
        for (shared::SeedPiece& piece : cell.pieces) {
            const std::uint32_t parts = (piece.form & 31U) + (piece.form >> 5U & 31U);
            if (std::ldexp(double(piece.count), int(parts)) < 1.5 * double(piece.expected))
                continue;
            ++dense;
            EXPECT_NE(piece.bits, shared::noSeedBits);
            const std::uint32_t bits = std::exchange(piece.bits, shared::noSeedBits);
            EXPECT_THROW(field::verifySeedCell(cell, "damaged"), Error) << "more without bits";
            piece.bits = bits;
            piece.count *= 9;
            EXPECT_THROW(field::verifySeedCell(cell, "damaged"), Error) << "more than strokes ask";
            piece.count /= 9;
        }
    }
    EXPECT_GT(dense, 0U);
}

} // namespace
} // namespace sward::bake
