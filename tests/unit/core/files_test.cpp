#include "core/error.h"
#include "core/files/atomic_file.h"
#include "core/files/file_lock.h"
#include "core/files/mapped_file.h"
#include "core/files/piece_file.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

namespace sward {
namespace {

namespace fs = std::filesystem;

class Files : public testing::Test {
protected:
    void SetUp() override
    {
        folder = fs::temp_directory_path() / ("sward-files-" + std::to_string(::getpid()));
        fs::create_directories(folder);
    }
    void TearDown() override { fs::remove_all(folder); }

    std::size_t entries() const
    {
        return static_cast<std::size_t>(
            std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
    }

    static std::string contents(const fs::path& path)
    {
        std::ifstream in(path, std::ios::binary);
        return {std::istreambuf_iterator<char>(in), {}};
    }

    fs::path folder;
};

TEST_F(Files, AppearOnlyWhenCommitted)
{
    {
        AtomicFile file(folder / "a", false);
        file.write("half");
        EXPECT_FALSE(fs::exists(folder / "a"));
    }
    EXPECT_EQ(entries(), 0U);
    writeTextFile(folder / "a", "whole", false);
    EXPECT_EQ(contents(folder / "a"), "whole");
    EXPECT_EQ(entries(), 1U);
}

TEST_F(Files, AreNotOverwrittenWithoutPermission)
{
    writeTextFile(folder / "a", "old", false);
    try {
        writeTextFile(folder / "a", "new", false);
        FAIL() << "overwrote";
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::io);
        EXPECT_NE(std::string(error.what()).find("--force"), std::string::npos);
    }
    EXPECT_EQ(contents(folder / "a"), "old");
    writeTextFile(folder / "a", "new", true);
    EXPECT_EQ(contents(folder / "a"), "new");
}

TEST_F(Files, ThatAppearMeanwhileAreNotOverwrittenEither)
{
    AtomicFile file(folder / "a", false);
    file.write("mine");
    std::ofstream(folder / "a") << "theirs";
    EXPECT_THROW(file.commit(), Error);
    EXPECT_EQ(contents(folder / "a"), "theirs");
}

TEST_F(Files, KeepTheOldOneWhenAForcedWriteFails)
{
    writeTextFile(folder / "a", "old", false);
    // A limit on the file's size stands in for a full disk.
    rlimit before = {};
    ::getrlimit(RLIMIT_FSIZE, &before);
    rlimit small = before;
    small.rlim_cur = 100;
    ::signal(SIGXFSZ, SIG_IGN);
    ::setrlimit(RLIMIT_FSIZE, &small);
    EXPECT_THROW(writeTextFile(folder / "a", std::string(1000, 'x'), true), Error);
    ::setrlimit(RLIMIT_FSIZE, &before);
    EXPECT_EQ(contents(folder / "a"), "old");
    EXPECT_EQ(entries(), 1U);
}

TEST_F(Files, TakeBytesAtAnyPlace)
{
    AtomicFile file(folder / "a", false);
    const std::string text = "abc";
    file.writeAt(5, std::as_bytes(std::span(text)));
    file.writeAt(1, std::as_bytes(std::span(text)).first(2));
    file.commit();
    EXPECT_EQ(contents(folder / "a"), std::string("\0ab\0\0abc", 8));
}

TEST_F(Files, ForScratchHaveNoNameAndGiveBackTheirBytes)
{
    ScratchFile file(folder / "a");
    EXPECT_EQ(entries(), 0U);
    const std::string text = "some text";
    file.append(std::as_bytes(std::span(text)).first(4));
    file.append(std::as_bytes(std::span(text)).subspan(4));
    EXPECT_EQ(file.size(), text.size());
    std::string read(4, ' ');
    file.read(5, std::as_writable_bytes(std::span(read)));
    EXPECT_EQ(read, "text");
    EXPECT_THROW(file.read(6, std::as_writable_bytes(std::span(read))), Error);
    EXPECT_THROW(ScratchFile(folder / "no" / "a"), Error);
    EXPECT_THROW(PieceFile(folder / "a"), Error);
}

TEST_F(Files, InMissingFoldersAreRefused)
{
    EXPECT_THROW(AtomicFile(folder / "no" / "a", false), Error);
    EXPECT_THROW(refuseOverwrite(folder, true), Error);
}

TEST_F(Files, AreWrittenThroughLinks)
{
    fs::create_directories(folder / "far");
    fs::create_symlink("far/b", folder / "a"); // leads nowhere yet
    EXPECT_THROW(writeTextFile(folder / "a", "new", false), Error);
    for (const char* text : {"first", "second"}) {
        writeTextFile(folder / "a", text, true);
        EXPECT_TRUE(fs::is_symlink(folder / "a"));
        EXPECT_EQ(contents(folder / "far" / "b"), text);
    }
    fs::create_symlink("loop", folder / "loop");
    EXPECT_THROW(writeTextFile(folder / "loop", "new", true), Error);
    EXPECT_EQ(entries(), 3U);
}

TEST_F(Files, ReplaceNothingThatIsNoRegularFile)
{
    ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
    fs::create_symlink("/dev/null", folder / "link");
    for (const fs::path& path : {folder / "pipe", folder / "link", fs::path("/dev/null"), folder}) {
        for (const bool overwrite : {false, true}) {
            try {
                requireWritable(path, overwrite);
                ADD_FAILURE() << path;
            } catch (const Error& error) {
                EXPECT_EQ(error.kind(), ErrorKind::io) << path;
                EXPECT_NE(std::string(error.what()).find("is a "), std::string::npos) << path;
            }
        }
    }
    EXPECT_EQ(entries(), 2U);
}

TEST_F(Files, MayHaveTheLongestNameOfAFolder)
{
    writeTextFile(folder / std::string(255, 'a'), "long", false);
    EXPECT_EQ(contents(folder / std::string(255, 'a')), "long");
    EXPECT_THROW(requireWritable(folder / std::string(256, 'a'), false), Error);
    EXPECT_EQ(entries(), 1U);
}

TEST_F(Files, ThatWereReadAreKnownByAnyName)
{
    writeTextFile(folder / "a", "grass", false);
    fs::create_symlink("a", folder / "b");
    EXPECT_FALSE(hasBeenRead(folder / "a"));
    EXPECT_EQ(readFile(folder / "b").size(), 5U);
    EXPECT_TRUE(hasBeenRead(folder / "a"));
    EXPECT_TRUE(hasBeenRead(folder / "." / "b"));
    EXPECT_FALSE(hasBeenRead(folder / "missing"));
}

TEST_F(Files, AreInMemoryOnceTheyHaveBeenRead)
{
    std::ofstream(folder / "large") << std::string(1'000'000, 'x');
    const MappedFile file(folder / "large");
    bringIntoMemory(file.bytes());
    EXPECT_EQ(std::count(file.bytes().begin(), file.bytes().end(), std::byte{'x'}), 1'000'000);
    EXPECT_TRUE(isInMemory(file.bytes()));
    EXPECT_TRUE(isInMemory(file.bytes().subspan(4095, 70'000)));
    EXPECT_TRUE(isInMemory({}));
    bringIntoMemory({});
}

TEST_F(Files, AreMappedAsTheyAre)
{
    writeTextFile(folder / "a", "grass", false);
    const MappedFile file(folder / "a");
    ASSERT_EQ(file.bytes().size(), 5U);
    EXPECT_EQ(file.bytes()[0], std::byte('g'));
    writeTextFile(folder / "empty", "", false);
    EXPECT_TRUE(MappedFile(folder / "empty").bytes().empty());
    EXPECT_THROW(MappedFile(folder / "missing"), Error);
    EXPECT_THROW(MappedFile{folder}, Error);
    EXPECT_THROW(readFile(folder / "a", 4), Error);
}

TEST_F(Files, AreLockedByOneHolderAndMayGoMeanwhile)
{
    const fs::path path = folder / "lock";
    {
        auto held = FileLock::tryTake(path);
        ASSERT_TRUE(held.has_value());
        EXPECT_TRUE(held->hasMadeFile());
        held->write("long text");
        held->write("text");
        EXPECT_EQ(held->text(), "text");
        EXPECT_FALSE(FileLock::tryTake(path).has_value());
        EXPECT_THROW(FileLock::take(path, std::chrono::milliseconds(20)), Error);
        held->removeFile();
        EXPECT_TRUE(FileLock::tryTake(path).has_value()) << "a new file";
    }
    const auto again = FileLock::tryTake(path);
    ASSERT_TRUE(again.has_value());
    EXPECT_FALSE(again->hasMadeFile());
    EXPECT_THROW(FileLock::tryTake(folder / "none" / "lock"), Error);
    EXPECT_EQ(lockNameFor(folder / "a.json"), folder / ".a.json.lock");
}

} // namespace
} // namespace sward
