#include "apps/sward_view/interface/units.h"
#include "apps/sward_view/panels/panels.h"
#include "apps/sward_view/picture/internal_resolution.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <vector>

namespace sward::view {
namespace {

constexpr std::size_t plotted = 240;       ///< frames
constexpr float plotHeight = 34.0f;        ///< [pixels]
constexpr const char* totalName = "total"; ///< of the picture: all passes but those of the window
constexpr std::array<const char*, 2> windowPasses{"scaling", "interface"};

// The last durations of a pass [ms].
std::vector<double> lastOf(const gpu::Timestamps& times, const std::string& name)
{
    std::vector<double> history = times.history(name);
    const std::size_t shown = std::min(history.size(), plotted);
    history.erase(history.begin(), history.end() - static_cast<std::ptrdiff_t>(shown));
    return history;
}

// Means add up, medians would not. A pass that some frames do without counts as 0 there.
double meanOf(const std::vector<double>& values, std::size_t frames)
{
    return std::accumulate(values.begin(), values.end(), 0.0) /
           static_cast<double>(std::max<std::size_t>(frames, 1));
}

// Returns the mean.
double drawPass(Controls& controls, const gpu::Timestamps& times, const std::string& name,
                std::size_t frames)
{
    const std::vector<double> last = lastOf(times, name);
    if (last.empty())
        return 0.0;
    const double mean = meanOf(last, frames);
    const double p99 = gpu::statisticsOf(last).p99;
    const std::vector<float> values(last.begin(), last.end());
    controls.fact(
        name.c_str(), fmt::format("{:.2f} ms, 1 % above {:.2f}", mean, p99),
        "Mean of the last 240 frames, and the time that only one frame in a hundred takes "
        "longer than");
    ImGui::PlotLines(("##" + name).c_str(), values.data(), static_cast<int>(values.size()), 0,
                     nullptr, 0.0f, static_cast<float>(std::max(p99 * 1.2, 1e-3)),
                     {ImGui::GetContentRegionAvail().x, controls.style().scaled(plotHeight)});
    return mean;
}

void drawPasses(Controls& controls, const gpu::Timestamps& times)
{
    const std::size_t frames = lastOf(times, totalName).size();
    controls.section("Passes");
    double sum = 0.0;
    for (const std::string& name : times.names())
        if (name != totalName &&
            std::find(windowPasses.begin(), windowPasses.end(), name) == windowPasses.end())
            sum += drawPass(controls, times, name, frames);
    const double total = meanOf(lastOf(times, totalName), frames);
    controls.fact("not attributed", fmt::format("{:.2f} ms", std::max(total - sum, 0.0)),
                  "Device time of the picture between its passes: copies, clears and barriers");
    drawPass(controls, times, totalName, frames);
    controls.section("After the picture");
    for (const char* name : windowPasses)
        drawPass(controls, times, name, frames);
}

} // namespace

void drawProfilePanel(Controls& controls, ViewerState& state)
{
    controls.fact("Device", state.device, "Device that draws");
    controls.fact("Frame", fmt::format("{:.1f} ms", 1000.0 * state.frameSeconds),
                  "Time per frame, smoothed");
    controls.fact("Blades", countText(state.counts.total),
                  "Number of blades in the fields; of fields with seeds, all that would grow");
    if (state.counts.sown > 0)
        controls.fact("Sown", countText(state.counts.sown),
                      "Blades in memory that have been grown from the field's seeds");
    controls.fact("Simulated", countText(state.counts.simulated),
                  "Blades simulated in the last frame");
    controls.fact("Drawn", countText(state.counts.drawn), "Blades drawn in the last frame");
    controls.fact("Memory", bytesText(state.deviceBytes), "Device memory of fields and pictures");

    controls.section("Resolution");
    controls.toggle("Automatic", state.automaticScale,
                    "Lowers the resolution while frames take too long");
    ImGui::BeginDisabled(state.automaticScale);
    controls.number("Scale", state.scale, {static_cast<float>(InternalResolution::lowest), 1.0f},
                    "Resolution relative to the window");
    ImGui::EndDisabled();

    controls.toggle("Refine at rest", state.refinesAtRest,
                    "While nothing changes, stops time and refines one picture with all pixels and "
                    "blades; off: keeps drawing");

    if (state.times == nullptr || state.times->names().empty()) {
        controls.section("Passes");
        controls.note("This device measures no times.");
        return;
    }
    drawPasses(controls, *state.times);
    if (controls.button("Reset times", "Discards all measurements", true))
        state.requests.forgetTimes = true;
}

} // namespace sward::view
