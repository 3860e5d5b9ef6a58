#include "bake/paint/stroke_contact.h"
#include "bake/paint/stroke_move.h"
#include "bake/session/session.h"
#include "support/meshes.h"
#include "unit/bake/bake_settings.h"
#include "unit/bake/paint/strokes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace sward::bake {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;

constexpr StrokeKind erases = StrokeKind::erase;

Stroke strokeThrough(const std::vector<glm::dvec3>& points, double radius = 1.0)
{
    return tests::hardStroke(erases, points, radius);
}

std::vector<StrokeContact> contactsWith(const terrain::GroundMesh& ground,
                                        const std::vector<Stroke>& strokes)
{
    return contactsOf(ground, Sides::front, strokes);
}

// Whether a stroke changes any root of a dense bake.
bool paints(const terrain::GroundMesh& ground, const Stroke& stroke, double density)
{
    BakeSettings settings = tests::plainSettings(density);
    const std::size_t before = tests::paintedRoots(ground, settings).roots.size();
    settings.strokes.list = {stroke};
    return tests::paintedRoots(ground, settings).roots.size() != before;
}

TEST(StrokeContact, TellsHowMuchOfAStrokeTouchesGround)
{
    const terrain::GroundMesh ground = meshes::square(20.0);
    const auto contacts =
        contactsWith(ground, {strokeThrough({{-5.0, 0.5, 0.0}, {5.0, 0.5, 0.0}}),
                              strokeThrough({{-5.0, 2.0, 0.0}, {5.0, 2.0, 0.0}}),
                              strokeThrough({{0.0, 0.0, 0.0}, {0.0, 1.5, 0.0}, {0.0, 3.0, 0.0}}),
                              strokeThrough({{-9.0, 5.0, 0.0}, {0.0, -4.0, 0.0}})});
    EXPECT_EQ(contacts[0].lost(), 0u);
    EXPECT_FALSE(contacts[0].isWorthTelling());
    EXPECT_TRUE(contacts[1].isLost());
    EXPECT_EQ(contacts[1].lostPoints, 2u);
    EXPECT_EQ(contacts[2].points, 3u);
    EXPECT_EQ(contacts[2].lostPoints, 2u);
    EXPECT_FALSE(contacts[2].isLost());
    EXPECT_TRUE(contacts[2].isWorthTelling());
    EXPECT_EQ(contacts[3].lostPoints, 2u);
    EXPECT_FALSE(contacts[3].isLost()) << "its middle crosses the ground";
}

TEST(StrokeContact, AStrokeIsLostIfAndOnlyIfItPaintsNothing)
{
    std::mt19937 random(3);
    std::uniform_real_distribution<double> place(-14.0, 14.0);
    std::uniform_real_distribution<double> height(-3.0, 3.0);
    const terrain::GroundMesh ground = meshes::hills(20.0, 10);
    std::size_t lost = 0;
    for (int i = 0; i < 60; ++i) {
        Stroke stroke = strokeThrough({{place(random), height(random), place(random)}}, 1.5);
        if (i % 3 == 0)
            stroke.depth = 0.4;
        const bool isLost = contactsWith(ground, {stroke})[0].isLost();
        lost += isLost ? 1u : 0u;
        // A stroke that grazes the ground may miss every root.
        Stroke wider = stroke;
        wider.radius += 0.15;
        wider.depth += stroke.depth > 0.0 ? 0.15 : 0.0;
        if (isLost)
            EXPECT_FALSE(paints(ground, stroke, 200.0)) << i;
        else
            EXPECT_TRUE(paints(ground, wider, 200.0)) << i;
    }
    EXPECT_GT(lost, 10u);
    EXPECT_LT(lost, 50u);
}

TEST(StrokeContact, OnlyBearingTrianglesThatFaceItsWayCount)
{
    terrain::GroundMesh ground = meshes::square(20.0);
    Stroke down = strokeThrough({{0.0, 0.0, 0.0}});
    down.normals = {{0, -1000, 0}};
    Stroke any = down;
    any.normals.clear();
    const std::vector<Stroke> strokes{down, any};
    EXPECT_TRUE(contactsWith(ground, strokes)[0].isLost());
    EXPECT_FALSE(contactsWith(ground, strokes)[1].isLost());
    EXPECT_FALSE(contactsOf(ground, Sides::back, strokes)[0].isLost());
    EXPECT_FALSE(contactsOf(ground, Sides::both, strokes)[0].isLost());
    std::fill(ground.bears.begin(), ground.bears.end(), std::uint8_t(0));
    EXPECT_TRUE(contactsWith(ground, strokes)[1].isLost());
}

TEST(StrokeContact, ManyWideStrokesOnManyTrianglesAreFoundSoon)
{
    const terrain::GroundMesh ground = meshes::grid(200, 100.0);
    std::vector<Stroke> strokes;
    for (int i = 0; i < 2000; ++i)
        strokes.push_back(strokeThrough({{0.01 * i, 0.0, 0.0}, {0.0, 0.0, 0.01 * i}}, 60.0));
    strokes.push_back(strokeThrough({{0.0, 500.0, 0.0}}));
    const auto contacts = contactsWith(ground, strokes);
    EXPECT_TRUE(contacts.back().isLost());
    EXPECT_TRUE(std::none_of(contacts.begin(), contacts.end() - 1,
                             [](const StrokeContact& one) { return one.lost() > 0; }));
}

TEST(StrokeContact, AWarningNamesTheStrokesAndTheShareOfPoints)
{
    std::vector<Stroke> strokes{strokeThrough({{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}}),
                                strokeThrough({{0.0, 9.0, 0.0}}),
                                strokeThrough({{0.0, 0.0, 0.0}, {0.0, 9.0, 0.0}})};
    strokes[1].name = "Path";
    Diagnostics diagnostics;
    warnOfContacts(strokes, contactsWith(meshes::square(20.0), strokes), 4, "strokes.json", "Move.",
                   diagnostics);
    ASSERT_THAT(diagnostics.warnings(), SizeIs(2));
    EXPECT_THAT(diagnostics.warnings()[0], HasSubstr("1 of 3 strokes touch no ground"));
    EXPECT_THAT(diagnostics.warnings()[0], HasSubstr("strokes[5] \"Path\"; 40 % of all points"));
    EXPECT_THAT(diagnostics.warnings()[1], HasSubstr("strokes[6] (1 of 2 points)"));
}

TEST(MoveOnto, PointsOnTheGroundStayAndTwiceIsOnce)
{
    const terrain::GroundMesh ground = meshes::hills(24.0, 12);
    const Strokes near = tests::laidOn(ground, tests::allKinds());
    const std::vector<Stroke> laid = moveOnto(ground, Sides::front, near.list, 5.0).list;
    const MovedStrokes same = moveOnto(ground, Sides::front, laid, 5.0);
    EXPECT_TRUE(same.moved.empty());
    EXPECT_TRUE(same.list == laid);
    const terrain::GroundMesh sunk = meshes::moved(ground, {0.0, -1.7, 0.0});
    const MovedStrokes once = moveOnto(sunk, Sides::front, laid, 5.0);
    EXPECT_EQ(once.moved.size(), laid.size());
    const MovedStrokes twice = moveOnto(sunk, Sides::front, once.list, 5.0);
    EXPECT_TRUE(twice.moved.empty());
}

TEST(MoveOnto, AFieldOfSunkGroundIsThatOfTheGroundAgain)
{
    const terrain::GroundMesh ground = meshes::grid(12, 24.0);
    BakeSettings settings = tests::plainSettings(60.0);
    settings.strokes = tests::laidOn(ground, tests::allKinds());
    const std::size_t wanted = tests::paintedRoots(ground, settings).roots.size();
    const terrain::GroundMesh sunk = meshes::moved(ground, {0.0, -4.0, 0.0});
    const Strokes strokes = settings.strokes;
    settings.strokes.list = moveOnto(sunk, Sides::front, strokes.list, 4.5).list;
    EXPECT_EQ(tests::paintedRoots(sunk, settings).roots.size(), wanted);
    settings.strokes = strokes;
    EXPECT_NE(tests::paintedRoots(sunk, settings).roots.size(), wanted);
    // Out of the distance nothing moves.
    EXPECT_TRUE(moveOnto(sunk, Sides::front, strokes.list, 3.5).moved.empty());
}

TEST(MoveOnto, AStrokeGoesToTheSurfaceThatFacesItsWay)
{
    // The lower face of the box is nearer, and looks down.
    const terrain::GroundMesh ground = meshes::boxAbovePlane();
    const MovedStrokes moved =
        moveOnto(ground, Sides::front, std::vector<Stroke>{strokeThrough({{0.0, 0.7, 0.0}})}, 2.0);
    EXPECT_EQ(moved.list[0].points[0], (std::array<std::int64_t, 3>{0, 0, 0}));
    EXPECT_EQ(moved.points, 1u);
    EXPECT_NEAR(moved.farthest, 0.7, 1e-6);
    Stroke any = strokeThrough({{0.0, 0.7, 0.0}});
    any.normals.clear();
    EXPECT_EQ(moveOnto(ground, Sides::front, std::vector<Stroke>{any}, 2.0).list[0].points[0],
              (std::array<std::int64_t, 3>{0, 1000, 0}));
}

TEST(MoveOnto, AStrokeFollowsGroundThatSankBetweenItsPoints)
{
    terrain::GroundMesh ground = meshes::grid(20, 20.0);
    for (glm::vec3& position : ground.positions)
        if (std::fabs(position.x) < 3.5f)
            position.y = -3.0f;
    const Stroke stroke = strokeThrough({{-8.0, 0.0, 0.0}, {8.0, 0.0, 0.0}});
    const auto before = contactsWith(ground, {stroke});
    EXPECT_EQ(before[0].lostPoints, 0u);
    EXPECT_TRUE(before[0].isWorthTelling());
    const MovedStrokes moved = moveOnto(ground, Sides::front, std::vector<Stroke>{stroke}, 4.0);
    EXPECT_THAT(moved.moved, ElementsAre(0u));
    EXPECT_EQ(moved.points, 0u);
    EXPECT_GT(moved.list[0].points.size(), 5u);
    EXPECT_FALSE(contactsWith(ground, moved.list)[0].isWorthTelling());
}

TEST(SessionContacts, AreThoseOfTheWholeGround)
{
    const terrain::GroundMesh ground = meshes::grid(30, 150.0);
    Diagnostics diagnostics;
    Progress progress;
    BakeSettings settings = tests::plainSettings(0.5);
    Session session(ground, settings, 2, diagnostics, progress);
    Strokes strokes;
    strokes.list = {strokeThrough({{40.0, 0.0, 40.0}, {-60.0, 0.0, 10.0}}),
                    strokeThrough({{0.0, 1.5, 0.0}}), strokeThrough({{30.0, 0.9, 31.9}}),
                    strokeThrough({{300.0, 0.0, 0.0}})};
    session.apply(strokes, progress);
    const auto found = session.contacts();
    const auto wanted = contactsWith(ground, strokes.list);
    for (std::size_t i = 0; i < wanted.size(); ++i)
        EXPECT_EQ(found[i].lostPlaces, wanted[i].lostPlaces) << i;
    EXPECT_THAT(session.contacts(2), SizeIs(2));
    EXPECT_TRUE(session.contacts(3)[0].isLost());
    // A name changes no blade.
    strokes.list[0].name = "Path";
    EXPECT_TRUE(session.apply(strokes, progress).cells.empty());
    EXPECT_EQ(session.strokes().list[0].name, "Path");
}

} // namespace
} // namespace sward::bake
