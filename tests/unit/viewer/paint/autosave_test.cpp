#include "apps/common/temporary_folder.h"
#include "apps/sward_view/paint/autosave.h"
#include "core/error.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <iterator>
#include <string>

namespace sward::view {
namespace {

namespace fs = std::filesystem;

std::string contentOfFile(const fs::path& path)
{
    std::ifstream in(path);
    return {std::istreambuf_iterator<char>(in), {}};
}

class AutosaveTest : public testing::Test {
protected:
    const AutosaveSubject meadow{"meadow", "/a/meadow.sward", "0123"};
    apps::TemporaryFolder folder{"sward-view"};
    const std::vector<fs::path> folders{folder.path()};
    const fs::path first = folder.path() / "meadow.strokes.autosave.json";
    const fs::path second = folder.path() / "meadow.strokes.autosave-2.json";

    std::size_t entries() const
    {
        return static_cast<std::size_t>(
            std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()));
    }

    /// Runs `work` in another process that is then killed.
    template <typename Work>
    void inAKilledProcess(const Work& work) const
    {
        const pid_t child = ::fork();
        if (child == 0) {
            work();
            ::kill(::getpid(), SIGKILL);
        }
        int status = 0;
        ASSERT_EQ(::waitpid(child, &status, 0), child);
        ASSERT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL);
    }
};

TEST_F(AutosaveTest, OfALivingPaintingIsNeitherOfferedNorTakenNorRemoved)
{
    Autosave one(meadow, folders);
    Autosave other(meadow, folders);
    one.write("one");
    other.write("other");
    EXPECT_EQ(one.path(), first);
    EXPECT_EQ(other.path(), second);
    EXPECT_TRUE(leftStrokes(meadow, folders).empty());
    EXPECT_FALSE(Autosave(meadow, folders).adopt(first));
    EXPECT_FALSE(removeLeft(first));
    other.remove();
    EXPECT_FALSE(fs::exists(second));
    EXPECT_EQ(contentOfFile(first), "one");
}

TEST_F(AutosaveTest, OfAKilledProcessIsOfferedOnceAndTakenOver)
{
    inAKilledProcess([this] { Autosave(meadow, folders).write("before"); });
    Autosave living(meadow, folders);
    inAKilledProcess([this] {
        Autosave killed(meadow, folders);
        killed.write("strokes");
        ::kill(::getpid(), SIGKILL);
    });
    living.write("mine");
    EXPECT_EQ(contentOfFile(first), "before") << "the next name is taken";
    EXPECT_EQ(contentOfFile(second), "strokes");
    EXPECT_EQ(living.path().filename(), "meadow.strokes.autosave-3.json");
    auto left = leftStrokes(meadow, folders);
    ASSERT_EQ(left.size(), 2u);
    {
        Autosave next(meadow, folders);
        ASSERT_TRUE(next.adopt(second));
        EXPECT_EQ(contentOfFile(second), "strokes") << "until more is painted";
        left = leftStrokes(meadow, folders);
        ASSERT_EQ(left.size(), 1u);
        EXPECT_EQ(left[0].path, first);
        EXPECT_FALSE(removeLeft(second));
        next.write("more");
        EXPECT_EQ(contentOfFile(second), "more");
    }
    EXPECT_TRUE(removeLeft(first));
    EXPECT_EQ(contentOfFile(second), "more");
    EXPECT_FALSE(fs::exists(first));
    EXPECT_EQ(contentOfFile(living.path()), "mine");
}

TEST_F(AutosaveTest, OfAnotherGroundOfThatNameIsNotOffered)
{
    const AutosaveSubject here{"terrain", (folder.path() / "here/terrain.glb").string(), "aa"};
    const AutosaveSubject there{"terrain", (folder.path() / "there/terrain.glb").string(), "bb"};
    fs::create_directories(folder.path() / "here");
    std::ofstream(here.input) << "ground";
    Autosave(here, folders).write("here");
    EXPECT_TRUE(leftStrokes(there, folders).empty());
    Autosave(there, folders).write("there");
    const auto left = leftStrokes(here, folders);
    ASSERT_EQ(left.size(), 1u);
    EXPECT_EQ(contentOfFile(left[0].path), "here");
    EXPECT_FALSE(left[0].isOtherGround);
    // Sculpted, it is the same ground; so is one that was moved.
    AutosaveSubject sculpted = here;
    sculpted.ground = "cc";
    ASSERT_EQ(leftStrokes(sculpted, folders).size(), 1u);
    EXPECT_TRUE(leftStrokes(sculpted, folders)[0].isOtherGround);
    AutosaveSubject moved = here;
    moved.input = "/elsewhere/terrain.glb";
    EXPECT_TRUE(leftStrokes(moved, folders).empty()) << "a copy";
    fs::remove(here.input);
    EXPECT_EQ(leftStrokes(moved, folders).size(), 1u);
}

TEST_F(AutosaveTest, WithoutALockFileIsOffered)
{
    std::ofstream(first) << "of an older version";
    std::ofstream(folder.path() / "meadow.strokes.autosave-x.json") << "no autosave";
    std::ofstream(folder.path() / "meadows.strokes.autosave.json") << "of another field";
    const auto left = leftStrokes(meadow, folders);
    ASSERT_EQ(left.size(), 1u);
    EXPECT_EQ(left[0].path, first);
    Autosave next(meadow, folders);
    next.write("mine");
    EXPECT_EQ(next.path(), second);
    EXPECT_EQ(contentOfFile(first), "of an older version");
}

TEST_F(AutosaveTest, LeavesNothingWhenNothingIsToBeSaved)
{
    {
        Autosave autosave(meadow, folders);
        EXPECT_EQ(entries(), 0u);
        autosave.write("a");
        EXPECT_EQ(entries(), 2u) << "with its lock file";
        autosave.remove();
        EXPECT_EQ(entries(), 0u);
    }
    EXPECT_EQ(entries(), 0u);
}

TEST_F(AutosaveTest, OfAFolderThatTakesNoFileLiesInTheNext)
{
    const fs::path none = folder.path() / "file";
    std::ofstream(none) << "no folder";
    Autosave autosave(meadow, {none, folder.path() / "state" / "autosaves"});
    autosave.write("a");
    EXPECT_EQ(autosave.path().parent_path(), folder.path() / "state" / "autosaves");
    Autosave nowhere(meadow, {none, none / "deeper"});
    try {
        nowhere.write("a");
        FAIL() << "it was written";
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::io);
        EXPECT_NE(std::string(error.what()).find(none.string()), std::string::npos) << error.what();
    }
}

TEST_F(AutosaveTest, OfAFullDiskKeepsWhatItHad)
{
    const pid_t child = ::fork();
    if (child == 0) {
        // In a process of its own: the limit cannot be raised again.
        std::signal(SIGXFSZ, SIG_IGN);
        Autosave autosave(meadow, folders);
        autosave.write("before");
        const rlimit limit{4096, 4096};
        ::setrlimit(RLIMIT_FSIZE, &limit);
        try {
            autosave.write(std::string(100000, 'x'));
        } catch (const Error&) {
            ::_exit(contentOfFile(first) == "before" && entries() == 2 ? 7 : 1);
        }
        ::_exit(2);
    }
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    EXPECT_EQ(WEXITSTATUS(status), 7);
    EXPECT_EQ(leftStrokes(meadow, folders).size(), 1u);
}

} // namespace
} // namespace sward::view
