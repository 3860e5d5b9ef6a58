#include "apps/common/temporary_folder.h"
#include "apps/sward_view/files/file_browser.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace sward::view {
namespace {

namespace fs = std::filesystem;

class FileBrowserTest : public testing::Test {
protected:
    FileBrowserTest()
    {
        for (const char* name : {"b.sward", "A.SWARD", "hill.glb", "notes.txt", ".hidden.sward"})
            std::ofstream(folder_ / name) << "x";
        fs::create_directories(folder_ / "meadows" / "old");
        std::ofstream(folder_ / "meadows" / "c.sward") << "x";
    }

    static std::vector<std::string> namesOf(const FileBrowser& browser)
    {
        std::vector<std::string> names;
        for (const FileBrowser::Entry& entry : browser.entries())
            names.push_back(entry.name + (entry.isFolder ? "/" : ""));
        return names;
    }

    FileDialog opening() const
    {
        return {.browser = {folder_, {".sward", ".glb"}}, .title = {}, .verb = {}, .act = {}};
    }

    const apps::TemporaryFolder temporary_{"sward-view"};
    const fs::path folder_ = fs::canonical(temporary_.path());
};

using Names = std::vector<std::string>;

TEST_F(FileBrowserTest, ListsFoldersAndThenTheWantedFilesByName)
{
    FileBrowser browser(folder_, {".sward", ".glb"});
    EXPECT_EQ(namesOf(browser), (Names{"meadows/", "A.SWARD", "b.sward", "hill.glb"}));
    browser.showAll(true);
    EXPECT_EQ(namesOf(browser), (Names{"meadows/", "A.SWARD", "b.sward", "hill.glb", "notes.txt"}));
    browser.filter("swa");
    EXPECT_EQ(namesOf(browser), (Names{"A.SWARD", "b.sward"}));
    browser.filter("zzz");
    EXPECT_TRUE(browser.entries().empty());
    EXPECT_GE(browser.selected(), browser.entries().size());
}

TEST_F(FileBrowserTest, GoesDownAndUpAndStaysWhereAFolderCannotBeRead)
{
    FileBrowser browser(folder_, {});
    EXPECT_TRUE(browser.go("meadows"));
    EXPECT_EQ(namesOf(browser), (Names{"old/", "c.sward"}));
    browser.up();
    EXPECT_EQ(browser.folder(), folder_);
    EXPECT_FALSE(browser.go("nowhere"));
    EXPECT_EQ(browser.folder(), folder_);
    EXPECT_NE(browser.complaint().find("nowhere"), std::string::npos);
    EXPECT_EQ(FileBrowser(folder_ / "nowhere", {}).folder(), fs::current_path());
}

TEST_F(FileBrowserTest, StepsStopAtBothEnds)
{
    FileBrowser browser(folder_, {});
    browser.step(-5);
    EXPECT_EQ(browser.selected(), 0u);
    browser.step(2);
    EXPECT_EQ(browser.selected(), 2u);
    browser.step(100);
    EXPECT_EQ(browser.selected(), browser.entries().size() - 1);
}

TEST_F(FileBrowserTest, APartOfANameMeansTheSelectedEntryAndAPathItself)
{
    FileDialog dialog = opening();
    dialog.typed = "b.s";
    dialog.browser.filter(dialog.typed);
    EXPECT_EQ(dialog.choose(), (folder_ / "b.sward").string());
    dialog.browser.filter("");
    dialog.typed = "meadows/c.sward";
    EXPECT_EQ(dialog.choose(), (folder_ / "meadows" / "c.sward").string());
    // A folder is entered.
    dialog.typed = "meadows";
    EXPECT_EQ(dialog.choose(), std::nullopt);
    EXPECT_EQ(dialog.browser.folder(), folder_ / "meadows");
    EXPECT_TRUE(dialog.typed.empty());
    dialog.typed = "..";
    EXPECT_EQ(dialog.choose(), std::nullopt);
    EXPECT_EQ(dialog.browser.folder(), folder_);
    // Nothing is left.
    dialog.typed = "zzz";
    dialog.browser.filter(dialog.typed);
    EXPECT_EQ(dialog.choose(), std::nullopt);
    EXPECT_NE(dialog.browser.complaint().find("zzz"), std::string::npos);
}

TEST_F(FileBrowserTest, AFileToBeWrittenNeedsANameAndAFolder)
{
    FileDialog dialog = opening();
    dialog.saves = true;
    EXPECT_EQ(dialog.choose(), std::nullopt);
    EXPECT_FALSE(dialog.browser.complaint().empty());
    dialog.typed = "new.sward";
    EXPECT_EQ(dialog.choose(), (folder_ / "new.sward").string());
    dialog.typed = "nowhere/new.sward";
    EXPECT_EQ(dialog.choose(), std::nullopt);
    EXPECT_NE(dialog.browser.complaint().find("nowhere"), std::string::npos);
}

TEST(ShortPath, IsRelativeBelowTheCurrentFolderOnly)
{
    EXPECT_EQ(shortPath(fs::current_path() / "a" / "b.sward"), "a/b.sward");
    EXPECT_EQ(shortPath("/b.sward"), "/b.sward");
}

} // namespace
} // namespace sward::view
