#include "apps/sward_view/navigation/navigation.h"
#include "support/fields/fields.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sward::view {
namespace {

constexpr float height = 500.0f;       ///< [pixels] of the picture
constexpr double navigationStep = 0.1; ///< [s]

class NavigationTest : public testing::Test {
protected:
    explicit NavigationTest(test::Surface surface = test::Surface::plane)
        : field_(fieldOn(surface))
        , ground_(viewOf(field_))
    {
    }

    static field::Field fieldOn(test::Surface surface)
    {
        test::FieldSettings settings;
        settings.surface = surface;
        settings.blades = 16;
        return test::makeField(settings);
    }

    Navigation from(const glm::dvec3& eye)
    {
        render::Camera home;
        home.eye = eye;
        home.target = {0.0, 0.0, 0.0};
        Navigation::Place place;
        place.size = 10.0;
        place.upAt = [this](const glm::dvec3& at) {
            return isBall_ ? glm::normalize(at) : glm::dvec3(0.0, 1.0, 0.0);
        };
        place.ground = &ground_;
        return {home, place};
    }

    Input held(const glm::vec3& ways, bool right = true) const
    {
        Input input;
        input.walk = ways;
        input.rightHeld = right;
        return input;
    }

    bool isBall_ = false;
    field::Field field_;
    presentation::GroundSurface ground_;
};

TEST_F(NavigationTest, FliesAheadOnlyWhileTheRightButtonIsHeld)
{
    Navigation navigation = from({0.0, 0.0, 8.0});
    navigation.steer(held({0.0f, 0.0f, 1.0f}, false), height, navigationStep, true, true);
    EXPECT_EQ(navigation.camera().eye.z, 8.0);
    navigation.steer(held({0.0f, 0.0f, 1.0f}), height, navigationStep, true, true);
    EXPECT_NEAR(navigation.camera().eye.z, 8.0 - navigation.speed() * navigationStep, 1e-9);
    EXPECT_EQ(navigation.camera().eye.x, 0.0);
}

TEST_F(NavigationTest, AnOrbitStaysAboveGroundThatFacesUp)
{
    // The square ends at 5 m: beside it there is nothing to stay above.
    for (const double away : {4.0, 40.0}) {
        Navigation navigation = from({0.0, 0.5 * away, away});
        double lowest = away;
        for (int i = 0; i < 40; ++i) {
            Input input;
            input.rotate = {7.0f, -23.0f};
            navigation.steer(input, height, navigationStep, true, true);
            lowest = std::min(lowest, navigation.camera().eye.y);
        }
        if (away < 5.0)
            EXPECT_GT(lowest, 0.0);
        else
            EXPECT_LT(lowest, 0.0);
    }
}

TEST_F(NavigationTest, KeepsItsPlaceWhileItLooksAround)
{
    Navigation navigation = from({0.0, 2.0, 8.0});
    Input input;
    input.rightHeld = true;
    input.look = {120.0f, -700.0f};
    for (int i = 0; i < 9; ++i) {
        navigation.steer(input, height, navigationStep, true, true);
        EXPECT_EQ(navigation.camera().eye, glm::dvec3(0.0, 2.0, 8.0));
    }
    // Never over the pole.
    const glm::dvec3 view = glm::normalize(navigation.camera().target - navigation.camera().eye);
    EXPECT_LT(std::abs(view.y), 0.9999);
}

TEST_F(NavigationTest, ChangesItsSpeedByTheWheelWhileTheRightButtonIsHeld)
{
    Navigation navigation = from({0.0, 2.0, 8.0});
    const double before = navigation.speed();
    Input input;
    input.wheel = 2.0f;
    navigation.steer(input, height, navigationStep, true, true);
    EXPECT_EQ(navigation.speed(), before);
    EXPECT_LT(glm::length(navigation.camera().eye), glm::length(glm::dvec3(0.0, 2.0, 8.0)));
    input.rightHeld = true;
    navigation.steer(input, height, navigationStep, true, true);
    EXPECT_NEAR(navigation.speed(), before * 1.25 * 1.25, 1e-9);
}

TEST_F(NavigationTest, LeavesTheCameraAloneWhereMouseAndKeysAreNotForIt)
{
    Navigation navigation = from({0.0, 2.0, 8.0});
    Input input = held({1.0f, 1.0f, 1.0f});
    input.rotate = {50.0f, 50.0f};
    input.wheel = 3.0f;
    navigation.steer(input, height, navigationStep, false, false);
    EXPECT_EQ(navigation.camera().eye, glm::dvec3(0.0, 2.0, 8.0));
}

TEST_F(NavigationTest, WalksAtAnEvenHeightOverTheGround)
{
    Navigation navigation = from({0.0, 3.0, 4.0});
    ASSERT_TRUE(navigation.walk(true));
    const double eyes = navigation.camera().eye.y;
    EXPECT_GT(eyes, 0.3);
    const double z = navigation.camera().eye.z;
    for (int i = 0; i < 10; ++i)
        navigation.steer(held({0.0f, 0.0f, 1.0f}, false), height, navigationStep, true, true);
    EXPECT_NEAR(navigation.camera().eye.y, eyes, 1e-6);
    EXPECT_LT(navigation.camera().eye.z, z - 0.5);
}

TEST_F(NavigationTest, ReturnsToItsBookmarksAndHome)
{
    Navigation navigation = from({0.0, 2.0, 8.0});
    EXPECT_FALSE(navigation.showBookmark(7));
    navigation.setBookmark(7);
    Input input;
    input.rotate = {80.0f, 10.0f};
    navigation.steer(input, height, navigationStep, true, true);
    const glm::dvec3 moved = navigation.camera().eye;
    EXPECT_TRUE(navigation.showBookmark(7));
    EXPECT_EQ(navigation.camera().eye, glm::dvec3(0.0, 2.0, 8.0));
    EXPECT_NE(moved, navigation.camera().eye);
    navigation.show(render::Camera());
    navigation.goHome();
    EXPECT_EQ(navigation.camera().eye, glm::dvec3(0.0, 2.0, 8.0));
}

class NavigationOnABall : public NavigationTest {
protected:
    NavigationOnABall()
        : NavigationTest(test::Surface::sphere)
    {
        isBall_ = true;
    }
};

TEST_F(NavigationOnABall, WalksAllAroundIt)
{
    Navigation navigation = from({0.0, 7.0, 0.5});
    ASSERT_TRUE(navigation.walk(true));
    const double distance = glm::length(navigation.camera().eye);
    const glm::dvec3 start = glm::normalize(navigation.camera().eye);
    double farthest = 1.0;
    for (int i = 0; i < 900; ++i) {
        navigation.steer(held({0.0f, 0.0f, 1.0f}, false), height, navigationStep, true, true);
        EXPECT_NEAR(glm::length(navigation.camera().eye), distance, 0.2);
        farthest = std::min(farthest, glm::dot(start, glm::normalize(navigation.camera().eye)));
    }
    EXPECT_LT(farthest, -0.99) << "it has been on the other side";
}

TEST(HeadingOf, AViewIsWhereItGoesOverTheGround)
{
    render::Camera camera;
    camera.eye = {0.0, 5.0, 0.0};
    camera.target = {10.0, 0.0, 0.0};
    EXPECT_NEAR(headingOf(camera), 0.0f, 1e-6f);
    camera.target = {0.0, 4.0, 3.0};
    EXPECT_NEAR(headingOf(camera), 0.5f * std::numbers::pi_v<float>, 1e-6f);
    // From above, the upper edge of the picture.
    camera.target = {0.0, 0.0, 0.0};
    camera.up = {-1.0f, 0.0f, 0.0f};
    EXPECT_NEAR(std::abs(headingOf(camera)), std::numbers::pi_v<float>, 1e-6f);
}

} // namespace
} // namespace sward::view
