#include "apps/sward_view/fields/shown_field.h"
#include "apps/sward_view/files/free_name.h"
#include "core/error.h"
#include "core/files/mapped_file.h"
#include "field/write.h"
#include "support/fields/fields.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <string>

namespace sward::view {
namespace {

namespace fs = std::filesystem;

class SavingTest : public testing::Test {
protected:
    void SetUp() override { fs::create_directories(folder_); }
    void TearDown() override { fs::remove_all(folder_); }

    static void touch(const fs::path& path) { std::ofstream(path) << "old"; }

    const fs::path folder_ = fs::path(testing::TempDir()) /
                             ("sward_saving_" + std::to_string(::getpid())); // beside one another
};

TEST_F(SavingTest, TheFirstFreeNameIsTaken)
{
    const fs::path path = folder_ / "a.b.png";
    EXPECT_EQ(freeName(path), path);
    touch(path);
    EXPECT_EQ(freeName(path), folder_ / "a.b-2.png");
    fs::create_symlink("nowhere", folder_ / "a.b-2.png");
    fs::create_directory(folder_ / "a.b-3.png");
    EXPECT_EQ(freeName(path), folder_ / "a.b-4.png");
    touch(folder_ / "noextension");
    EXPECT_EQ(freeName(folder_ / "noextension"), folder_ / "noextension-2");
}

TEST_F(SavingTest, ABakedFieldIsSavedAfterItsTemporaryFileIsGone)
{
    const fs::path temporary = folder_ / "field.sward";
    field::writeField(test::makeField({.blades = 200}), temporary, false);
    const std::vector<std::byte> written = readFile(temporary);
    FieldSource source{"plane.glb", temporary, {}, {}, {}, MeadowRequests()};
    OpenedField field(source);
    fs::remove(temporary);
    EXPECT_TRUE(field.isUnsaved());
    // A large field is mapped, and has no copy in memory.
    for (const bool isLarge : {false, true}) {
        const std::vector<std::byte> copy =
            isLarge ? std::move(field.bytes) : std::vector<std::byte>();
        if (isLarge)
            field.bytes.clear();
        const fs::path path = folder_ / (isLarge ? "large.sward" : "small.sward");
        field.save(path, false);
        EXPECT_EQ(readFile(path), written);
        EXPECT_EQ(field.savedAs, path);
        EXPECT_FALSE(field.isUnsaved());
        EXPECT_THROW(field.save(path, false), Error);
    }
}

} // namespace
} // namespace sward::view
