#include "bake/bake.h"
#include "bake/bake_file.h"
#include "core/error.h"
#include "field/write.h"
#include "support/meshes.h"
#include "unit/bake/bake_settings.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace sward::bake {
namespace {

namespace fs = std::filesystem;

// Some tiles of 25 cells; every cell holds more than one level of patches.
constexpr TileLimits smallTiles{1000.0, 9000.0};

class BakeFile : public testing::Test {
protected:
    BakeFile()
    {
        fs::remove_all(folder);
        fs::create_directories(folder);
        settings.exposureRays = 2;
        settings.clearance = 0.2;
    }
    ~BakeFile() override { fs::remove_all(folder); }

    Report bake(const TileLimits& limits)
    {
        Diagnostics diagnostics;
        return bakeIntoFile(ground, settings, 2, path, true, diagnostics, progress, limits);
    }

    std::string contents() const
    {
        std::ifstream file(path, std::ios::binary);
        return {std::istreambuf_iterator<char>(file), {}};
    }

    std::size_t files() const
    {
        return static_cast<std::size_t>(
            std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
    }

    const fs::path folder =
        fs::path(testing::TempDir()) / ("sward_bake_file_" + std::to_string(::getpid()));
    const fs::path path = folder / "f.sward";
    const terrain::GroundMesh ground = meshes::hills(150.0, 120);
    BakeSettings settings = tests::plainSettings(3.0);
    Progress progress;
};

TEST_F(BakeFile, HasTheBytesOfAFieldInMemoryHoweverManyTilesAreSpilled)
{
    Diagnostics diagnostics;
    const BakeResult whole = bakeField(ground, settings, 2, diagnostics, progress);
    ASSERT_GT(whole.field.blades.size(), 50'000U);
    const std::uint64_t bytes = field::writeField(whole.field, path, true);
    const std::string expected = contents();
    for (const TileLimits& limits : {TileLimits(), smallTiles, TileLimits{1000.0, 40'000.0}}) {
        const Report report = bake(limits);
        EXPECT_TRUE(contents() == expected) << limits.inTile;
        EXPECT_EQ(report.output.bytes, bytes);
        EXPECT_EQ(report.output.patches, whole.field.patches.size());
        EXPECT_EQ(report.kept, whole.report.kept);
        EXPECT_EQ(files(), 1U);
    }
}

TEST_F(BakeFile, HasTheSameBytesOfAGroundWithTooManyTrianglesForOneRayTree)
{
    bake({});
    const std::string expected = contents();
    TileLimits fewTriangles;
    fewTriangles.trianglesInOne = ground.triangles.size() - 1;
    fewTriangles.trianglesInTile = ground.triangles.size() / 7;
    bake(fewTriangles);
    EXPECT_TRUE(contents() == expected);
    // Of a ground that is given away as well.
    Diagnostics diagnostics;
    terrain::GroundMesh given = ground;
    bakeIntoFile(std::move(given), settings, 2, path, true, diagnostics, progress, fewTriangles);
    EXPECT_TRUE(contents() == expected);
}

TEST_F(BakeFile, LeavesTheOldOneAndNothingElseOnAFullDisk)
{
    std::ofstream(path) << "old";
    ::signal(SIGXFSZ, SIG_IGN);
    rlimit before = {};
    ::getrlimit(RLIMIT_FSIZE, &before);
    // One tile has a place, two have none; all have one, but the field has none.
    for (const rlim_t limit : {300'000U, 1'700'000U}) {
        rlimit small = before;
        small.rlim_cur = limit;
        ::setrlimit(RLIMIT_FSIZE, &small);
        try {
            bake(smallTiles);
            ADD_FAILURE() << "wrote more than " << limit;
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::io);
            EXPECT_NE(std::string(error.what()).find(path.string()), std::string::npos)
                << error.what();
            EXPECT_NE(std::string(error.what()).find("cannot write"), std::string::npos)
                << error.what();
        }
        ::setrlimit(RLIMIT_FSIZE, &before);
        EXPECT_EQ(contents(), "old");
        EXPECT_EQ(files(), 1U);
    }
}

TEST_F(BakeFile, IsNotThereAfterAnInterruption)
{
    // Tiles build ray trees: the third begins when the first is in the temporary file.
    int tiles = 0;
    Progress* cancelled = nullptr;
    Progress counting([&](const std::string& stage, double) {
        tiles += int(stage == "rays");
        if (tiles == 3)
            cancelled->cancel();
    });
    cancelled = &counting;
    Diagnostics diagnostics;
    try {
        bakeIntoFile(ground, settings, 2, path, true, diagnostics, counting, smallTiles);
        ADD_FAILURE() << "not interrupted after " << tiles << " tiles";
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::interrupted);
    }
    EXPECT_EQ(tiles, 3);
    EXPECT_EQ(files(), 0U);
}

} // namespace
} // namespace sward::bake
