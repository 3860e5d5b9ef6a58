#include "golden/programs.h"
#include "golden/scenes.h"
#include "support/pictures/picture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>
#include <ostream>
#include <stdexcept>
#include <string>
#include <vector>

namespace sward::golden {

/// Name of a scene in ctest.
void PrintTo(const Scene& scene, std::ostream* out);
void PrintTo(const Scene& scene, std::ostream* out)
{
    *out << scene.name;
}

namespace {

namespace fs = std::filesystem;

constexpr const char* size = "320x180";

std::vector<std::string> withFolders(std::vector<std::string> arguments)
{
    for (std::string& argument : arguments) {
        if (argument.starts_with("MESHES/"))
            argument = GOLDEN_MESHES + argument.substr(6);
        else if (argument.starts_with("CAMERAS/"))
            argument = GOLDEN_CAMERAS + argument.substr(7);
    }
    return arguments;
}

class GoldenPicture : public testing::TestWithParam<Scene> {};

/// The field of a scene, baked once for all scenes of the process that have the same one.
std::string fieldOf(const Scene& scene)
{
    static std::map<std::vector<std::string>, std::string> baked;
    std::vector<std::string> bake = withFolders(scene.bake);
    bake.insert(bake.begin(), "bake");
    // Blades alone, unless a scene says which plants.
    if (std::find(bake.begin(), bake.end(), "--meadow") == bake.end())
        bake.insert(bake.end(), {"--meadow", "grass"});
    std::string& field = baked[bake];
    if (field.empty()) {
        const fs::path folder = fs::path(GOLDEN_OUTPUT) / scene.name;
        const std::string path = (folder / "field.sward").string();
        bake.insert(bake.end(), {"-o", path, "-q"});
        const Finished done = run(GOLDEN_SWARD, bake, folder / "bake.log");
        if (done.code != 0)
            throw std::runtime_error("sward bake: " + done.output);
        field = path;
    }
    return field;
}

// Runs the programs end to end: bake, draw, compare with the accepted picture.
TEST_P(GoldenPicture, LooksAsItDid)
{
    const Scene& scene = GetParam();
    const fs::path folder = fs::path(GOLDEN_OUTPUT) / scene.name;
    fs::remove_all(folder);
    fs::create_directories(folder);
    const fs::path actualPath = folder / "actual.png";

    const std::string field = fieldOf(scene);

    // Draw it.
    std::vector<std::string> render{"render", field, "-o", actualPath.string(),
                                    "--size", size,  "-q", "--validation"};
    // Use the GPU rasteriser unless a scene sets another: the automatic choice depends on the
    // device.
    const auto says = [&scene](const char* option) {
        return std::find(scene.render.begin(), scene.render.end(), option) != scene.render.end();
    };
    if (!says("--geometry"))
        render.insert(render.end(), {"--geometry", "raster"});
    if (!says("--raster-for"))
        render.insert(render.end(), {"--raster-for", "gpu"});
    for (const std::string& argument : withFolders(scene.render))
        render.push_back(argument);
    const Finished drawn = run(GOLDEN_SWARD_VIEW, render, folder / "render.log");
    ASSERT_EQ(drawn.code, 0) << drawn.output;

    // Compare; scripts/accept-golden reads the line that begins with "golden".
    const Picture actual = readPicture(actualPath);
    const fs::path expectedPath = fs::path(GOLDEN_IMAGES) / (scene.name + ".png");
    if (!fs::exists(expectedPath)) {
        std::printf("golden %s: new picture\n", scene.name.c_str());
        FAIL() << expectedPath << " does not exist yet; the new picture is " << actualPath
               << "; scripts/accept-golden takes it over";
    }
    const Picture expected = readPicture(expectedPath);
    const Difference difference = compare(expected, actual);
    std::printf("golden %s: %zu of %zu pixels differ (%.3f %%), by at most %d of 255\n",
                scene.name.c_str(), difference.differentPixels, difference.pixels,
                100.0 * difference.share(), difference.largest);
    if (difference.share() <= allowedShare)
        return;

    // Save the pictures to explain the failure.
    writePicture(expected, folder / "expected.png");
    writePicture(amplifiedDifference(expected, actual), folder / "difference.png");
    ADD_FAILURE() << "more than " << 100.0 * allowedShare << " % of the pixels differ\n"
                  << "  actual      " << actualPath.string() << "\n"
                  << "  expected    " << (folder / "expected.png").string() << "\n"
                  << "  difference  " << (folder / "difference.png").string() << " (16 times)\n"
                  << "scripts/accept-golden accepts the new pictures";
}

std::string nameOf(const testing::TestParamInfo<Scene>& scene)
{
    return scene.param.name;
}

INSTANTIATE_TEST_SUITE_P(Scenes, GoldenPicture, testing::ValuesIn(scenes()), nameOf);
INSTANTIATE_TEST_SUITE_P(LongScenes, GoldenPicture, testing::ValuesIn(furtherScenes()), nameOf);

} // namespace
} // namespace sward::golden
