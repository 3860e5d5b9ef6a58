#include "apps/sward_view/interface/units.h"
#include "apps/sward_view/internal_resolution.h"
#include "apps/sward_view/panels/panels.h"

#include <fmt/core.h>

#include <algorithm>
#include <vector>

namespace sward::view {
namespace {

constexpr std::size_t plotted = 240; ///< frames
constexpr float plotHeight = 34.0f;  ///< [pixels]

void drawPass(Controls& controls, const gpu::Timestamps& times, const std::string& name)
{
    const std::vector<double> history = times.history(name);
    if (history.empty())
        return;
    const std::size_t shown = std::min(history.size(), plotted);
    const std::vector<double> last(history.end() - static_cast<std::ptrdiff_t>(shown),
                                   history.end());
    const gpu::Statistics statistics = gpu::statisticsOf(last);
    std::vector<float> values(last.begin(), last.end());
    controls.fact(name.c_str(),
                  fmt::format("{:.2f} ms   p99 {:.2f}", statistics.median, statistics.p99),
                  "Median, and what 99 of 100 frames stay below, over the last 240");
    ImGui::PlotLines(("##" + name).c_str(), values.data(), static_cast<int>(values.size()), 0,
                     nullptr, 0.0f, static_cast<float>(std::max(statistics.p99 * 1.2, 1e-3)),
                     {ImGui::GetContentRegionAvail().x, controls.style().scaled(plotHeight)});
}

} // namespace

void drawProfilePanel(Controls& controls, ViewerState& state)
{
    controls.fact("Device", state.device, "That draws");
    controls.fact("Frame", fmt::format("{:.1f} ms", 1000.0 * state.frameSeconds),
                  "From picture to picture, smoothed");
    controls.fact("Blades", countText(state.counts.total), "Of the field");
    controls.fact("Simulated", countText(state.counts.simulated), "Moved in the last frame");
    controls.fact("Drawn", countText(state.counts.drawn), "In the last frame");
    controls.fact("Memory", bytesText(state.deviceBytes), "Of the device, for field and pictures");

    controls.section("Resolution");
    controls.toggle("Automatic", state.automaticScale,
                    "Draws fewer pixels than the window has when frames take too long");
    ImGui::BeginDisabled(state.automaticScale);
    controls.number("Scale", state.scale, {static_cast<float>(InternalResolution::lowest), 1.0f},
                    "Drawn share of width and height");
    ImGui::EndDisabled();

    controls.toggle("Refine at rest", state.refinesAtRest,
                    "While nothing changes, stops the time and draws one fine picture with all "
                    "pixels and blades; off: draws on");

    controls.section("Passes");
    if (state.times == nullptr || state.times->names().empty()) {
        controls.note("This device measures no times.");
        return;
    }
    for (const std::string& name : state.times->names())
        drawPass(controls, *state.times, name);
    if (controls.button("Forget times", "Begins to measure anew", true))
        state.requests.forgetTimes = true;
}

} // namespace sward::view
