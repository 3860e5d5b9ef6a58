#include "apps/sward_view/headless/stats_json.h"

#include "core/json/json_text.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace sward::view {
namespace {

using Json = nlohmann::ordered_json;

// The passes of a frame, in output order.
constexpr const char* timedPasses[] = {"update",  "cull",  "pyramid", "blades", "shadow",
                                       "resolve", "grass", "ground",  "total"};

// Round to nanoseconds, the precision of the timestamps.
double rounded(double milliseconds)
{
    return std::round(milliseconds * 1e6) / 1e6;
}

Json summary(const gpu::Statistics& times)
{
    return Json{{"min", rounded(times.min)},
                {"median", rounded(times.median)},
                {"p99", rounded(times.p99)}};
}

Json bladeCounts(const render::FrameStats& blades)
{
    return Json{{"total", blades.total},
                {"streamed_out", blades.streamedOut},
                {"resident", blades.resident},
                {"sown", blades.sown},
                {"simulated", blades.simulated},
                {"drawn", blades.drawn},
                {"lod", blades.lod},
                {"culled",
                 {{"patch", blades.culledPatch},
                  {"orientation", blades.culledOrientation},
                  {"frustum", blades.culledFrustum},
                  {"distance", blades.culledDistance},
                  {"occlusion", blades.culledOcclusion}}}};
}

} // namespace

std::string statsText(const RunStats& stats)
{
    Json gpu = Json::object();
    for (const char* pass : timedPasses) {
        const auto found = stats.gpuTimes.find(pass);
        gpu[pass] = summary(found == stats.gpuTimes.end() ? gpu::Statistics() : found->second);
    }
    const double blades = static_cast<double>(std::max<std::uint64_t>(stats.blades.resident, 1));
    const double perBlade =
        stats.blades.resident == 0 ? 0.0 : static_cast<double>(stats.deviceBytes) / blades;

    Json json;
    json["device"] = stats.device;
    json["driver"] = stats.driver;
    json["size"] = {stats.size.x, stats.size.y};
    json["samples"] = stats.samples;
    json["geometry"] = stats.geometry;
    json["geometry_reason"] = stats.geometryReason;
    json["blades"] = bladeCounts(stats.blades);
    json["gpu_ms"] = gpu;
    json["cpu_ms"] = {{"record", summary(stats.recordTime)}};
    json["memory_bytes"] = {{"device", stats.deviceBytes}, {"per_blade", perBlade}};
    if (stats.warmUp)
        json["warmup"] = {{"frames", stats.warmUp->frames}, {"seconds", stats.warmUp->seconds}};
    json["validation_messages"] = stats.validationMessages;
    return jsonText(json, 2) + "\n";
}

} // namespace sward::view
