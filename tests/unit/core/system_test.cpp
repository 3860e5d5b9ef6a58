// Laws of core/system that hold on every system. tests/windows/system_calls.cpp has those of
// Windows.
#include "core/error.h"
#include "core/process/user_folders.h"
#include "core/system/arguments.h"
#include "core/system/new_folder.h"
#include "core/system/peak_memory.h"
#include "core/uninitialized.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <optional>
#include <string>

namespace sward {
namespace {

TEST(System, GivesEmptyPagesAndCountsThem)
{
    constexpr std::size_t bytes = std::size_t(1) << 22;
    auto* const pages = static_cast<unsigned char*>(takePages(bytes));
    EXPECT_EQ(std::count(pages, pages + bytes, 0), static_cast<std::ptrdiff_t>(bytes));
    std::memset(pages, 1, bytes);
    EXPECT_GT(peakMemory(), bytes);
    returnPages(pages, bytes);
}

TEST(System, PassesOnTheBytesOfArguments)
{
    const char* const given[] = {"sward", "a \xc3\xa4", "\xff", ""};
    const std::vector<std::string> wanted(std::begin(given), std::end(given));
    EXPECT_EQ(programArguments(4, given), wanted);
    EXPECT_TRUE(programArguments(0, nullptr).empty());
}

TEST(System, MakesNewFolders)
{
    const std::filesystem::path start = std::filesystem::temp_directory_path() / "sward-\xc3\xa4";
    const std::filesystem::path first = makeNewFolder(start);
    const std::filesystem::path second = makeNewFolder(start);
    EXPECT_NE(first, second);
    EXPECT_TRUE(std::filesystem::is_directory(first));
    EXPECT_EQ(std::filesystem::status(first).permissions(), std::filesystem::perms::owner_all);
    EXPECT_THROW(makeNewFolder(first / "missing" / "a"), Error);
    std::filesystem::remove(first);
    std::filesystem::remove(second);
}

TEST(System, KnowsTheFoldersOfTheUser)
{
    const char* names[] = {"HOME", "XDG_STATE_HOME"};
    std::optional<std::string> before[2];
    for (int i = 0; i < 2; ++i)
        if (const char* value = std::getenv(names[i]))
            before[i] = value;
    ::setenv("HOME", "/there/\xc3\xa4", 1);
    ::setenv("XDG_STATE_HOME", "relative", 1);
    EXPECT_EQ(userHomeFolder(), "/there/\xc3\xa4");
    EXPECT_EQ(userStateFolder(), "/there/\xc3\xa4/.local/state") << "a relative path is ignored";
    ::setenv("XDG_STATE_HOME", "/state", 1);
    EXPECT_EQ(userStateFolder(), "/state");
    ::unsetenv("HOME");
    ::unsetenv("XDG_STATE_HOME");
    EXPECT_TRUE(userHomeFolder().empty());
    EXPECT_TRUE(userStateFolder().empty());
    for (int i = 0; i < 2; ++i)
        if (before[i])
            ::setenv(names[i], before[i]->c_str(), 1);
}

} // namespace
} // namespace sward
