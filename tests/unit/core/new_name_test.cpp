#include "core/files/new_name.h"

#include <gtest/gtest.h>

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <string>

namespace sward {
namespace {

namespace fs = std::filesystem;

template <int reason>
int refuse(const char*, const char*)
{
    errno = reason;
    return -1;
}

// The calls of file systems: all; without links, as exFAT; without RENAME_NOREPLACE too.
const NamingCalls fileSystems[] = {
    systemCalls,
    {refuse<EPERM>, systemCalls.moveToNew, systemCalls.create, systemCalls.moveOver},
    {refuse<EOPNOTSUPP>, refuse<EINVAL>, systemCalls.create, systemCalls.moveOver},
    {refuse<EMLINK>, refuse<ENOSYS>, systemCalls.create, systemCalls.moveOver},
};

class NewName : public testing::Test {
protected:
    void SetUp() override
    {
        folder = fs::temp_directory_path() / ("sward-new-name-" + std::to_string(::getpid()));
        fs::create_directories(folder);
        std::ofstream(from()) << "mine";
    }
    void TearDown() override { fs::remove_all(folder); }

    std::string from() const { return folder / "temporary"; }
    std::string to() const { return folder / "named"; }

    static std::string contents(const std::string& path)
    {
        std::ifstream in(path);
        return {std::istreambuf_iterator<char>(in), {}};
    }

    fs::path folder;
};

TEST_F(NewName, IsGivenOnEveryFileSystem)
{
    for (const NamingCalls& calls : fileSystems) {
        std::ofstream(from()) << "mine";
        EXPECT_EQ(moveToNewName(from().c_str(), to().c_str(), calls), 0);
        EXPECT_EQ(contents(to()), "mine");
        EXPECT_FALSE(fs::exists(from()));
        fs::remove(to());
    }
}

TEST_F(NewName, IsNeverTakenFromAnotherFile)
{
    std::ofstream(to()) << "theirs";
    for (const NamingCalls& calls : fileSystems) {
        EXPECT_EQ(moveToNewName(from().c_str(), to().c_str(), calls), EEXIST);
        EXPECT_EQ(contents(to()), "theirs");
        EXPECT_EQ(contents(from()), "mine");
    }
}

TEST_F(NewName, LeavesNoEmptyFileWhereAllFails)
{
    const NamingCalls none{refuse<EPERM>, refuse<EINVAL>, systemCalls.create, refuse<EIO>};
    EXPECT_EQ(moveToNewName(from().c_str(), to().c_str(), none), EIO);
    EXPECT_FALSE(fs::exists(to()));
    EXPECT_EQ(contents(from()), "mine");
}

} // namespace
} // namespace sward
