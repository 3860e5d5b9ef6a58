#include "presentation/detail_settings.h"

#include "core/error.h"
#include "presentation/settings_list.h"

#include <nlohmann/json.hpp>

namespace sward::presentation {

using render::FrameSettings;
using render::LevelStep;

namespace {

constexpr double farthest = 1e12; ///< [m]
constexpr std::size_t maxSteps = 4;
constexpr int maxSegments = 64;
constexpr int maxBuckets = 1'000'000;

void readOptional(SettingsReader& reader, const char* key, double most, std::optional<float>& value)
{
    float read = 0.0f;
    if (!reader.has(key))
        return;
    reader.read(key, read, 0.0, most);
    value = read;
}

LevelStep readStep(SettingsReader& reader, const std::vector<LevelStep>& before)
{
    LevelStep step;
    reader.read("distance", step.distance, 0.0, farthest);
    reader.read("segments", step.segments, 1, maxSegments);
    reader.finish();
    if (!before.empty() && step.distance <= before.back().distance)
        fail(ErrorKind::input, "{}: {} m is not farther than the step before",
             reader.placeOf("distance"), step.distance);
    return step;
}

void readCulling(SettingsReader reader, FrameSettings& settings)
{
    const auto test = [&](const char* key, std::uint32_t bit) {
        bool isOn = (settings.cullMask & bit) != 0;
        reader.read(key, isOn);
        settings.cullMask = isOn ? settings.cullMask | bit : settings.cullMask & ~bit;
    };
    test("patch", render::cullPatch);
    test("orientation", render::cullOrientation);
    test("frustum", render::cullFrustum);
    test("distance", render::cullDistance);
    test("occlusion", render::cullOcclusion);
    readOptional(reader, "edge_on_cosine", 1.0, settings.maxEdgeOn);
    reader.read("draw_distance", settings.environment.drawDistance, 1e-6, farthest);
    if (reader.has("buckets")) {
        SettingsReader buckets(reader.child("buckets"), reader.placeOf("buckets"));
        int count = static_cast<int>(settings.buckets.count);
        settings.buckets.distance = settings.environment.drawDistance;
        buckets.read("count", count, 0, maxBuckets);
        buckets.read("distance", settings.buckets.distance, 1e-6, farthest);
        buckets.finish();
        settings.buckets.count = static_cast<std::uint32_t>(count);
    }
    reader.finish();
}

std::vector<std::string> readLevels(SettingsReader reader, FrameSettings& settings)
{
    reader.read("thin_and_widen", settings.levelOfDetail);
    reader.read("thin_below_px", settings.lodThreshold, 0.01, 100.0);
    reader.readRenamed("min_width", "least_width", settings.minPixels, 0.0, 16.0);
    reader.readRenamed("max_leaf_area", "most_layers", settings.maxLeafArea, 0.0, 1e6);
    reader.read("segments", settings.tessellationLevel, 0, maxSegments);
    readList(reader, "steps", maxSteps, settings.levelSteps,
             [&](SettingsReader& one) { return readStep(one, settings.levelSteps); });
    readOptional(reader, "move_every_frame", farthest, settings.updateRate.everyFrame);
    readOptional(reader, "move_every_third", farthest, settings.updateRate.everyThird);
    reader.finish();
    return reader.warnings();
}

} // namespace

std::vector<std::string> readDetail(SettingsReader& reader, FrameSettings& settings)
{
    if (reader.has("culling"))
        readCulling({reader.child("culling"), reader.placeOf("culling")}, settings);
    if (reader.has("detail"))
        return readLevels({reader.child("detail"), reader.placeOf("detail")}, settings);
    return {};
}

} // namespace sward::presentation
