#include "bake/patches/patch_tree.h"
#include "bake/session/session.h"
#include "bake/whole/whole_bake.h"
#include "core/error.h"
#include "core/random.h"
#include "support/meshes.h"
#include "terrain/load.h"
#include "terrain/procedural/landforms.h"
#include "terrain/topology/topology.h"
#include "unit/bake/bake_settings.h"
#include "unit/bake/paint/strokes.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <iterator>
#include <map>
#include <utility>

namespace sward::bake {
namespace {

template <typename T>
bool areSameBytes(const T& a, const T& b)
{
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])) == 0;
}

void expectSameField(const field::Field& a, const field::Field& b)
{
    EXPECT_TRUE(areSameBytes(a.blades, b.blades));
    EXPECT_TRUE(areSameBytes(a.keys, b.keys));
    EXPECT_TRUE(areSameBytes(a.patches, b.patches));
    EXPECT_EQ(a.provenance, b.provenance);
}

// A session with all that it needs.
struct Opened {
    Opened(const terrain::GroundMesh& ground, const BakeSettings& settings,
           const field::FieldView* baked = nullptr)
        : session(ground, settings, 2, diagnostics, progress, baked)
    {
    }

    Diagnostics diagnostics;
    Progress progress;
    Session session;
};

BakeSettings sessionSettings(double density)
{
    BakeSettings settings = tests::plainSettings(density);
    settings.meadow.clumpSize = 1.5;
    settings.meadow.heightWaves = 0.15;
    settings.meadow.drifts = 0.8;
    settings.meadow.species.resize(2);
    settings.meadow.species[0].tuftSpacing = 0.8;
    settings.meadow.species[1].habitat.slope = {0.0, 20.0, 10.0};
    settings.slope = {0.0, 70.0, 20.0};
    return settings;
}

// A stroke of any kind from a place of the ground, a few metres along it.
Stroke randomStroke(const terrain::GroundMesh& ground, std::uint64_t seed)
{
    const auto random = [&](std::uint32_t dimension) { return uniform(seed, 0, dimension); };
    const auto vertex = static_cast<std::size_t>(random(0) * double(ground.positions.size()));
    const glm::dvec3 from = ground.origin + glm::dvec3(ground.positions[vertex]);
    const glm::dvec3 along(random(1) - 0.5, 0.0, random(2) - 0.5);
    const auto kind = static_cast<StrokeKind>(int(random(3) * 9.0));
    constexpr double values[] = {2.5, 1.0, 0.4, 1.0, 1.0, 1.7, 0.6, 0.4, 1.0};
    Stroke stroke = tests::hardStroke(kind, {from, from + 8.0 * along, from + 20.0 * along},
                                      1.0 + 5.0 * random(4), values[static_cast<int>(kind)]);
    if (kind == StrokeKind::smooth)
        stroke.radius = 25.0;
    stroke.hardness = random(5);
    stroke.slot = 1;
    stroke.normals.clear();
    return stroke;
}

struct Case {
    const char* name;
    terrain::GroundMesh ground;
    Spread spread = Spread::uniform;
    bool counts = false;
    double density = 1.5;
};

std::vector<Case> grounds()
{
    Diagnostics diagnostics;
    std::vector<Case> cases;
    cases.push_back({"hills", meshes::hills(150.0, 60)});
    cases.push_back({"sphere", meshes::sphere(48, 22.0)});
    cases.push_back({"counted", meshes::hills(120.0, 50), Spread::uniform, true});
    cases.push_back({"disks", meshes::hills(100.0, 40), Spread::poisson});
    cases.push_back({"arch", terrain::makeArch(), Spread::uniform, false, 12.0});
    cases.push_back({"landscape",
                     terrain::load(SWARD_ASSETS "/meshes/landscape.glb", {}, diagnostics),
                     Spread::uniform, false, 4.0});
    cases.push_back({"wall", meshes::grid(30, 90.0)});
    append(cases.back().ground, meshes::moved(meshes::cube(20.0), {10.0, 5.0, 30.0}));
    std::fill(cases.back().ground.bears.end() - 12, cases.back().ground.bears.end(),
              std::uint8_t(0));
    return cases;
}

// The bake in tiles of about two thousand blades.
field::Field bakedInTiles(const terrain::GroundMesh& ground, const BakeSettings& settings)
{
    field::Field field;
    std::vector<CellTree> cells;
    std::size_t tiles = 0;
    CellTakers takers;
    takers.begin = [](bool inTiles) { EXPECT_TRUE(inTiles); };
    takers.take = [&](TileResult&& tile) {
        ++tiles;
        std::move(tile.cells.begin(), tile.cells.end(), std::back_inserter(cells));
    };
    takers.finish = [&](field::Field&& bare) {
        field = std::move(bare);
        joinCells(std::move(cells), field);
    };
    Diagnostics diagnostics;
    Progress progress;
    bakeWhole(ground, settings, 2, {0.0, 2'000.0}, takers, diagnostics, progress);
    EXPECT_GT(tiles, 1U);
    return field;
}

// Strokes, undone and done again, in random order: the field is that of a whole bake.
TEST(Session, IsAlwaysAWholeBakeOfItsStrokes)
{
    const char* const wish = std::getenv("SWARD_SESSION_SEQUENCES");
    const int sequences = wish != nullptr ? std::atoi(wish) : 1;
    for (const Case& one : grounds()) {
        SCOPED_TRACE(one.name);
        BakeSettings settings = sessionSettings(one.density);
        settings.spread = one.spread;
        if (one.counts) {
            settings.density.reset();
            settings.count = 20'000;
        }
        if (one.ground.bears.back() == 0)
            settings.exposureRays = 2;
        Opened opened(one.ground, settings);
        auto& [diagnostics, progress, session] = opened;
        expectSameField(session.field(), tests::paintedField(one.ground, settings).field);
        const std::size_t all = session.cells().size();
        std::size_t cells = 0;
        std::size_t changes = 0;
        for (int sequence = 0; sequence < sequences; ++sequence) {
            Strokes done;
            std::vector<Stroke> undone;
            for (std::uint64_t step = 0; step < 6; ++step) {
                const std::uint64_t seed =
                    hashBits(std::uint64_t(sequence) * 100 + step, std::uint64_t(one.name[0]));
                const double draw = uniform(seed, 1, 0);
                if (draw < 0.25 && !done.list.empty()) {
                    // Any of them, not only the last.
                    const auto at =
                        done.list.begin() +
                        static_cast<std::ptrdiff_t>(uniform(seed, 1, 1) * double(done.list.size()));
                    undone.push_back(*at);
                    done.list.erase(at);
                } else if (draw < 0.4 && !undone.empty()) {
                    done.list.push_back(undone.back());
                    undone.pop_back();
                } else {
                    done.list.push_back(randomStroke(one.ground, seed));
                }
                cells += session.apply(done, progress).cells.size();
                ++changes;
            }
            settings.strokes = done;
            const field::Field field = session.field();
            for (const int threads : {1, 2, 7})
                expectSameField(field, tests::paintedField(one.ground, settings, threads).field);
            expectSameField(field, bakedInTiles(one.ground, settings));
        }
        // Ground of few cells is soon all of it reached.
        EXPECT_TRUE(all <= 15 || double(cells) < 0.7 * double(all * changes)) << cells;
    }
}

TEST(Session, BakesNothingWhereNothingChanges)
{
    const terrain::GroundMesh ground = meshes::hills(150.0, 60);
    BakeSettings settings = sessionSettings(1.5);
    settings.strokes = tests::laidOn(ground, tests::allKinds());
    Opened opened(ground, settings);
    auto& [diagnostics, progress, session] = opened;
    EXPECT_TRUE(session.apply(settings.strokes, progress).cells.empty());
    Strokes far = settings.strokes;
    far.list.push_back(tests::hardStroke(StrokeKind::erase, {{5000.0, 0.0, 0.0}}, 3.0));
    EXPECT_TRUE(session.apply(far, progress).cells.empty());
    EXPECT_EQ(session.strokes().list.size(), far.list.size());
    // A look is changed in the cells that it touches alone.
    Strokes look = far;
    look.list.push_back(
        tests::laidOn(ground,
                      {"", {tests::hardStroke(StrokeKind::height, {{16.0, 0.0, 16.0}}, 1.0, 2.0)}})
            .list[0]);
    const Session::Change change = session.apply(look, progress);
    EXPECT_LE(change.cells.size(), 2U);
    EXPECT_GT(change.blades, 1000U);
}

TEST(Session, StaysAsItWasWhenAChangeIsCancelled)
{
    const terrain::GroundMesh ground = meshes::hills(100.0, 40);
    const BakeSettings settings = sessionSettings(1.5);
    Opened opened(ground, settings);
    auto& [diagnostics, progress, session] = opened;
    const field::Field before = session.field();
    Strokes strokes;
    strokes.list = {tests::hardStroke(StrokeKind::set, {{0.0, 0.0, 0.0}}, 30.0, 0.2)};
    Progress cancelled;
    cancelled.cancel();
    EXPECT_THROW(session.apply(strokes, cancelled), Error);
    expectSameField(session.field(), before);
    EXPECT_TRUE(session.strokes().empty());
    session.apply(strokes, progress);
    EXPECT_LT(session.field().blades.size(), before.blades.size());
    session.apply({}, progress);
    expectSameField(session.field(), before);
}

// A session that begins with a baked field is one that has baked it.
TEST(Session, GoesOnFromABakedField)
{
    const terrain::GroundMesh ground = meshes::hills(150.0, 60);
    BakeSettings settings = sessionSettings(1.5);
    settings.strokes = tests::laidOn(ground, tests::allKinds());
    const field::Field baked = tests::paintedField(ground, settings).field;
    const field::FieldView view = field::viewOf(baked);
    Opened opened(ground, settings, &view);
    auto& [diagnostics, progress, session] = opened;
    EXPECT_TRUE(session.hasReused());
    EXPECT_TRUE(diagnostics.warnings().empty());
    expectSameField(session.field(), baked);
    settings.strokes.list.push_back(tests::hardStroke(StrokeKind::set, {{0, 0, 0}}, 20.0, 0.3));
    session.apply(settings.strokes, progress);
    expectSameField(session.field(), tests::paintedField(ground, settings).field);

    // Blades of other strokes or without keys are of no use.
    Session other(ground, settings, 2, diagnostics, progress, &view);
    EXPECT_FALSE(other.hasReused());
    EXPECT_EQ(diagnostics.warnings().size(), 1U);
    expectSameField(other.field(), session.field());
    field::FieldView without = view;
    without.keys = {};
    settings.strokes.list.pop_back();
    EXPECT_FALSE(Session(ground, settings, 2, diagnostics, progress, &without).hasReused());
    EXPECT_EQ(diagnostics.warnings().size(), 2U);
}

// The ground with its vertices within 12 m of one of them moved along their normals, up to 2 m in
// the middle, and with normals that fit.
terrain::GroundMesh sculpted(const terrain::GroundMesh& ground, std::size_t middle)
{
    terrain::GroundMesh next = ground;
    for (std::size_t v = 0; v < next.positions.size(); ++v) {
        const float near =
            1.0f - glm::length(ground.positions[v] - ground.positions[middle]) / 12.0f;
        if (near > 0.0f)
            next.positions[v] += 2.0f * near * near * ground.normals[v];
    }
    const std::vector<glm::vec3> normals = next.normals;
    terrain::computeNormals(next, terrain::analyse(next));
    for (std::size_t v = 0; v < normals.size(); ++v) // some may be doubled, at creases
        if (glm::length(ground.positions[v] - ground.positions[middle]) > 25.0f)
            next.normals[v] = normals[v];
    return next;
}

void expectCellsOutside(const std::map<CellNumber, CellTree>& before, const Session& session,
                        const Session::Change& change)
{
    for (const auto& [number, cell] : session.cells()) {
        if (std::binary_search(change.cells.begin(), change.cells.end(), number))
            continue;
        ASSERT_EQ(before.count(number), 1U);
        EXPECT_TRUE(areSameBytes(before.at(number).blades, cell.blades));
    }
}

// Sculpted ground is baked as if it had been so from the beginning, and only near what was moved.
TEST(Session, BakesReplacedGroundAgainWhereItDiffers)
{
    for (const Case& one : grounds()) {
        if (one.counts)
            continue; // the count of other ground is another plan
        SCOPED_TRACE(one.name);
        BakeSettings settings = sessionSettings(one.density);
        settings.spread = one.spread;
        settings.exposureRays = one.ground.bears.back() == 0 ? 2 : 0;
        settings.border = {1.0, 1000.0, 0.5};
        settings.meadow.edges.pathReach = 2.0;
        settings.strokes.list = {randomStroke(one.ground, 3), randomStroke(one.ground, 4)};
        Opened opened(one.ground, settings);
        auto& [diagnostics, progress, session] = opened;
        const auto before = session.cells();
        const field::Field first = session.field();
        const terrain::GroundMesh next = sculpted(one.ground, one.ground.positions.size() / 3);
        ASSERT_EQ(next.origin, one.ground.origin);
        const Session::Change change = session.replaceGround(next, progress);
        expectSameField(session.field(), tests::paintedField(next, settings).field);
        EXPECT_GT(change.cells.size(), 0U);
        expectCellsOutside(before, session, change);
        // Strokes lie on the new ground from then on.
        BakeSettings more = settings;
        more.strokes.list.push_back(randomStroke(next, 5));
        session.apply(more.strokes, progress);
        expectSameField(session.field(), tests::paintedField(next, more, 7).field);
        session.apply(settings.strokes, progress);
        // The same cells change back.
        EXPECT_EQ(session.replaceGround(one.ground, progress).cells, change.cells);
        expectSameField(session.field(), first);
        EXPECT_TRUE(session.replaceGround(one.ground, progress).cells.empty());
    }
}

TEST(Session, LeavesCellsFarFromSculptedGroundAlone)
{
    const terrain::GroundMesh ground = meshes::hills(400.0, 120);
    const BakeSettings settings = sessionSettings(0.3);
    Opened opened(ground, settings);
    auto& [diagnostics, progress, session] = opened;
    const std::size_t all = session.cells().size();
    const terrain::GroundMesh next = sculpted(ground, ground.positions.size() / 3);
    const Session::Change change = session.replaceGround(next, progress);
    EXPECT_LT(change.cells.size(), all / 4) << all;
    expectSameField(session.field(), tests::paintedField(next, settings).field);
}

TEST(Session, BakesAllOfReplacedGroundOfAnotherOriginOrMaterial)
{
    const terrain::GroundMesh ground = meshes::hills(100.0, 40);
    const BakeSettings settings = sessionSettings(1.5);
    Opened opened(ground, settings);
    auto& [diagnostics, progress, session] = opened;
    const std::size_t all = session.cells().size();
    terrain::GroundMesh painted = ground;
    painted.materials[0].baseColor = {0.2f, 0.1f, 0.05f, 1.0f};
    EXPECT_GE(session.replaceGround(painted, progress).cells.size(), all);
    expectSameField(session.field(), tests::paintedField(painted, settings).field);
    const terrain::GroundMesh elsewhere = meshes::moved(ground, {64.0, 0.0, 0.0});
    ASSERT_NE(elsewhere.origin, ground.origin);
    const Session::Change change = session.replaceGround(elsewhere, progress);
    EXPECT_GT(change.cells.size(), all);
    EXPECT_EQ(session.deltaOf(change.cells).origin, elsewhere.origin);
    expectSameField(session.field(), tests::paintedField(elsewhere, settings).field);
}

TEST(Session, StaysAsItWasWhenGroundDoesNotReplaceIt)
{
    const terrain::GroundMesh ground = meshes::hills(100.0, 40);
    const BakeSettings settings = sessionSettings(1.5);
    Opened opened(ground, settings);
    auto& [diagnostics, progress, session] = opened;
    const field::Field before = session.field();
    const terrain::GroundMesh finer = meshes::hills(100.0, 41);
    EXPECT_THROW(session.replaceGround(finer, progress), Error);
    const terrain::GroundMesh next = sculpted(ground, 800);
    Progress cancelled;
    cancelled.cancel();
    EXPECT_THROW(session.replaceGround(next, cancelled), Error);
    EXPECT_EQ(&session.ground(), &ground);
    expectSameField(session.field(), before);
}

// A receiver that knows only the first field and the deltas has the session's blades.
TEST(Session, TellsAllThatChangesByDeltas)
{
    const terrain::GroundMesh ground = meshes::hills(150.0, 60);
    const BakeSettings settings = sessionSettings(1.5);
    Opened opened(ground, settings);
    auto& [diagnostics, progress, session] = opened;
    const auto keysOf = [](const auto& keys) {
        std::vector<std::uint64_t> ids;
        for (const field::BladeKey& key : keys)
            ids.push_back(field::bladeId(key));
        return ids;
    };
    std::map<CellNumber, std::vector<std::uint64_t>> received;
    for (const auto& [number, cell] : session.cells())
        received[number] = keysOf(cell.keys);
    Strokes strokes;
    for (std::uint64_t step = 0; step < 4; ++step) {
        strokes.list.push_back(randomStroke(ground, 7 + step));
        if (step == 2) // a whole cell goes bare, and comes back
            strokes.list.push_back(tests::hardStroke(StrokeKind::erase, {{-48, 0, -48}}, 60.0));
        if (step == 3)
            strokes.list.erase(strokes.list.begin() + 3);
        const Session::Change change = session.apply(strokes, progress);
        const field::Delta delta = session.deltaOf(change.cells);
        std::size_t blades = 0;
        for (const field::CellChange& cell : delta.cells) {
            blades += cell.blades.size();
            if (cell.patches.empty())
                received.erase(cell.cell);
            else
                received[cell.cell] = keysOf(cell.keys);
        }
        EXPECT_EQ(blades, change.blades);
        ASSERT_EQ(received.size(), session.cells().size());
        for (const auto& [number, cell] : session.cells())
            EXPECT_EQ(received[number], keysOf(cell.keys));
    }
}

} // namespace
} // namespace sward::bake
