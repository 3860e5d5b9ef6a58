#include "core/error.h"
#include "interchange/csv.h"
#include "interchange/gltf.h"
#include "interchange/ply.h"
#include "interchange/usda.h"
#include "support/fields/fields.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <limits>

namespace sward::interchange {
namespace {

using testing::HasSubstr;

// A temporary folder of this process.
class ExportFiles : public testing::Test {
protected:
    ExportFiles()
        : folder_(std::filesystem::temp_directory_path() /
                  ("sward-export-" + std::to_string(::getpid())))
    {
        std::filesystem::create_directories(folder_);
    }
    ~ExportFiles() override { std::filesystem::remove_all(folder_); }

    std::filesystem::path file(const char* name) const { return folder_ / name; }

    std::size_t fileCount() const
    {
        return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder_),
                                                      std::filesystem::directory_iterator()));
    }

    std::string textOf(const char* name) const
    {
        std::ifstream in(file(name), std::ios::binary);
        return {std::istreambuf_iterator<char>(in), {}};
    }

private:
    std::filesystem::path folder_;
};

using Writer = void (*)(const field::FieldView&, const std::filesystem::path&,
                        const ExportSettings&, Progress&);
struct Format {
    const char* name;
    Writer write;
};
constexpr Format formats[] = {
    {"x.csv", writeCsv}, {"x.glb", writeGlb}, {"x.ply", writePly}, {"x.usda", writeUsda}};

TEST_F(ExportFiles, AreTheSameBytesTwice)
{
    const field::Field field = test::makeField({.blades = 3000});
    for (const Format& format : formats) {
        Progress progress;
        format.write(field::viewOf(field), file(format.name), {}, progress);
        const std::string first = textOf(format.name);
        format.write(field::viewOf(field), file(format.name), {.overwrite = true}, progress);
        EXPECT_EQ(textOf(format.name), first) << format.name;
        EXPECT_GT(first.size(), 3000U * 40U);
    }
}

TEST_F(ExportFiles, StayWholeWithoutPermissionToOverwrite)
{
    const field::Field field = test::makeField({.blades = 100});
    for (const Format& format : formats) {
        std::ofstream(file(format.name)) << "precious";
        Progress progress;
        EXPECT_THROW(format.write(field::viewOf(field), file(format.name), {}, progress), Error);
        EXPECT_EQ(textOf(format.name), "precious");
    }
    EXPECT_EQ(fileCount(), std::size(formats));
}

TEST_F(ExportFiles, LeaveNothingWhenCancelled)
{
    // More than one group, so that every format has more than one step.
    const field::Field field = test::makeField({.blades = 100000});
    for (const Format& format : formats) {
        Progress* running = nullptr;
        Progress progress([&](const std::string&, double share) {
            if (share > 0.0)
                running->cancel();
        });
        running = &progress;
        try {
            format.write(field::viewOf(field), file(format.name), {}, progress);
            ADD_FAILURE() << format.name << " was not interrupted";
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::interrupted);
        }
    }
    EXPECT_EQ(fileCount(), 0U);
}

TEST_F(ExportFiles, OfNumbersBeyondAllBoundsAreRefusedByTheFieldsName)
{
    field::Field field = test::makeField({.blades = 600});
    field.patches[0].heightStep = std::numeric_limits<float>::max();
    for (const Format& format : formats) {
        Progress progress;
        try {
            format.write(field::viewOf(field), file(format.name), {.source = "hills.sward"},
                         progress);
            ADD_FAILURE() << format.name << " took it";
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::input);
            EXPECT_THAT(error.what(), HasSubstr("hills.sward: blade "));
        }
    }
    EXPECT_EQ(fileCount(), 0U);
}

TEST_F(ExportFiles, OfAFieldWithoutBladesAreWritten)
{
    const field::Field field = test::emptyField();
    for (const Format& format : formats) {
        Progress progress;
        format.write(field::viewOf(field), file(format.name), {}, progress);
        EXPECT_TRUE(std::filesystem::exists(file(format.name)));
    }
    EXPECT_THAT(textOf("x.glb"), testing::Not(HasSubstr("EXT_mesh_gpu_instancing")));
    EXPECT_THAT(textOf("x.ply"), HasSubstr("element vertex 0\n"));
}

TEST_F(ExportFiles, PassTheCopyrightOn)
{
    field::Field field = test::makeField({.blades = 10});
    field.copyright = "© 2024 \"A\"\nelement vertex 7";
    for (const Format& format : formats) {
        Progress progress;
        format.write(field::viewOf(field), file(format.name), {.generator = "tool 1"}, progress);
    }
    EXPECT_THAT(textOf("x.glb"), HasSubstr(R"("copyright":"© 2024 \"A\"\nelement vertex 7")"));
    EXPECT_THAT(textOf("x.glb"), HasSubstr(R"("generator":"tool 1")"));
    EXPECT_THAT(textOf("x.usda"), HasSubstr("string copyright = \"© 2024 \\\"A\\\"\\nelement"));
    // Lines of the text must not become header lines.
    EXPECT_THAT(textOf("x.ply"),
                HasSubstr("comment ?? 2024 \"A\"\ncomment element vertex 7\nelement vertex 10\n"));
}

TEST_F(ExportFiles, LongNotesAreBrokenForReadersWithShortLines)
{
    field::Field field = test::makeField({.blades = 1});
    field.copyright = std::string(1000, 'c');
    Progress progress;
    writePly(field::viewOf(field), file("x.ply"), {}, progress);
    const std::string text = textOf("x.ply");
    std::size_t longest = 0;
    for (std::size_t at = 0; at < text.find("end_header"); at = text.find('\n', at) + 1)
        longest = std::max(longest, text.find('\n', at) - at);
    EXPECT_LE(longest, 220U);
}

TEST_F(ExportFiles, GlbBeyondFourGigabytesIsRefusedWithTheNumberBeforeAnyWork)
{
    // Sixty million blades in inaccessible memory: reading one would end the test.
    constexpr std::size_t count = 60'000'000;
    void* const reserved = ::mmap(nullptr, count * sizeof(shared::PackedBlade), PROT_NONE,
                                  MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    ASSERT_NE(reserved, MAP_FAILED);
    const field::Field field = test::makeField({.blades = 10});
    field::FieldView view = field::viewOf(field);
    view.blades = {static_cast<const shared::PackedBlade*>(reserved), count};
    Progress progress;
    try {
        writeGlb(view, file("x.glb"), {}, progress);
        ADD_FAILURE() << "4.56 GB were accepted";
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::unsupported);
        EXPECT_THAT(error.what(), HasSubstr("x.glb"));
        EXPECT_THAT(error.what(), HasSubstr("60000000 blades"));
        EXPECT_THAT(error.what(), HasSubstr("4294967295"));
    }
    EXPECT_EQ(fileCount(), 0U);
    ::munmap(reserved, count * sizeof(shared::PackedBlade));
}

TEST(Glb, TheLargestLengthIsTheLargestAllowed)
{
    EXPECT_NO_THROW(refuseLargeGlb("x.glb", 56'000'000, 0xffff'ffffULL));
    EXPECT_THROW(refuseLargeGlb("x.glb", 56'000'000, 0x1'0000'0000ULL), Error);
}

} // namespace
} // namespace sward::interchange
