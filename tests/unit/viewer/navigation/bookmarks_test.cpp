#include "apps/sward_view/navigation/bookmarks.h"
#include "core/error.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <iterator>
#include <string>

namespace sward::view {
namespace {

class BookmarksTest : public testing::Test {
protected:
    void TearDown() override { std::filesystem::remove_all(folder_); }

    void write(const std::string& text) const
    {
        std::filesystem::create_directories(folder_);
        std::ofstream(file_) << text;
    }

    std::string text() const
    {
        std::ifstream in(file_);
        return {std::istreambuf_iterator<char>(in), {}};
    }

    const std::filesystem::path folder_ =
        std::filesystem::path(testing::TempDir()) /
        ("sward_bookmarks_" + std::to_string(::getpid())); // tests run beside one another
    const std::filesystem::path file_ = folder_ / "bookmarks.json";
};

render::Camera bookmarkAt(double x)
{
    render::Camera camera;
    camera.eye = {x, 2.25, 1e6 / 3.0};
    camera.target = {0.0, 0.0, 0.0};
    camera.fovY = 30.0f;
    return camera;
}

TEST_F(BookmarksTest, AreThereInTheNextRunToTheLastDigit)
{
    Bookmarks(file_).set("hills", 3, bookmarkAt(0.1));
    Bookmarks again(file_);
    again.set("hills", 9, bookmarkAt(7.0));
    const Bookmarks::Numbered found = Bookmarks(file_).of("hills");
    ASSERT_EQ(found.size(), 2u);
    EXPECT_EQ(found.at(3).eye, bookmarkAt(0.1).eye);
    EXPECT_EQ(found.at(9).eye.x, 7.0);
    EXPECT_EQ(found.at(3).fovY, 30.0f);
    EXPECT_TRUE(again.of("sphere").empty());
}

TEST_F(BookmarksTest, OfTwoWindowsDoNotReplaceEachOther)
{
    Bookmarks one(file_);
    Bookmarks other(file_);
    EXPECT_TRUE(one.of("hills").empty());
    EXPECT_TRUE(other.of("hills").empty());
    one.set("hills", 5, bookmarkAt(5.0));
    one.set("hills", 6, bookmarkAt(6.0));
    other.set("sphere", 7, bookmarkAt(7.0));
    other.set("hills", 8, bookmarkAt(8.0));
    EXPECT_EQ(one.of("hills").size(), 3u);
    EXPECT_EQ(one.of("sphere").size(), 1u);
    EXPECT_EQ(other.of("hills").at(5).eye.x, 5.0);
}

TEST_F(BookmarksTest, SetByManyProcessesAtOnceAreAllKept)
{
    constexpr int processes = 4;
    for (int i = 0; i < processes; ++i)
        if (::fork() == 0) {
            try {
                for (int number = 1; number <= 9; ++number)
                    Bookmarks(file_).set("ground" + std::to_string(i), number, bookmarkAt(number));
            } catch (const Error&) {
                ::_exit(1);
            }
            ::_exit(0);
        }
    for (int i = 0; i < processes; ++i) {
        int status = 0;
        ASSERT_GT(::wait(&status), 0);
        EXPECT_EQ(status, 0);
    }
    for (int i = 0; i < processes; ++i)
        EXPECT_EQ(Bookmarks(file_).of("ground" + std::to_string(i)).size(), 9u);
}

TEST_F(BookmarksTest, OfTheInputSetLongestAgoGoFirst)
{
    // Written at once: each set() reads and writes the file.
    nlohmann::ordered_json json;
    for (std::size_t i = 0; i < Bookmarks::maxInputs; ++i)
        json["ground" + std::to_string(i)]["1"] = {{"eye", {1, 2, 3}}, {"target", {0, 0, 0}}};
    write(json.dump());
    Bookmarks bookmarks(file_);
    bookmarks.set("ground0", 2, bookmarkAt(1.0));
    bookmarks.set("hills", 1, bookmarkAt(1.0));
    EXPECT_EQ(bookmarks.of("ground0").size(), 2u) << "set anew";
    EXPECT_TRUE(bookmarks.of("ground1").empty());
    EXPECT_EQ(bookmarks.of("ground2").size(), 1u);
}

TEST_F(BookmarksTest, ABadEntryIsNamedAndStays)
{
    const std::string bad = R"("5":{"eye":[1e300,0,0],"target":[0,0,0]})";
    const std::string good = R"("6":{"eye":[1,2,3],"target":[0,0,0]})";
    write(R"({"hills":{)" + bad + "," + good + R"(,"x":1},"sphere":7,"plane":{)" + good + "}}");
    Bookmarks bookmarks(file_);
    EXPECT_EQ(bookmarks.of("hills").size(), 1u);
    const std::string complaint = bookmarks.takeComplaint();
    for (const char* named : {"bookmarks.json", "hills: 5", "1e+300", "hills: x"})
        EXPECT_NE(complaint.find(named), std::string::npos) << complaint;
    EXPECT_TRUE(bookmarks.of("sphere").empty());
    EXPECT_NE(bookmarks.takeComplaint().find("sphere"), std::string::npos);
    bookmarks.of("hills");
    EXPECT_EQ(bookmarks.takeComplaint(), "") << "it was told";
    bookmarks.set("hills", 7, bookmarkAt(7.0));
    bookmarks.set("plane", 7, bookmarkAt(7.0));
    auto json = nlohmann::json::parse(text());
    EXPECT_EQ(json["hills"]["5"]["eye"][0], 1e300);
    EXPECT_EQ(json["hills"]["x"], 1);
    EXPECT_EQ(json["sphere"], 7);
    EXPECT_EQ(bookmarks.of("plane").size(), 2u);
    EXPECT_EQ(bookmarks.takeComplaint(), "");
    // The place that is set instead puts it aside.
    bookmarks.set("hills", 5, bookmarkAt(5.0));
    bookmarks.set("sphere", 1, bookmarkAt(1.0));
    EXPECT_NE(bookmarks.takeComplaint().find("5 (damaged)"), std::string::npos);
    json = nlohmann::json::parse(text());
    EXPECT_EQ(json["hills"]["5 (damaged)"]["eye"][0], 1e300);
    EXPECT_EQ(json["hills"]["5"]["eye"][0], 5.0);
    EXPECT_EQ(json["sphere"]["places (damaged)"], 7);
    EXPECT_EQ(bookmarks.of("sphere").size(), 1u);
    EXPECT_EQ(bookmarks.takeComplaint(), "");
}

TEST_F(BookmarksTest, AFileThatIsNoListIsKeptUnderAnotherName)
{
    for (const char* damaged : {"[1", "[]", "7", "{\"hills\":"}) {
        std::filesystem::remove_all(folder_);
        write(damaged);
        Bookmarks bookmarks(file_);
        EXPECT_TRUE(bookmarks.of("hills").empty()) << damaged;
        EXPECT_NE(bookmarks.takeComplaint(), "") << damaged;
        EXPECT_EQ(text(), damaged) << "not touched by reading";
        bookmarks.set("hills", 1, bookmarkAt(1.0));
        const std::string aside = file_.string() + ".damaged";
        EXPECT_NE(bookmarks.takeComplaint().find(aside), std::string::npos);
        std::ifstream in(aside);
        EXPECT_EQ(std::string(std::istreambuf_iterator<char>(in), {}), damaged);
        EXPECT_EQ(bookmarks.of("hills").size(), 1u);
    }
}

TEST_F(BookmarksTest, ThatCannotBeStoredAreAnError)
{
    std::ofstream(folder_.string()) << "no folder";
    EXPECT_THROW(Bookmarks(file_).set("hills", 1, bookmarkAt(1.0)), Error);
    EXPECT_NO_THROW(Bookmarks(std::filesystem::path()).set("hills", 1, bookmarkAt(1.0)));
}

} // namespace
} // namespace sward::view
