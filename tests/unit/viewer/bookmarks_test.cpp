#include "apps/sward_view/window/bookmarks.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <fstream>
#include <string>

namespace sward::view {
namespace {

class BookmarksTest : public testing::Test {
protected:
    void TearDown() override { std::filesystem::remove_all(folder_); }

    const std::filesystem::path folder_ =
        std::filesystem::path(testing::TempDir()) /
        ("sward_bookmarks_" + std::to_string(::getpid())); // tests run beside one another
    const std::filesystem::path file_ = folder_ / "bookmarks.json";
};

render::Camera cameraAt(double x)
{
    render::Camera camera;
    camera.eye = {x, 2.25, 1e6 / 3.0};
    camera.target = {0.0, 0.0, 0.0};
    camera.fovY = 30.0f;
    return camera;
}

TEST_F(BookmarksTest, AreThereInTheNextRunToTheLastDigit)
{
    Bookmarks(file_).set("hills", 3, cameraAt(0.1));
    Bookmarks again(file_);
    again.set("hills", 9, cameraAt(7.0));
    const Bookmarks::Numbered found = Bookmarks(file_).of("hills");
    ASSERT_EQ(found.size(), 2u);
    EXPECT_EQ(found.at(3).eye, cameraAt(0.1).eye);
    EXPECT_EQ(found.at(9).eye.x, 7.0);
    EXPECT_EQ(found.at(3).fovY, 30.0f);
    EXPECT_TRUE(again.of("sphere").empty());
}

TEST_F(BookmarksTest, AreForgottenWithWhatTheyBelongTo)
{
    Bookmarks bookmarks(file_);
    bookmarks.set("hills", 1, cameraAt(1.0));
    bookmarks.set("sphere", 1, cameraAt(2.0));
    bookmarks.keepOnly(std::array<std::string, 1>{"sphere"});
    EXPECT_TRUE(Bookmarks(file_).of("hills").empty());
    EXPECT_EQ(Bookmarks(file_).of("sphere").size(), 1u);
}

TEST_F(BookmarksTest, OfADamagedFileAreNone)
{
    std::filesystem::create_directories(folder_);
    for (const char* text : {"", "[1", "[]", R"({"hills": {"1": 5}})", R"({"hills": {"1": {}}})",
                             R"({"hills": 3})", "7"}) {
        std::ofstream(file_) << text;
        EXPECT_TRUE(Bookmarks(file_).of("hills").empty()) << text;
    }
}

} // namespace
} // namespace sward::view
