#include "apps/sward_view/scene/camera_path.h"
#include "core/error.h"
#include "core/files/atomic_file.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

namespace sward::view {
namespace {

render::Camera stopAt(double x)
{
    render::Camera camera;
    camera.eye = {x, 1.0, 5.0};
    camera.target = {x, 0.0, 0.0};
    return camera;
}

CameraPath readText(const std::string& text)
{
    const std::filesystem::path path =
        std::filesystem::path(testing::TempDir()) /
        (std::string("path_") + testing::UnitTest::GetInstance()->current_test_info()->name());
    writeTextFile(path, text, true);
    CameraPath result = readCameraPath(path, glm::vec3(0.0f, 1.0f, 0.0f));
    std::filesystem::remove(path);
    return result;
}

TEST(CameraPath, PassesThroughEachOfItsPlaces)
{
    CameraPath path;
    const double times[] = {0.0, 0.5, 2.0, 2.1};
    const double places[] = {0.0, 3.0, -1.0, 4.0};
    for (int i = 0; i < 4; ++i)
        path.add(times[i], stopAt(places[i]));
    for (int i = 0; i < 4; ++i)
        EXPECT_NEAR(path.at(times[i]).eye.x, places[i], 1e-12);
}

TEST(CameraPath, GoesStraightAtAnEvenPaceWhereItsPlacesDo)
{
    CameraPath path;
    for (int i = 0; i < 5; ++i)
        path.add(0.5 * i, stopAt(2.0 * i));
    for (double time = 0.5; time <= 1.5; time += 0.07)
        EXPECT_NEAR(path.at(time).eye.x, 4.0 * time, 1e-9);
}

TEST(CameraPath, KeepsAnEvenPaceWhereItsPlacesAreUnevenInTime)
{
    CameraPath path;
    for (const double time : {0.0, 0.5, 2.0, 2.1, 3.0})
        path.add(time, stopAt(4.0 * time));
    for (double time = 0.5; time <= 2.1; time += 0.07)
        EXPECT_NEAR(path.at(time).eye.x, 4.0 * time, 1e-9);
}

TEST(CameraPath, TurnsNoCorners)
{
    CameraPath path;
    for (int i = 0; i < 4; ++i)
        path.add(i, stopAt(i == 2 ? 5.0 : 0.0));
    const auto pace = [&](double time) {
        return (path.at(time + 1e-5).eye.x - path.at(time - 1e-5).eye.x) / 2e-5;
    };
    EXPECT_NEAR(pace(1.0 - 1e-4), pace(1.0 + 1e-4), 0.02);
    EXPECT_NEAR(pace(2.0 - 1e-4), pace(2.0 + 1e-4), 0.02);
}

TEST(CameraPath, StandsStillBeforeItBeginsAndAfterItEnds)
{
    CameraPath path;
    path.add(1.0, stopAt(3.0));
    path.add(2.0, stopAt(4.0));
    EXPECT_EQ(path.at(-5.0).eye.x, 3.0);
    EXPECT_EQ(path.at(9.0).eye.x, 4.0);
}

TEST(CameraPath, ReadsBackWhatItHasWritten)
{
    CameraPath path;
    path.add(0.0, stopAt(0.0));
    path.add(0.73, stopAt(2.0));
    path.add(1.0, stopAt(7.0));
    const CameraPath again = readText(cameraPathText(path, 0.1));
    EXPECT_EQ(again.size(), 11u);
    for (double time = 0.0; time <= 1.0; time += 0.1)
        EXPECT_NEAR(again.at(time).eye.x, path.at(time).eye.x, 1e-4);
}

TEST(CameraPath, IsOneCameraWhereAFileHasOne)
{
    const CameraPath path = readText(R"({"eye": [1, 2, 3], "target": [0, 0, 0]})");
    EXPECT_EQ(path.size(), 1u);
    EXPECT_EQ(path.at(100.0).eye, glm::dvec3(1.0, 2.0, 3.0));
}

TEST(CameraPath, RefusesTimesThatDoNotRise)
{
    for (const char* text : {R"([])", R"([{"eye": [1, 2, 3], "target": [0, 0, 0]}])",
                             R"([{"time": 1, "eye": [1, 2, 3], "target": [0, 0, 0]},
              {"time": 1, "eye": [2, 2, 3], "target": [0, 0, 0]}])"})
        EXPECT_THROW(readText(text), Error) << text;
}

} // namespace
} // namespace sward::view
