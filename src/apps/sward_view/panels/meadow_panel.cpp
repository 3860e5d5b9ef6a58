#include "apps/sward_view/interface/units.h"
#include "apps/sward_view/panels/panels.h"

#include <fmt/core.h>

#include <array>

namespace sward::view {
namespace {

constexpr std::array amounts{"the baker's", "density", "spacing", "count"};

void drawAmount(Controls& controls, MeadowRequests& meadow)
{
    controls.choice("Amount", meadow.amount, amounts, "What decides how many blades grow");
    if (meadow.amount == 1)
        controls.number("Density", meadow.density, {1.0f, 100'000.0f, "/m²", "%.0f", true},
                        "Blades per square metre");
    if (meadow.amount == 2)
        controls.number("Spacing", meadow.spacing, {0.001f, 10.0f, "m", "%.3f", true},
                        "Roots keep so far from one another");
    if (meadow.amount == 3)
        controls.wholeNumber("Count", meadow.count, 1, 5'000'000, "Blades kept, exactly");
}

void drawProgress(Controls& controls, ViewerState& state)
{
    const BakeProgress& progress = state.baking->progress();
    const std::string stageName = progress.state.empty() ? "starting" : progress.state;
    ImGui::PushStyleColor(ImGuiCol_PlotHistogram, controls.style().color(palette::accent, 0.55f));
    ImGui::ProgressBar(static_cast<float>(progress.share), {-1.0f, 0.0f},
                       fmt::format("{}  {:.0f} %", stageName, 100.0 * progress.share).c_str());
    ImGui::PopStyleColor();
    controls.tell("Progress", stageName, "What sward is doing, and how much of it is done");
    if (controls.button("Cancel", "Ends the bake; the field that is shown stays", true))
        state.requests.cancelBake = true;
}

} // namespace

void drawMeadowPanel(Controls& controls, ViewerState& state)
{
    MeadowRequests& meadow = state.meadow;
    controls.text("Ground", meadow.ground, "a mesh, a recipe, or hills",
                  "What grass grows on: .glb .gltf .obj .ply .stl .off, a heightmap, a recipe "
                  ".json, or plane sphere hills dunes torus arch");
    ImGui::BeginDisabled(!meadow.meadowFile.empty());
    controls.choice("Meadow", meadow.meadow, meadowNames, "What is sown: species and their shares");
    ImGui::EndDisabled();
    controls.text(
        "Meadow file", meadow.meadowFile, "none: the one above",
        "A meadow of your own (.json, as for sward bake --meadow), sown instead of the one "
        "above; with --watch the field is baked again when it changes");
    drawAmount(controls, meadow);
    controls.number("Slope from", meadow.slopeLow, {0.0f, 180.0f, "°", "%.0f"},
                    "Nothing grows on gentler slopes");
    controls.number("Slope to", meadow.slopeHigh, {0.0f, 180.0f, "°", "%.0f"},
                    "Nothing grows on steeper slopes; undersides are above 90°");
    controls.number("Slope fades", meadow.slopeSoft, {0.0f, 90.0f, "°", "%.0f"},
                    "Beyond both ends grass thins out over this many degrees");
    controls.text("Masks", meadow.masks, "vertex-color:R",
                  "Multiply the density: vertex-color:C, texture:FILE:C or material-texture:C, "
                  "with C one of R G B A and perhaps :invert; separated by blanks");
    controls.text("Traits", meadow.traits, "clump_size_m=1",
                  "Change the meadow: KEY=VALUE as for --set, separated by blanks");
    controls.wholeNumber("Seed", meadow.seed, 0, 9999, "Another number, another meadow");

    controls.space(4.0f);
    if (state.baking != nullptr) {
        drawProgress(controls, state);
    } else {
        ImGui::BeginDisabled(meadow.ground.empty());
        if (controls.button("Bake again",
                            "Runs sward with these settings; what is shown stays until it is done",
                            true))
            state.requests.bake = true;
        ImGui::EndDisabled();
        if (meadow.ground.empty())
            controls.note("A field file does not hold the mesh it was grown on. Name it above, or "
                          "drop it on the window.");
    }

    if (state.difference) {
        const BakeDifference& difference = *state.difference;
        controls.section("Before and after");
        controls.fact("Blades",
                      fmt::format("{} to {}", countText(difference.bladesBefore),
                                  countText(difference.bladesAfter)),
                      "Blades of the field before the last bake, and of the one after it");
        controls.fact(
            "Mean height",
            fmt::format("{:.2f} to {:.2f} m", difference.heightBefore, difference.heightAfter),
            "Of all blades");
        bool former = state.showsFormer;
        if (controls.toggle("Show before", former, "Shows the field before the last bake"))
            state.requests.compare = true;
    }
    if (!state.bakeReport.empty()) {
        controls.section("Last bake");
        ImGui::PushTextWrapPos(0.0f);
        ImGui::TextUnformatted(state.bakeReport.c_str());
        ImGui::PopTextWrapPos();
        controls.tell("Report", state.bakeReport, "Roots kept, and rejected by reason");
    }
}

} // namespace sward::view
