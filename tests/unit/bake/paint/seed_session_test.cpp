// A session of a field with seeds: after any change it has the bytes of a bake with the same
// strokes.
#include "bake/bake.h"
#include "bake/seeds/grow_field.h"
#include "bake/session/session.h"
#include "bake/settings/meadow.h"
#include "field/delta.h"
#include "field/seeds/changed_cubes.h"
#include "field/seeds/sow_unit.h"
#include "field/seeds/sower.h"
#include "field/verify.h"
#include "support/meshes.h"
#include "unit/bake/paint/strokes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <string>
#include <vector>

namespace sward::bake {
namespace {

BakeSettings seededSettings(double density)
{
    BakeSettings settings;
    settings.meadow = loadMeadow("meadow");
    settings.density = density;
    settings.exposureRays = 0;
    settings.bladeScale = 1.0;
    settings.seed = 11;
    settings.seeds = SeedUse::always;
    return settings;
}

field::Field fieldWith(const terrain::GroundMesh& ground, BakeSettings settings,
                       const Strokes& strokes)
{
    settings.strokes = strokes;
    return tests::paintedField(ground, settings).field;
}

// What differs first; empty if the fields have the same bytes.
std::string differenceOf(const field::Field& a, const field::Field& b)
{
    const auto equal = [](const auto& one, const auto& other) {
        return one.size() == other.size() &&
               (one.empty() ||
                std::memcmp(one.data(), other.data(), one.size() * sizeof one[0]) == 0);
    };
    return !equal(a.patches, b.patches)                         ? "patches"
           : !equal(a.blades, b.blades)                         ? "blades"
           : !equal(a.keys, b.keys)                             ? "keys"
           : !equal(a.seeds->seeds.cells, b.seeds->seeds.cells) ? "cells of seeds"
           : !equal(a.seeds->seeds.data, b.seeds->seeds.data)   ? "seeds"
           : a.provenance != b.provenance                       ? "provenance"
                                                                : "";
}

class SeedSession : public ::testing::Test {
protected:
    Session sessionOf(const terrain::GroundMesh& ground, const BakeSettings& settings,
                      const field::FieldView* baked = nullptr)
    {
        return {ground, settings, 2, diagnostics, progress, baked};
    }

    // Applies strokes one by one, then without some of them, and compares with bakes.
    void expectBakes(const terrain::GroundMesh& ground, const BakeSettings& settings,
                     const std::vector<Strokes>& changes)
    {
        Session session = sessionOf(ground, settings);
        const field::Field before = session.field();
        EXPECT_EQ(differenceOf(before, fieldWith(ground, settings, {})), "");
        for (std::size_t i = 0; i < changes.size(); ++i) {
            const Session::Change change = session.apply(changes[i], progress);
            EXPECT_FALSE(change.cells.empty()) << i;
            const field::Field meant = fieldWith(ground, settings, changes[i]);
            EXPECT_EQ(differenceOf(session.field(), meant), "") << i;
            EXPECT_NE(differenceOf(before, meant), "") << i;
        }
        session.apply({}, progress);
        EXPECT_EQ(differenceOf(session.field(), before), "");
    }

    Diagnostics diagnostics;
    Progress progress;
};

// Lists that grow and shrink, from strokes of all kinds.
std::vector<Strokes> changesOf(const Strokes& all)
{
    std::vector<Strokes> changes;
    for (const std::size_t count : {2U, 9U, 6U}) {
        changes.push_back(all);
        changes.back().list.resize(std::min<std::size_t>(count, all.list.size()));
    }
    changes.push_back(all);
    changes.back().list.erase(changes.back().list.begin() + 1);
    return changes;
}

TEST_F(SeedSession, HasTheBytesOfABakeAfterEveryChange)
{
    const terrain::GroundMesh ground = meshes::hills(50.0, 50);
    Strokes strokes = tests::laidOn(ground, tests::allKinds());
    for (Stroke& stroke : strokes.list)
        stroke.slot = 1;
    expectBakes(ground, seededSettings(20.0), changesOf(strokes));
}

TEST_F(SeedSession, HasThemOnWideTriangles)
{
    expectBakes(meshes::square(50.0), seededSettings(20.0), changesOf(tests::allKinds()));
}

TEST_F(SeedSession, HasThemWithRaysMasksAndBareGround)
{
    BakeSettings settings = seededSettings(60.0);
    settings.exposureRays = 8;
    settings.clearance = 0.1;
    expectBakes(meshes::boxAbovePlane(), settings, changesOf(tests::allKinds()));
    settings = seededSettings(20.0);
    settings.slope = {0.0, 6.0, 12.0};
    settings.exposureRays = 8;
    const terrain::GroundMesh ground = meshes::hills(40.0, 40);
    expectBakes(ground, settings, changesOf(tests::laidOn(ground, tests::allKinds())));
}

TEST_F(SeedSession, ErasesCellsAndSowsThemAgain)
{
    const terrain::GroundMesh ground = meshes::hills(70.0, 35);
    Strokes all;
    all.list = {tests::hardStroke(StrokeKind::erase, {{0.0, 0.0, 0.0}}, 100.0)};
    all.list[0].normals.clear();
    Strokes again = all;
    again.list.push_back(tests::hardStroke(StrokeKind::add, {{5.0, 0.0, 5.0}}, 4.0));
    again = tests::laidOn(ground, again);
    again.list[0] = all.list[0];
    expectBakes(ground, seededSettings(8.0), {all, again, all});
}

TEST_F(SeedSession, BeginsWithABakedField)
{
    const terrain::GroundMesh ground = meshes::hills(50.0, 50);
    BakeSettings settings = seededSettings(20.0);
    settings.strokes = tests::laidOn(ground, tests::allKinds());
    const field::Field baked = fieldWith(ground, settings, settings.strokes);
    const field::FieldView view = field::viewOf(baked);
    Session session = sessionOf(ground, settings, &view);
    EXPECT_TRUE(session.hasReused());
    EXPECT_EQ(differenceOf(session.field(), baked), "");
    session.apply({}, progress);
    EXPECT_EQ(differenceOf(session.field(), fieldWith(ground, settings, {})), "");
    // Plain blades do not serve it.
    BakeSettings plain = settings;
    plain.seeds = SeedUse::never;
    const field::Field stored = fieldWith(ground, plain, settings.strokes);
    const field::FieldView other = field::viewOf(stored);
    EXPECT_FALSE(sessionOf(ground, settings, &other).hasReused());
}

TEST_F(SeedSession, ChangesTheCellsThatAStrokeTouches)
{
    const terrain::GroundMesh ground = meshes::hills(120.0, 120);
    Session session = sessionOf(ground, seededSettings(4.0));
    Strokes strokes;
    strokes.list = {
        tests::hardStroke(StrokeKind::erase, {{10.0, 0.0, 10.0}, {16.0, 0.0, 12.0}}, 1.0)};
    strokes = tests::laidOn(ground, strokes);
    const Session::Change change = session.apply(strokes, progress);
    ASSERT_EQ(change.cells.size(), 1U);
    const field::Delta delta = session.deltaOf(change.cells);
    ASSERT_EQ(delta.seeds.size(), 1U);
    ASSERT_EQ(delta.cells.size(), 1U);
    EXPECT_EQ(delta.cells[0].cell, change.cells[0]);
    // A stroke that touches no surface changes nothing.
    strokes.list.push_back(tests::hardStroke(StrokeKind::erase, {{40.0, 0.0, 40.0}}, 1.0));
    strokes.list.back().normals = {{0, -1000, 0}};
    EXPECT_TRUE(session.apply(strokes, progress).cells.empty());
}

TEST_F(SeedSession, UnitsOutsideOfChangedCubesGrowTheSame)
{
    const terrain::GroundMesh ground = meshes::hills(40.0, 40);
    Session session = sessionOf(ground, seededSettings(80.0));
    const field::Field before = session.field();
    const field::SeedsView& seeds = before.seeds->view;
    Strokes strokes;
    strokes.list = {
        tests::hardStroke(StrokeKind::height, {{6.0, 0.0, 6.0}, {9.0, 0.0, 8.0}}, 1.0, 0.7)};
    const Session::Change change = session.apply(tests::laidOn(ground, strokes), progress);
    const field::Delta delta = session.deltaOf(change.cells);
    ASSERT_EQ(delta.seeds.size(), 1U);
    const field::Sower sower(*seeds.meadow, before.species, before.origin);
    const auto entry = std::find_if(seeds.cells.begin(), seeds.cells.end(), [&](const auto& one) {
        return one.cell == delta.seeds[0]->cell;
    });
    const field::UnitCell former(
        field::readSeedCell(seeds, static_cast<std::size_t>(entry - seeds.cells.begin()), "before"),
        sower);
    const field::UnitCell now(field::SeedCell(*delta.seeds[0]), sower);
    const field::UnitCell::Cubes changed =
        field::changedCubes(former.seeds(), now.seeds(), sower.meadow().unitBits);
    EXPECT_GT(changed.count(), 0U);
    EXPECT_LT(changed.count(), 20U);
    std::size_t others = 0;
    field::SowUnit unit{.cell = delta.seeds[0]->cell};
    for (unit.level = 0; unit.level <= sower.meadow().levels; ++unit.level) {
        const std::uint32_t side = 1U << field::unitLevel(unit.level);
        for (std::uint32_t p = 0; p < 2 * side * side * side; ++p) {
            unit.half = p % 2;
            unit.place = {p / 2 % side, p / 2 / side % side, p / 2 / side / side};
            const auto a = field::growUnit(sower, before.species, former, unit).blades;
            const auto b = field::growUnit(sower, before.species, now, unit).blades;
            const bool isSame = a.size() == b.size() &&
                                std::memcmp(a.data(), b.data(), a.size() * sizeof a[0]) == 0;
            EXPECT_TRUE(isSame || field::bears(changed, unit));
            others += isSame ? 0 : 1;
        }
    }
    EXPECT_GT(others, 0U);
}

TEST_F(SeedSession, FollowsSculptedGround)
{
    const terrain::GroundMesh ground = meshes::hills(90.0, 30);
    terrain::GroundMesh next = ground;
    next.positions[next.positions.size() / 2].y += 0.7f;
    const BakeSettings settings = seededSettings(8.0);
    Session session = sessionOf(ground, settings);
    const Strokes strokes = tests::laidOn(ground, tests::allKinds());
    session.apply(strokes, progress);
    const Session::Change change = session.replaceGround(next, progress);
    EXPECT_FALSE(change.cells.empty());
    Session anew = sessionOf(ground, settings);
    anew.replaceGround(next, progress);
    anew.apply(strokes, progress);
    EXPECT_EQ(differenceOf(session.field(), anew.field()), "");
    session.replaceGround(ground, progress);
    EXPECT_EQ(differenceOf(session.field(), fieldWith(ground, settings, strokes)), "");
}

} // namespace
} // namespace sward::bake
