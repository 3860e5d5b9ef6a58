#include "apps/sward_view/files/recent_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sward::view {
namespace {

using testing::ElementsAre;

TEST(RecentFiles, KeepsTheNewestFirstAndEachOnce)
{
    const std::filesystem::path file =
        std::filesystem::path(testing::TempDir()) / "recent_files" / "recent";
    std::filesystem::remove_all(file.parent_path());
    RecentFiles recent(file);
    for (const char* input : {"hills", "sphere", "hills"})
        recent.add(input);
    EXPECT_THAT(recent.inputs(), ElementsAre("hills", "sphere"));
    EXPECT_THAT(RecentFiles(file).inputs(), ElementsAre("hills", "sphere"));
    std::filesystem::remove_all(file.parent_path());
}

TEST(RecentFiles, OfTwoWindowsAreOneList)
{
    const std::filesystem::path file =
        std::filesystem::path(testing::TempDir()) / "recent_of_two" / "recent";
    std::filesystem::remove_all(file.parent_path());
    RecentFiles one(file);
    RecentFiles other(file);
    one.add("hills");
    other.add("sphere");
    one.add("plane");
    EXPECT_THAT(RecentFiles(file).inputs(), ElementsAre("plane", "sphere", "hills"));
    std::filesystem::remove_all(file.parent_path());
}

TEST(RecentFiles, ForgetsTheOldest)
{
    RecentFiles recent{std::filesystem::path()};
    for (int i = 0; i < 15; ++i)
        recent.add("nowhere" + std::to_string(i));
    EXPECT_EQ(recent.inputs().size(), RecentFiles::most);
    EXPECT_EQ(recent.inputs().front(), "nowhere14");
}

TEST(RecentFiles, DoesNotMindAPlaceThatCannotBeWritten)
{
    RecentFiles recent("/proc/nowhere/recent");
    EXPECT_NO_THROW(recent.add("hills"));
    EXPECT_THAT(recent.inputs(), ElementsAre("hills"));
}

} // namespace
} // namespace sward::view
