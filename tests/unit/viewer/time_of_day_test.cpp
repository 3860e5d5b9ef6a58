#include "apps/sward_view/scene/time_of_day.h"
#include "render/frame/frame_settings.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sward::view {
namespace {

TEST(TimeOfDay, TheSunRisesInTheEastStandsInTheSouthAndSetsInTheWest)
{
    EXPECT_NEAR(sunAt(12.0).elevation, 90.0 - 50.0 + 18.0, 1e-6);
    EXPECT_NEAR(std::abs(sunAt(12.0).azimuth), 180.0, 1e-6);
    EXPECT_NEAR(sunAt(7.0).azimuth, 90.0, 25.0);
    EXPECT_NEAR(sunAt(17.0).azimuth, -90.0, 25.0);
    for (double hour = 0.0; hour < 12.0; hour += 0.25) {
        EXPECT_LT(sunAt(hour).elevation, sunAt(hour + 0.25).elevation);
        EXPECT_NEAR(sunAt(hour).elevation, sunAt(24.0 - hour).elevation, 1e-9);
    }
    EXPECT_LT(sunAt(0.0).elevation, -10.0);
}

TEST(TimeOfDay, AnElevationHasAnHourInTheMorningAndOneInTheAfternoon)
{
    for (double hour = 0.5; hour < 24.0; hour += 0.5)
        EXPECT_NEAR(hourOf(sunAt(hour).elevation, hour < 12.0 ? 8.0 : 16.0), hour, 0.1);
    // Higher than it ever is.
    EXPECT_NEAR(hourOf(89.0, 9.0), 12.0, 0.3);
}

TEST(TimeOfDay, TheUsualHourHasTheUsualLight)
{
    render::FrameSettings settings;
    const render::FrameSettings usual;
    const double elevation = presentation::sunPlaceOf(usual.sunDirection).elevation;
    setTimeOfDay(settings, hourOf(elevation, 9.0), hourOf(elevation, 9.0));
    for (glm::length_t i = 0; i < 3; ++i) {
        EXPECT_NEAR(settings.sunColor[i], usual.sunColor[i], 0.01f);
        EXPECT_NEAR(settings.skyColor[i], usual.skyColor[i], 0.01f);
        EXPECT_NEAR(settings.groundColor[i], usual.groundColor[i], 0.01f);
    }
}

TEST(TimeOfDay, KeepsWhatTheUserHasTurnedTheSunBy)
{
    render::FrameSettings settings;
    settings.sunDirection = presentation::sunTowards(30.0, sunAt(9.0).elevation);
    setTimeOfDay(settings, 9.0, 14.0);
    const presentation::SunPlace sun = presentation::sunPlaceOf(settings.sunDirection);
    EXPECT_NEAR(
        std::remainder(sun.azimuth - 30.0 - sunAt(14.0).azimuth + sunAt(9.0).azimuth, 360.0), 0.0,
        1e-3);
    EXPECT_NEAR(sun.elevation, sunAt(14.0).elevation, 1e-3);
    setTimeOfDay(settings, 14.0, 9.0);
    EXPECT_NEAR(presentation::sunPlaceOf(settings.sunDirection).azimuth, 30.0, 1e-3);
}

TEST(TimeOfDay, LightFallsWithTheSun)
{
    render::FrameSettings settings;
    float sky = 1e9f, sun = 1e9f;
    for (double hour = 12.0; hour < 24.0; hour += 0.5) {
        setTimeOfDay(settings, hour, hour);
        EXPECT_LE(settings.skyColor.z, sky) << hour;
        EXPECT_LE(settings.sunColor.x, sun) << hour;
        EXPECT_GT(settings.skyColor.z, 0.0f);
        sky = settings.skyColor.z;
        sun = settings.sunColor.x;
    }
    EXPECT_EQ(sun, 0.0f);
    // A low sun is redder.
    setTimeOfDay(settings, 12.0, 19.0);
    EXPECT_GT(settings.sunColor.x, 1.5f * settings.sunColor.z);
}

} // namespace
} // namespace sward::view
