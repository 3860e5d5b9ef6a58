#include "bake/report.h"

#include "core/json/json_text.h"

#include <nlohmann/json.hpp>

#include <numeric>

namespace sward::bake {

const char* nameOf(Reject reason)
{
    static constexpr std::array<const char*, rejectCount> names{
        "spacing",   "mask",  "cutout",    "material", "slope",    "altitude", "border",
        "curvature", "water", "clearance", "exposure", "occluder", "excluded", "paint"};
    return names[static_cast<std::size_t>(reason)];
}

std::string toJson(const Report& report)
{
    using nlohmann::ordered_json;
    const auto vector = [](const glm::dvec3& v) { return ordered_json::array({v.x, v.y, v.z}); };

    ordered_json rejected = ordered_json::object();
    for (std::size_t i = 0; i < rejectCount; ++i)
        rejected[nameOf(static_cast<Reject>(i))] = report.rejected[i];
    const auto& timing = report.timing;
    const double perBlade =
        report.kept == 0 ? 0.0 : double(report.output.bytes) / double(report.kept);

    ordered_json object;
    object["tool"] = "sward 0.1.0";
    object["input"] = {{"path", report.input.path},
                       {"triangles", report.input.triangles},
                       {"area_m2", report.input.area},
                       {"bounds", {vector(report.input.low), vector(report.input.high)}},
                       {"hash", report.input.hash}};
    object["seed"] = report.seed;
    object["threads"] = report.threads;
    object["blade_scale"] = report.bladeScale;
    object["roots"] = {
        {"proposed", report.proposed}, {"kept", report.kept}, {"rejected", rejected}};
    object["spacing"] = {{"requested_m", report.spacingRequested},
                         {"minimum_m", report.spacingMinimum},
                         {"rho", nullptr}};
    if (report.relativeRadius)
        object["spacing"]["rho"] = *report.relativeRadius;
    object["density_per_m2"] = {{"requested", report.densityRequested},
                                {"reached", report.densityReached},
                                {"closed", report.densityClosed}};
    object["widening"] = report.widening;
    object["slope_deg"] = {report.slope.low, report.slope.high, report.slope.soft};
    object["ground_colors"] = nullptr;
    if (report.colors)
        object["ground_colors"] = {{"green", report.colors->green},
                                   {"bare", report.colors->bare},
                                   {"chosen_mask", report.maskChosen}};
    object["masks"] = ordered_json::array();
    for (const Report::MaskUse& use : report.masks)
        object["masks"].push_back({{"mask", use.mask}, {"reads", use.reads}});
    object["timing_s"] = {{"load", timing.load},     {"topology", timing.topology},
                          {"rays", timing.rays},     {"sample", timing.sample},
                          {"traits", timing.traits}, {"patches", timing.patches},
                          {"write", timing.write},   {"total", timing.total}};
    object["processor_s"] = {{"sample", timing.sampleBusy}, {"total", timing.totalBusy}};
    object["memory_bytes"] = {{"peak", report.peakMemory}};
    object["output"] = {{"path", report.output.path},
                        {"bytes", report.output.bytes},
                        {"patches", report.output.patches},
                        {"bytes_per_blade", perBlade}};
    if (report.seeds.cells > 0)
        object["seeds"] = {{"cells", report.seeds.cells},
                           {"bytes", report.seeds.bytes},
                           {"blades", report.seeds.blades},
                           {"stored", report.seeds.stored}};
    object["warnings"] = report.warnings;
    return jsonText(object, 2) + "\n";
}

} // namespace sward::bake
