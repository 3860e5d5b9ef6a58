#include "core/files/atomic_file.h"
#include "presentation/settings_file.h"
#include "presentation/settings_text.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <filesystem>
#include <optional>

namespace sward::render {
namespace {

using presentation::readSettings;
using presentation::settingsText;

/// What is read from the text of `settings`.
FrameSettings readBack(const FrameSettings& settings)
{
    const std::filesystem::path path =
        std::filesystem::path(testing::TempDir()) /
        (std::string("settings_") + testing::UnitTest::GetInstance()->current_test_info()->name());
    writeTextFile(path, settingsText(settings), true);
    FrameSettings read;
    readSettings(path, read);
    std::filesystem::remove(path);
    return read;
}

FrameSettings unusual()
{
    FrameSettings s;
    s.environment.gravityDirection = {0.1f, -0.7f, 0.3f};
    s.environment.gravityStrength = 3.3f;
    s.environment.attractor = {1e5, -2.25, 0.125};
    s.environment.attractorBlend = 0.7f;
    s.environment.recovery = 1.0f / 3.0f;
    s.environment.drawDistance = 123.4f;
    s.forward = 0.6f;
    s.winds.clear();
    for (std::uint32_t kind = 0; kind < render::windKinds; ++kind) {
        s.winds.push_back(windSource(kind));
        s.winds.back().source.strength = 0.1f + static_cast<float>(kind);
        s.winds.back().source.lift = 0.3f;
    }
    s.winds[render::windSwirl].centre = {7.0, 8.0, 9.5};
    s.colliders = {{{1.0, 2.0, 3.0}, {1.0, 2.0, 3.0}, 0.3, {}},
                   {{1.0, 2.0, 3.0}, {4.0, 2.0, 3.0}, 0.2, {{0.0, {}}, {1.5, {1.0, 0.0, 0.0}}}}};
    s.cullMask = render::cullFrustum | render::cullOcclusion;
    s.levelOfDetail = false;
    s.lodThreshold = 2.5f;
    s.exposure = 0.37f;
    s.fogDensity = 0.01f;
    s.skyColor = {0.1f, 0.2f, 0.3f};
    s.sunDirection = {0.0f, 0.6f, -0.8f};
    s.sunColor = {5.0f, 4.0f, 3.0f};
    return s;
}

TEST(SettingsText, ReadsBackAsTheSameSettings)
{
    const FrameSettings s = unusual();
    const FrameSettings r = readBack(s);
    EXPECT_EQ(r.environment.gravityDirection, s.environment.gravityDirection);
    EXPECT_EQ(r.environment.gravityStrength, s.environment.gravityStrength);
    EXPECT_EQ(r.environment.attractor, s.environment.attractor);
    EXPECT_EQ(r.environment.attractorBlend, s.environment.attractorBlend);
    EXPECT_EQ(r.environment.recovery, s.environment.recovery);
    EXPECT_EQ(r.environment.drawDistance, s.environment.drawDistance);
    EXPECT_EQ(r.forward, s.forward);
    EXPECT_EQ(r.cullMask, s.cullMask);
    EXPECT_EQ(r.levelOfDetail, s.levelOfDetail);
    EXPECT_EQ(r.lodThreshold, s.lodThreshold);
    EXPECT_EQ(r.exposure, s.exposure);
    EXPECT_EQ(r.fogDensity, s.fogDensity);
    EXPECT_EQ(r.skyColor, s.skyColor);
    EXPECT_EQ(r.sunColor, s.sunColor);
    EXPECT_LT(glm::distance(r.sunDirection, s.sunDirection), 1e-6f);

    ASSERT_EQ(r.winds.size(), s.winds.size());
    for (std::size_t i = 0; i < s.winds.size(); ++i) {
        EXPECT_EQ(r.winds[i].source.kind, s.winds[i].source.kind);
        EXPECT_EQ(r.winds[i].source.strength, s.winds[i].source.strength);
        EXPECT_EQ(r.winds[i].source.size, s.winds[i].source.size);
        EXPECT_EQ(r.winds[i].source.lift, s.winds[i].source.lift);
        EXPECT_EQ(r.winds[i].centre, s.winds[i].centre);
    }
    ASSERT_EQ(r.colliders.size(), 2u);
    EXPECT_EQ(r.colliders[0].from, r.colliders[0].to);
    EXPECT_EQ(r.colliders[1].to, s.colliders[1].to);
    ASSERT_EQ(r.colliders[1].path.size(), 2u);
    EXPECT_EQ(r.colliders[1].path[1].move, s.colliders[1].path[1].move);
}

TEST(SettingsText, IsTheSameWhenItIsWrittenAgain)
{
    const std::string text = settingsText(unusual());
    EXPECT_EQ(settingsText(readBack(unusual())), text);
    EXPECT_EQ(settingsText(readBack(FrameSettings())), settingsText(FrameSettings()));
}

TEST(SettingsText, LeavesOutAirAndExposureThatAreChosenByThemselves)
{
    FrameSettings s;
    s.fogDensity = -1.0f;
    s.exposure.reset();
    EXPECT_LT(readBack(s).fogDensity, 0.0f);
    EXPECT_EQ(readBack(s).exposure, std::nullopt);
}

} // namespace
} // namespace sward::render
