#include "apps/sward_view/interface/units.h"
#include "apps/sward_view/panels/panels.h"
#include "render/frame/cull_tests.h"
#include "shaders/shared/cull_result_color.h"

#include <fmt/core.h>

#include <array>

namespace sward::view {
namespace {

constexpr float farthest = 20'000.0f; ///< [m] end of the slider

constexpr std::array debugWords{"none", "level of detail", "patches", "wind", "reason"};

// One control per test, in the order of render::cullTests.
struct Row {
    const char* name;
    const char* about;
    std::uint32_t cullResult;
    std::uint64_t render::FrameStats::*count;
};
constexpr std::array<Row, 5> rows{
    {{"Patch", "Culls whole patches outside of the view or beyond the draw distance",
      shared::cullResultPatch, &render::FrameStats::culledPatch},
     {"Orientation", "Culls blades seen edge-on", shared::cullResultOrientation,
      &render::FrameStats::culledOrientation},
     {"Frustum", "Culls blades outside of the view frustum", shared::cullResultFrustum,
      &render::FrameStats::culledFrustum},
     {"Distance", "Culls blades beyond the draw distance", shared::cullResultDistance,
      &render::FrameStats::culledDistance},
     {"Occlusion", "Culls blades hidden by the ground", shared::cullResultOcclusion,
      &render::FrameStats::culledOcclusion}}};

// A dot in the colour of the "reason" debug mode, and a count.
void drawCount(Controls& controls, const char* name, std::uint32_t cullResult, std::uint64_t count)
{
    const glm::vec3 color = shared::cullResultColor(cullResult);
    const ImVec2 place = ImGui::GetCursorScreenPos();
    const float middle = place.y + 0.5f * ImGui::GetFrameHeight();
    const Style& style = controls.style();
    ImGui::GetWindowDrawList()->AddCircleFilled({place.x + style.scaled(5.0f), middle},
                                                style.scaled(4.5f), packedLinear(color), 16);
    ImGui::Dummy({style.scaled(14.0f), ImGui::GetFrameHeight()});
    ImGui::SameLine();
    ImGui::AlignTextToFramePadding();
    const std::string text = countText(count);
    ImGui::TextUnformatted(text.c_str());
    controls.tell(fmt::format("{} count", name).c_str(), std::to_string(count),
                  "Number of blades with this result in the last frame");
}

void drawTests(Controls& controls, ViewerState& state)
{
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const std::uint32_t bit = render::cullTests[i].bit;
        bool isOn = (state.settings.cullMask & bit) != 0;
        if (controls.toggle(rows[i].name, isOn, rows[i].about))
            state.settings.cullMask ^= bit;
        ImGui::SameLine();
        drawCount(controls, rows[i].name, rows[i].cullResult, state.counts.*rows[i].count);
    }
    controls.toggle("Detail", state.settings.levelOfDetail,
                    "Level of detail: leaves out blades thinner than a pixel and widens others");
    ImGui::SameLine();
    drawCount(controls, "Detail", shared::cullResultLod, state.counts.lod);
    ImGui::AlignTextToFramePadding();
    controls.note("Drawn");
    ImGui::SameLine(
        ImGui::GetWindowContentRegionMin().x +
        0.4f * (ImGui::GetWindowContentRegionMax().x - ImGui::GetWindowContentRegionMin().x) +
        ImGui::GetFrameHeight() + ImGui::GetStyle().ItemSpacing.x);
    drawCount(controls, "Drawn", shared::cullResultDrawn, state.counts.drawn);
}

} // namespace

void drawCullingPanel(Controls& controls, ViewerState& state)
{
    render::FrameSettings& settings = state.settings;
    drawTests(controls, state);
    controls.section("Bounds");
    // Beyond the slider's end every blade is drawn.
    const bool all = settings.environment.drawDistance >= farthest;
    if (controls.number("Draw distance", settings.environment.drawDistance,
                        {0.5f, farthest, "m", all ? "all" : "%.1f", true},
                        "Blades farther away are not drawn; at the right end all are") &&
        settings.environment.drawDistance >= farthest)
        settings.environment.drawDistance = field::Defaults().drawDistance;
    controls.number("Detail threshold", settings.lodThreshold, {0.01f, 8.0f, "px", "%.2f", true},
                    "Width on the screen below which blades are left out and others widened");

    controls.number("Leaf area limit", settings.maxLeafArea, {0.0f, 256.0f, "", "%.0f", true},
                    "Most leaf area that a ray through far dense grass meets; 0: no limit");

    controls.section("Colours");
    int mode = static_cast<int>(settings.debug);
    if (controls.choice("Colour by", mode, debugWords,
                        "Debug colours; reason shows each blade in the colour of its culling test"))
        settings.debug = static_cast<render::DebugMode>(mode);

    controls.section("Culling camera");
    bool frozen = settings.cullingCamera.has_value();
    if (controls.toggle("Frozen", frozen,
                        "Keeps the camera of culling here while the view moves on, and draws its "
                        "frustum (C)"))
        state.requests.freeze = true;
    controls.note(frozen ? "Blades are culled from the frozen camera. Move away and look back."
                         : "Freeze it and move away to see which blades it culls.");
}

} // namespace sward::view
