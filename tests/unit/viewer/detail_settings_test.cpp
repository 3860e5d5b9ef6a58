// The keys `culling` and `detail` of settings files: what they set, and what they refuse.
#include "core/error.h"
#include "core/json/settings_json.h"
#include "presentation/detail_settings.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace sward::render {
namespace {

FrameSettings settingsFrom(const std::string& text)
{
    const nlohmann::json json = parseJson(text, "s.json");
    SettingsReader reader(json, "s.json");
    FrameSettings settings;
    presentation::readDetail(reader, settings);
    reader.finish();
    return settings;
}

TEST(DetailSettings, LeaveAloneWhatTheyDoNotName)
{
    const FrameSettings usual;
    const FrameSettings read = settingsFrom(R"({"culling": {}, "detail": {}})");
    EXPECT_EQ(read.cullMask, usual.cullMask);
    EXPECT_EQ(read.levelOfDetail, usual.levelOfDetail);
    EXPECT_EQ(read.minPixels, usual.minPixels);
    EXPECT_EQ(read.buckets.count, 0u);
    EXPECT_TRUE(read.levelSteps.empty());
    EXPECT_FALSE(read.maxEdgeOn || read.updateRate.everyFrame || read.updateRate.everyThird);
}

TEST(DetailSettings, SetWhatTheyName)
{
    const FrameSettings read = settingsFrom(R"({
        "culling": {"patch": false, "occlusion": false, "edge_on_cosine": 0.9, "draw_distance": 40,
                    "buckets": {"count": 7}},
        "detail": {"thin_and_widen": false, "thin_below_px": 0.5, "min_width": 2, "segments": 7,
                   "steps": [{"distance": 5, "segments": 16}, {"distance": 10, "segments": 12}],
                   "move_every_frame": 8, "move_every_third": 16}})");
    EXPECT_EQ(read.cullMask, render::cullOrientation | render::cullFrustum | render::cullDistance);
    EXPECT_EQ(read.maxEdgeOn, 0.9f);
    EXPECT_EQ(read.environment.drawDistance, 40.0f);
    EXPECT_EQ(read.buckets.count, 7u);
    EXPECT_EQ(read.buckets.distance, 40.0f) << "the draw distance, unless it is given";
    EXPECT_FALSE(read.levelOfDetail);
    EXPECT_EQ(read.lodThreshold, 0.5f);
    EXPECT_EQ(read.minPixels, 2.0f);
    EXPECT_EQ(read.tessellationLevel, 7);
    ASSERT_EQ(read.levelSteps.size(), 2u);
    EXPECT_EQ(read.levelSteps[1].distance, 10.0f);
    EXPECT_EQ(read.levelSteps[1].segments, 12);
    EXPECT_EQ(read.updateRate.everyFrame, 8.0f);
    EXPECT_EQ(read.updateRate.everyThird, 16.0f);
}

TEST(DetailSettings, RefuseByKeyValueAndBound)
{
    const struct {
        const char* text;
        std::vector<const char*> says;
    } cases[] = {
        {R"({"culling": {"frustrum": true}})", {"culling", "\"frustrum\"", "\"frustum\""}},
        {R"({"culling": {"patch": 1}})", {"culling: patch", "1"}},
        {R"({"culling": {"edge_on_cosine": 1.5}})", {"edge_on_cosine", "1.5", "[0, 1]"}},
        {R"({"culling": {"draw_distance": 0}})", {"draw_distance", "0 is outside", "1e-06"}},
        {R"({"culling": {"buckets": {"count": -1}}})", {"buckets: count", "-1", "1000000"}},
        {R"({"culling": {"buckets": {"size": 1}}})", {"buckets", "\"size\""}},
        {R"({"detail": {"thin_below_px": 0}})", {"detail: thin_below_px", "0.01", "100"}},
        {R"({"detail": {"min_width": 17}})", {"min_width", "17", "[0, 16]"}},
        {R"({"detail": {"segments": 65}})", {"segments", "65", "[0, 64]"}},
        {R"({"detail": {"segments": 2.5}})", {"segments", "2.5"}},
        {R"({"detail": {"steps": {}}})", {"steps"}},
        {R"({"detail": {"steps": [{}, {}, {}, {}, {}]}})", {"steps", "5", "4"}},
        {R"({"detail": {"steps": [{"distance": 1, "segments": 0}]}})",
         {"segments", "0", "[1, 64]"}},
        {R"({"detail": {"steps": [{"distance": 5}, {"distance": 5}]}})",
         {"distance", "5 m", "before"}},
        {R"({"detail": {"move_every_frame": -1}})", {"move_every_frame", "-1"}},
    };
    for (const auto& wrong : cases) {
        SCOPED_TRACE(wrong.text);
        try {
            settingsFrom(wrong.text);
            ADD_FAILURE() << "was taken";
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::input);
            const std::string message = error.what();
            EXPECT_NE(message.find("s.json"), std::string::npos) << message;
            for (const char* word : wrong.says)
                EXPECT_NE(message.find(word), std::string::npos) << word << " in: " << message;
        }
    }
}

} // namespace
} // namespace sward::render
