#include "apps/sward_view/paint/painter.h"
#include "core/error.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <chrono>
#include <csignal>
#include <fstream>
#include <functional>
#include <iterator>
#include <thread>

namespace sward::view {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

constexpr std::chrono::seconds patience{60};

std::string textOf(const fs::path& path)
{
    std::ifstream in(path);
    return {std::istreambuf_iterator<char>(in), {}};
}

std::vector<std::string> linesOf(const fs::path& path)
{
    std::vector<std::string> lines;
    std::ifstream in(path);
    for (std::string line; std::getline(in, line);)
        lines.push_back(line);
    return lines;
}

/// A session of fake_edit.py, and what it has been asked.
class PainterTest : public testing::Test {
protected:
    std::vector<std::string> command(const char* how) const
    {
        return {SWARD_TEST_PYTHON, SWARD_FAKE_EDIT, how, log.string()};
    }

    /// Polls until `holds`, and keeps the deltas that come.
    void pollUntil(Painter& painter, const std::function<bool()>& holds)
    {
        const auto until = std::chrono::steady_clock::now() + patience;
        do {
            painter.poll([this](const fs::path& delta) { deltas.push_back(textOf(delta)); });
            while (const auto told = painter.takeTold())
                (told->isError ? errors : notices).push_back(told->text);
            if (holds())
                return;
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
        } while (std::chrono::steady_clock::now() < until);
        FAIL() << "waited in vain";
    }

    void waitForStrokes(Painter& painter)
    {
        pollUntil(painter, [&] { return painter.isReady() && painter.isIdle(); });
    }

    static void paint(StrokeList& strokes, double x, PaintKind kind = PaintKind::erase)
    {
        Brush brush;
        brush.kind = kind;
        strokes.begin(brush, {{x, 0.0, 0.0}, {0.0, 1.0, 0.0}});
        strokes.finish();
    }

    /// What the session holds, according to the last delta.
    json held() const { return json::parse(deltas.back()); }

    static json jsonOf(const std::vector<std::string>& texts)
    {
        json list = json::array();
        for (const std::string& text : texts)
            list.push_back(json::parse(text));
        return list;
    }

    apps::TemporaryFolder folder{"sward-view"};
    fs::path log = folder.path() / "asked";
    fs::path autosave = folder.path() / "a.strokes.autosave.json";

    Autosave autosaves() const { return {{"a", "/fields/a.sward", "0123"}, {folder.path()}}; }

    std::vector<std::string> deltas, errors, notices;
};

TEST_F(PainterTest, TellsWhatTheFirstLineSays)
{
    Painter painter(command("good"), {}, autosaves());
    EXPECT_FALSE(painter.isReady());
    waitForStrokes(painter);
    const EditReady& ready = painter.session().ready();
    EXPECT_EQ(ready.species, (std::vector<std::string>{"grass", "clover"}));
    EXPECT_TRUE(ready.reused);
    EXPECT_EQ(ready.warnings.size(), 1u);
    EXPECT_EQ(painter.total(), 100u);
    EXPECT_EQ(painter.session().progress().state, "sampling");
}

TEST_F(PainterTest, TheSessionHoldsTheVisibleStrokesAfterEveryChange)
{
    Painter painter(command("good"), {}, autosaves());
    for (int i = 0; i < 4; ++i)
        paint(painter.strokes, i);
    const auto agrees = [&] {
        waitForStrokes(painter);
        return held() == jsonOf(painter.strokes.visible());
    };
    EXPECT_TRUE(agrees());
    painter.strokes.setVisible(1, false);
    EXPECT_TRUE(agrees());
    painter.strokes.undo();
    EXPECT_TRUE(agrees());
    painter.strokes.undo();
    EXPECT_TRUE(agrees());
    EXPECT_EQ(json::parse(linesOf(log).back())["keep"], 3) << "undo is a smaller keep";
    painter.strokes.redo();
    EXPECT_TRUE(agrees());
    EXPECT_EQ(json::parse(linesOf(log).back())["strokes"].size(), 1u) << "only what is new";
    painter.strokes.remove(0);
    EXPECT_TRUE(agrees());
    EXPECT_EQ(painter.total(), 103u);
    for (const auto& entry : fs::directory_iterator(folder.path()))
        EXPECT_NE(entry.path().extension(), ".delta") << "deltas are removed";
}

TEST_F(PainterTest, OneRequestIsUnderWayAndTheNewestStateFollows)
{
    Painter painter(command("good"), {}, autosaves());
    waitForStrokes(painter);
    Brush brush;
    painter.strokes.begin(brush, {{0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}});
    for (int i = 1; i <= 100; ++i) {
        painter.strokes.extend({{0.3 * i, 0.0, 0.0}, {0.0, 1.0, 0.0}});
        painter.poll([](const fs::path&) {});
    }
    painter.strokes.finish();
    waitForStrokes(painter);
    EXPECT_EQ(held(), jsonOf(painter.strokes.visible()));
    EXPECT_LT(linesOf(log).size(), 50u) << "states between two answers are left out";
}

TEST_F(PainterTest, BeginsWithTheStrokesOfTheField)
{
    Painter painter(command("held"), {"{\"kind\":\"clear\"}", "{\"kind\":\"set\"}"}, autosaves());
    waitForStrokes(painter);
    EXPECT_TRUE(deltas.empty()) << "nothing to be told";
    EXPECT_FALSE(painter.strokes.isUnsaved());
    paint(painter.strokes, 1.0);
    waitForStrokes(painter);
    EXPECT_EQ(json::parse(linesOf(log).back())["keep"], 2);
}

TEST_F(PainterTest, GivesAllStrokesAgainToAFieldThatHasLostThem)
{
    Painter painter(command("good"), {}, autosaves());
    paint(painter.strokes, 1.0);
    paint(painter.strokes, 2.0);
    waitForStrokes(painter);
    painter.repeatAll();
    waitForStrokes(painter);
    const auto asked = linesOf(log);
    EXPECT_EQ(json::parse(asked.at(asked.size() - 2))["keep"], 0);
    EXPECT_EQ(json::parse(asked.at(asked.size() - 2))["strokes"].size(), 0u);
    EXPECT_EQ(held(), jsonOf(painter.strokes.visible()));
}

TEST_F(PainterTest, AStateThatIsRefusedIsToldOnceAndTheNextOneIsAskedFor)
{
    Painter painter(command("good"), {}, autosaves());
    paint(painter.strokes, 1.0, PaintKind::smooth);
    waitForStrokes(painter);
    for (int i = 0; i < 20; ++i)
        painter.poll([](const fs::path&) {});
    EXPECT_EQ(errors, std::vector<std::string>{"strokes[0]: not smooth"});
    EXPECT_EQ(linesOf(log).size(), 1u);
    painter.strokes.undo();
    paint(painter.strokes, 2.0);
    waitForStrokes(painter);
    EXPECT_EQ(held(), jsonOf(painter.strokes.visible()));
}

TEST_F(PainterTest, ADeltaThatCannotBeAppliedIsAnErrorAndPaintingGoesOn)
{
    Painter painter(command("good"), {}, autosaves());
    paint(painter.strokes, 1.0);
    const auto until = std::chrono::steady_clock::now() + patience;
    while (!(painter.isReady() && painter.isIdle()) && std::chrono::steady_clock::now() < until)
        painter.poll([](const fs::path&) { fail(ErrorKind::input, "damaged"); });
    const auto told = painter.takeTold();
    ASSERT_TRUE(told.has_value());
    EXPECT_EQ(told->text, "damaged");
    EXPECT_TRUE(painter.isReady());
}

TEST_F(PainterTest, TheAutosaveFollowsEachFinishedStroke)
{
    Painter painter(command("good"), {}, autosaves());
    waitForStrokes(painter);
    EXPECT_FALSE(fs::exists(autosave));
    paint(painter.strokes, 1.0);
    waitForStrokes(painter);
    EXPECT_EQ(readStrokeFile(autosave), painter.strokes.finished());
    painter.strokes.begin(Brush(), {});
    waitForStrokes(painter);
    EXPECT_EQ(readStrokeFile(autosave).size(), 1u) << "a growing stroke is not in it";
    painter.strokes.finish();
    waitForStrokes(painter);
    EXPECT_EQ(readStrokeFile(autosave).size(), 2u);
    // It goes when the strokes are saved.
    const fs::path saved = folder.path() / "saved.json";
    painter.saveStrokes(saved, false);
    waitForStrokes(painter);
    EXPECT_TRUE(fs::exists(saved));
    EXPECT_FALSE(painter.strokes.isUnsaved());
    EXPECT_FALSE(fs::exists(autosave));
    ASSERT_EQ(notices.size(), 1u);
    // And comes with the next change.
    painter.strokes.undo();
    waitForStrokes(painter);
    EXPECT_EQ(readStrokeFile(autosave).size(), 1u);
}

TEST_F(PainterTest, TwoPaintingsOfAFieldHaveAnAutosaveEach)
{
    Painter first(command("good"), {}, autosaves());
    for (int i = 0; i < 3; ++i)
        paint(first.strokes, i);
    waitForStrokes(first);
    Painter second(command("good"), {}, autosaves());
    paint(second.strokes, 9.0);
    waitForStrokes(second);
    EXPECT_EQ(readStrokeFile(autosave), first.strokes.finished());
    const fs::path other = folder.path() / "a.strokes.autosave-2.json";
    EXPECT_EQ(readStrokeFile(other), second.strokes.finished());
    second.strokes.undo();
    waitForStrokes(second);
    EXPECT_FALSE(fs::exists(other)) << "nothing is left to be saved";
    EXPECT_EQ(readStrokeFile(autosave).size(), 3u);
    paint(second.strokes, 9.0);
    second.discard();
    EXPECT_EQ(readStrokeFile(autosave).size(), 3u);
}

TEST_F(PainterTest, StrokesThatAreNotSavedAreLeftByItsEndAndThoseThatAreDiscardedAreNot)
{
    {
        Painter painter(command("good"), {}, autosaves());
        paint(painter.strokes, 1.0);
        painter.strokes.begin(Brush(), {});
    }
    EXPECT_EQ(readStrokeFile(autosave).size(), 2u) << "also the one that was growing";
    Autosave next = autosaves();
    ASSERT_TRUE(next.adopt(autosave));
    {
        Painter painter(command("good"), {}, std::move(next));
        paint(painter.strokes, 1.0);
        waitForStrokes(painter);
        EXPECT_EQ(readStrokeFile(autosave).size(), 1u);
        painter.discard();
    }
    EXPECT_EQ(leftStrokes({"a", "/fields/a.sward", "0123"}, {folder.path()}).size(), 0u);
    EXPECT_FALSE(fs::exists(autosave));
}

TEST_F(PainterTest, AnAutosaveThatCannotBeWrittenIsToldOnceAndTriedAgain)
{
    const fs::path file = folder.path() / "file";
    std::ofstream(file) << "no folder";
    Painter painter(command("good"), {}, Autosave({"a", "hills", {}}, {file}));
    for (int i = 0; i < 3; ++i) {
        paint(painter.strokes, i);
        waitForStrokes(painter);
    }
    ASSERT_EQ(errors.size(), 1u);
    EXPECT_NE(errors[0].find("Save strokes..."), std::string::npos) << errors[0];
    EXPECT_FALSE(painter.autosaveTrouble().empty());
    fs::remove(file);
    EXPECT_EQ(readStrokeFile(painter.finishAutosave()), painter.strokes.finished());
    EXPECT_TRUE(painter.autosaveTrouble().empty());
}

TEST_F(PainterTest, LostStrokesAreToldAndMoveAsOneChange)
{
    Painter painter(command("good"), {}, autosaves());
    paint(painter.strokes, 1.0);
    paint(painter.strokes, 60.0);
    waitForStrokes(painter);
    EXPECT_EQ(painter.lost().countIn(painter.strokes), 1u);
    EXPECT_EQ(painter.lost().of(painter.strokes.entries()[0].text), nullptr);
    ASSERT_NE(painter.lost().of(painter.strokes.entries()[1].text), nullptr);
    ASSERT_EQ(errors.size(), 1u);
    EXPECT_NE(errors[0].find("1 of 2 strokes"), std::string::npos) << errors[0];
    const auto before = painter.strokes.visible();
    painter.moveStrokes(3.0);
    waitForStrokes(painter);
    EXPECT_EQ(painter.strokes.entries()[0].middle, glm::dvec3(1.0, -3.0, 0.0));
    EXPECT_EQ(painter.strokes.entries()[1].middle, glm::dvec3(60.0, -3.0, 0.0));
    EXPECT_EQ(painter.lost().countIn(painter.strokes), 0u);
    EXPECT_EQ(json::parse(linesOf(log).back())["do"], "move") << "the session has them already";
    painter.strokes.undo();
    waitForStrokes(painter);
    EXPECT_EQ(painter.strokes.visible(), before);
    EXPECT_EQ(held(), jsonOf(before));
}

TEST_F(PainterTest, SavesAFieldThatHasAllStrokes)
{
    Painter painter(command("good"), {}, autosaves());
    const fs::path saved = folder.path() / "a.sward";
    paint(painter.strokes, 1.0);
    painter.saveField(saved, false);
    waitForStrokes(painter);
    EXPECT_EQ(json::parse(textOf(saved)), jsonOf(painter.strokes.visible()));
    EXPECT_EQ(painter.savedField(), saved);
    EXPECT_TRUE(painter.strokes.isUnsaved()) << "a field has no strokes that can be undone";
    paint(painter.strokes, 2.0);
    EXPECT_EQ(painter.savedField(), fs::path());
    painter.saveFieldNow(saved, true);
    EXPECT_EQ(json::parse(textOf(saved)), jsonOf(painter.strokes.visible()));
}

TEST_F(PainterTest, ASessionThatEndsOrSaysGarbageIsAFailureWithAReason)
{
    const std::vector<std::pair<const char*, const char*>> reasons{
        {"silent-death", "ended with exit code 3"},   {"loud-death", "hills: no such ground"},
        {"garbage", "its first line is not that of"}, {"dies", "ended by signal 6"},
        {"wrong-id", "no answer to a request"},       {"endless", "longer than 16 MiB"}};
    for (const auto& [how, reason] : reasons) {
        SCOPED_TRACE(how);
        errors.clear();
        Painter painter(command(how), {}, autosaves());
        for (int i = 0; i < 2 && painter.session().failure().empty(); ++i) {
            paint(painter.strokes, i);
            pollUntil(painter, [&] {
                return !painter.session().failure().empty() ||
                       (painter.isReady() && painter.isIdle());
            });
        }
        ASSERT_EQ(errors.size(), 1u);
        EXPECT_NE(errors[0].find(reason), std::string::npos) << errors[0];
        EXPECT_FALSE(painter.isReady());
        // It goes on without the session, and the strokes are there.
        paint(painter.strokes, 9.0);
        painter.poll([](const fs::path&) {});
        EXPECT_EQ(readStrokeFile(painter.finishAutosave()), painter.strokes.finished());
        EXPECT_THROW(painter.saveFieldNow(folder.path() / "never.sward", false), Error);
    }
}

TEST_F(PainterTest, AProgramThatIsMissingIsAnError)
{
    EXPECT_THROW(Painter({"/nowhere/sward", "edit"}, {}, autosaves()), Error);
}

TEST_F(PainterTest, TheSessionEndsWithThePainter)
{
    pid_t process = 0;
    {
        Painter painter(command("good"), {}, autosaves());
        waitForStrokes(painter);
        process = std::stoi(textOf(log.string() + ".pid"));
        ASSERT_EQ(::kill(process, 0), 0);
    }
    EXPECT_NE(::kill(process, 0), 0);
}

} // namespace
} // namespace sward::view
