#include "apps/common/temporary_folder.h"
#include "apps/sward_view/paint/stroke_list.h"
#include "core/error.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <random>

namespace sward::view {
namespace {

using nlohmann::json;

PaintPoint strokeAt(double x, double z = 0.0)
{
    return {{x, 0.0, z}, {0.0, 1.0, 0.0}};
}

Brush eraser(float radius = 1.0f)
{
    Brush brush;
    brush.kind = PaintKind::erase;
    brush.radius = radius;
    return brush;
}

void addStroke(StrokeList& list, double x)
{
    list.begin(eraser(), strokeAt(x));
    list.finish();
}

TEST(StrokeText, HasTheKeysOfItsKindAndNoOthers)
{
    const std::vector<std::pair<PaintKind, std::vector<const char*>>> own{
        {PaintKind::add, {"ceiling"}},
        {PaintKind::erase, {}},
        {PaintKind::set, {"density"}},
        {PaintKind::smooth, {}},
        {PaintKind::species, {"species"}},
        {PaintKind::height, {"factor"}},
        {PaintKind::dryness, {"share"}},
        {PaintKind::trodden, {"height", "lean"}},
        {PaintKind::clear, {}}};
    ASSERT_EQ(own.size(), paintKinds);
    for (const auto& [kind, keys] : own) {
        Brush brush;
        brush.kind = kind;
        brush.species = "a \"daisy\"";
        const json stroke = json::parse(strokeText(brush, {strokeAt(1.0), strokeAt(2.5)}));
        EXPECT_EQ(stroke.size(), 6 + keys.size()) << stroke;
        EXPECT_EQ(stroke["kind"], paintKindNames[static_cast<std::size_t>(kind)]);
        EXPECT_EQ(stroke["points"], json::parse("[[1,0,0],[2.5,0,0]]"));
        EXPECT_EQ(stroke["normals"], json::parse("[[0,1,0]]")) << "one for all";
        for (const char* key : keys)
            EXPECT_TRUE(stroke.contains(key)) << key;
    }
}

TEST(StrokeText, TellsANormalForEachPointWhereTheyDiffer)
{
    const PaintPoint side{{5.0, 0.0, 0.0}, {1.0, 0.0, 0.0}};
    const json stroke = json::parse(strokeText(eraser(), {strokeAt(0.0), side}));
    EXPECT_EQ(stroke["normals"], json::parse("[[0,1,0],[1,0,0]]"));
}

TEST(StrokeText, RoundsToMillimetresAndKeepsLargeNumbers)
{
    const json stroke =
        json::parse(strokeText(eraser(), {{{-123456789.98765, -0.0001, 0.0004}, {0, 1, 0}}}));
    EXPECT_EQ(stroke["points"], json::parse("[[-123456789.988,0,0]]"));
}

TEST(Simplified, NoPointIsFartherAwayThanTheTolerance)
{
    std::mt19937 random(7);
    std::uniform_real_distribution<double> step(-0.4, 0.4);
    std::vector<PaintPoint> points;
    double z = 0.0;
    for (int i = 0; i < 400; ++i)
        points.push_back(strokeAt(0.25 * i, z += step(random)));
    const auto kept = simplified(points, 0.3);
    EXPECT_LT(kept.size(), points.size() / 2);
    EXPECT_EQ(kept.front().place, points.front().place);
    EXPECT_EQ(kept.back().place, points.back().place);
    for (const PaintPoint& point : points) {
        double nearest = 1e9;
        for (std::size_t i = 0; i + 1 < kept.size(); ++i)
            for (int k = 0; k <= 200; ++k)
                nearest = std::min(
                    nearest, glm::distance(point.place,
                                           glm::mix(kept[i].place, kept[i + 1].place, k / 200.0)));
        EXPECT_LE(nearest, 0.3 + 0.02);
    }
}

TEST(StrokeList, ALongStrokeTakesAtMostTwoKilobytes)
{
    StrokeList list;
    list.begin(eraser(), strokeAt(0.0));
    for (int i = 1; i < 4000; ++i)
        list.extend(strokeAt(0.05 * i, 8.0 * std::sin(0.01 * i)));
    EXPECT_LT(list.grownPoints(), 1400u) << "resampled to a quarter of the radius";
    list.finish();
    ASSERT_EQ(list.entries().size(), 1u);
    EXPECT_LE(list.entries()[0].text.size(), strokeBytes);
}

TEST(StrokeList, PointsNearTheLastAreLeftOut)
{
    StrokeList list;
    list.begin(eraser(2.0f), strokeAt(0.0));
    const auto before = list.revision();
    EXPECT_FALSE(list.extend(strokeAt(0.49)));
    EXPECT_EQ(list.revision(), before) << "nothing new to be sent";
    EXPECT_TRUE(list.extend(strokeAt(0.51)));
    EXPECT_NE(list.revision(), before);
    EXPECT_EQ(list.grownPoints(), 2u);
}

TEST(StrokeList, TheGrowingStrokeIsVisibleAndBecomesTheLastWithTheSameText)
{
    StrokeList list;
    addStroke(list, 0.0);
    list.begin(eraser(), strokeAt(5.0));
    list.extend(strokeAt(6.0));
    EXPECT_EQ(list.finished().size(), 1u);
    const auto growing = list.visible();
    ASSERT_EQ(growing.size(), 2u);
    list.finish();
    EXPECT_EQ(list.visible(), growing);
    EXPECT_EQ(list.finished(), growing);
}

TEST(StrokeList, UndoAndRedoLeadThroughEveryStateForAnySequence)
{
    std::mt19937 random(11);
    for (int run = 0; run < 50; ++run) {
        StrokeList list;
        std::vector<std::vector<std::string>> states{list.visible()};
        std::size_t now = 0;
        for (int i = 0; i < 60; ++i) {
            const auto count = list.entries().size();
            switch (random() % 6) {
            case 0:
                EXPECT_EQ(list.undo(), now > 0);
                now -= now > 0 ? 1u : 0u;
                break;
            case 1:
                EXPECT_EQ(list.redo(), now + 1 < states.size());
                now += now + 1 < states.size() ? 1u : 0u;
                break;
            case 5:
                if (count == 0)
                    continue;
                list.rename(random() % count, "name " + std::to_string(i));
                states.resize(++now);
                states.push_back(list.visible());
                break;
            case 2:
                if (count == 0)
                    continue;
                list.remove(random() % count);
                states.resize(++now);
                states.push_back(list.visible());
                break;
            case 3: {
                if (count == 0)
                    continue;
                const std::size_t index = random() % count;
                list.setVisible(index, !list.entries()[index].visible);
                states.resize(++now);
                states.push_back(list.visible());
                break;
            }
            default:
                addStroke(list, i);
                states.resize(++now);
                states.push_back(list.visible());
            }
            ASSERT_EQ(list.visible(), states[now]);
            ASSERT_EQ(list.canUndo(), now > 0);
            ASSERT_EQ(list.canRedo(), now + 1 < states.size());
        }
    }
}

TEST(StrokeList, IsUnsavedUntilTheSameStrokesAreThereAgain)
{
    StrokeList list;
    EXPECT_FALSE(list.isUnsaved());
    addStroke(list, 1.0);
    EXPECT_TRUE(list.isUnsaved());
    list.setSaved(list.finishedRevision());
    EXPECT_FALSE(list.isUnsaved());
    addStroke(list, 2.0);
    EXPECT_TRUE(list.isUnsaved());
    list.undo();
    EXPECT_FALSE(list.isUnsaved()) << "as it was saved";
    list.undo();
    EXPECT_TRUE(list.isUnsaved());
    list.redo();
    EXPECT_FALSE(list.isUnsaved());
    list.setVisible(0, false);
    EXPECT_TRUE(list.isUnsaved());
}

TEST(StrokeList, TellsKindPlaceAndSizeOfEachStroke)
{
    StrokeList list;
    list.draw(eraser(2.0f), {strokeAt(1.0), strokeAt(5.0), strokeAt(5.0, 3.0)});
    const StrokeList::Entry& entry = list.entries().at(0);
    EXPECT_EQ(entry.kind, "erase");
    EXPECT_EQ(entry.radius, 2.0);
    EXPECT_NEAR(entry.length, 7.0, 0.01);
    EXPECT_EQ(entry.middle, glm::dvec3(3.0, 0.0, 1.5));
    EXPECT_EQ(entry.name, "");
    const std::string before = entry.text;
    list.rename(0, "a \"path\"");
    EXPECT_EQ(list.entries()[0].name, "a \"path\"");
    EXPECT_EQ(sketchOf(list.entries()[0].text).points.size(), sketchOf(before).points.size());
    EXPECT_TRUE(list.isUnsaved());
    list.rename(0, "");
    EXPECT_EQ(list.entries()[0].text, before);
    list.undo();
    EXPECT_EQ(list.entries()[0].name, "a \"path\"");
    list.undo();
    EXPECT_EQ(list.entries()[0].text, before);
}

TEST(StrokeList, SeveralStrokesAreReplacedAndBroughtBackTogether)
{
    StrokeList list;
    for (int i = 0; i < 3; ++i)
        addStroke(list, i);
    const auto before = list.visible();
    list.setVisible(1, false);
    list.replace({{0, before[2]}, {1, before[0]}, {2, before[2]}});
    EXPECT_EQ(list.visible(), (std::vector<std::string>{before[2], before[2]}));
    EXPECT_EQ(list.entries()[1].text, before[0]);
    EXPECT_FALSE(list.entries()[1].visible);
    list.undo();
    list.undo();
    EXPECT_EQ(list.visible(), before);
    list.redo();
    list.redo();
    EXPECT_EQ(list.visible().size(), 2u);
}

TEST(StrokeList, KnowsWhereTheLastStrokeEnded)
{
    StrokeList list;
    EXPECT_FALSE(list.end().has_value());
    list.begin(eraser(), strokeAt(1.0));
    list.extend(strokeAt(4.0));
    list.finish();
    ASSERT_TRUE(list.end().has_value());
    EXPECT_EQ(list.end()->place.x, 4.0);
    list.draw(eraser(), {*list.end(), strokeAt(8.0)});
    EXPECT_EQ(list.end()->place.x, 8.0);
    EXPECT_EQ(list.entries().size(), 2u);
    list.undo();
    EXPECT_FALSE(list.end().has_value());
}

TEST(PaintKinds, HaveAWordOfTheirOwnInThePanel)
{
    for (std::size_t i = 0; i < paintKinds; ++i) {
        EXPECT_EQ(wordOfKind(paintKindNames[i]), paintKindWords[i]);
        for (std::size_t j = 0; j < i; ++j)
            EXPECT_STRNE(paintKindWords[i], paintKindWords[j]);
    }
    EXPECT_EQ(wordOfKind("mow"), "mow");
}

TEST(StrokeFile, IsReadBackAsItWasWritten)
{
    const apps::TemporaryFolder folder{"sward-view"};
    StrokeList list;
    addStroke(list, 1.0);
    addStroke(list, 2.0);
    const auto path = folder.path() / "a.json";
    std::ofstream(path) << strokeFileText(list.finished());
    EXPECT_EQ(readStrokeFile(path), list.finished());
    EXPECT_EQ(sketchOf(readStrokeFile(path)[0]).kind, "erase");
    std::ofstream(path) << strokeFileText({});
    EXPECT_TRUE(readStrokeFile(path).empty());
}

TEST(StrokeFile, OtherFilesAreRefused)
{
    const apps::TemporaryFolder folder{"sward-view"};
    const auto path = folder.path() / "a.json";
    EXPECT_THROW(readStrokeFile(path), Error) << "missing";
    for (const char* text :
         {"", "[]", "{", "{\"format\":\"sward strokes 2\",\"strokes\":[]}",
          "{\"format\":\"sward strokes 1\"}", "{\"format\":\"sward strokes 1\",\"strokes\":3}",
          "{\"strokes\":[]}", "{\"format\":\"sward strokes 1\",\"strokes\":[{}],\"strokes\":[]}"}) {
        std::ofstream(path) << text;
        EXPECT_THROW(readStrokeFile(path), Error) << text;
    }
    for (const char* text : {"", "3", "[]", "{}", "{\"kind\":3}"})
        EXPECT_EQ(sketchOf(text).kind, "") << text;
}

} // namespace
} // namespace sward::view
