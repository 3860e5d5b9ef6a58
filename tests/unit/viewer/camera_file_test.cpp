#include "apps/sward_view/scene/camera_file.h"
#include "core/error.h"
#include "core/files/atomic_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

namespace sward::view {
namespace {

using testing::HasSubstr;

class CameraFile : public testing::Test {
protected:
    // A name of its own for each test, since tests run side by side.
    const std::filesystem::path path_ =
        std::filesystem::path(testing::TempDir()) /
        (std::string("camera_") + testing::UnitTest::GetInstance()->current_test_info()->name() +
         ".json");

    ~CameraFile() override { std::filesystem::remove(path_); }

    render::Camera read(const std::string& text) const
    {
        writeTextFile(path_, text, true);
        return readCamera(path_, glm::vec3(0.0f, 0.0f, 1.0f));
    }

    std::string messageOf(const std::string& text) const
    {
        try {
            read(text);
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::input) << text;
            return error.what();
        }
        ADD_FAILURE() << "accepted " << text;
        return {};
    }
};

TEST_F(CameraFile, KeepsEveryDigitOfAFarPlace)
{
    const render::Camera camera = read(R"({"eye": [1000000.001, 2, 3], "target": [1000000, 0, 3],
                                           "up": [0, 0, 2], "fov_y_deg": 30})");
    EXPECT_EQ(camera.eye, glm::dvec3(1000000.001, 2.0, 3.0));
    EXPECT_EQ(camera.target, glm::dvec3(1000000.0, 0.0, 3.0));
    EXPECT_EQ(camera.up, glm::vec3(0.0f, 0.0f, 2.0f));
    EXPECT_EQ(camera.fovY, 30.0f);
}

TEST_F(CameraFile, TakesTheGroundsUpWhereItSaysNone)
{
    const render::Camera camera = read(R"({"eye": [1, 0, 0], "target": [0, 0, 0]})");
    EXPECT_EQ(camera.up, glm::vec3(0.0f, 0.0f, 1.0f));
    EXPECT_EQ(camera.fovY, 45.0f);
}

TEST_F(CameraFile, NamesFileAndKeyOfWhatIsWrong)
{
    const auto namesKey = [this](const char* key) {
        return testing::AllOf(HasSubstr(path_.string()), HasSubstr(key));
    };
    EXPECT_THAT(messageOf(R"({"target": [0, 0, 0]})"), namesKey("eye"));
    EXPECT_THAT(messageOf(R"({"eye": [1, 0], "target": [0, 0, 0]})"), namesKey("eye"));
    EXPECT_THAT(messageOf(R"({"eye": [1, 0, 0], "target": [1, 0, 0]})"), namesKey("target"));
    EXPECT_THAT(messageOf(R"({"eye": [0, 0, 5], "target": [0, 0, 0]})"), namesKey("up"));
    EXPECT_THAT(messageOf(R"({"eye": [1, 0, 0], "target": [0, 0, 0], "fov_y_deg": 180})"),
                namesKey("fov_y_deg"));
    EXPECT_THAT(messageOf(R"({"eye": [1, 0, 0], "target": [0, 0, 0], "fov_y_dg": 60})"),
                namesKey("fov_y_deg"));
    EXPECT_THAT(messageOf("{"), namesKey("JSON"));
}

} // namespace
} // namespace sward::view
