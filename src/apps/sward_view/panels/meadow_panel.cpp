#include "apps/common/field_input.h"
#include "apps/sward_view/interface/units.h"
#include "apps/sward_view/panels/panels.h"

#include <fmt/core.h>

#include <array>
#include <filesystem>

namespace sward::view {
namespace {

constexpr std::array amounts{"automatic", "density", "spacing", "count"};

void drawAmount(Controls& controls, MeadowRequests& meadow)
{
    controls.choice("Amount", meadow.amount, amounts, "What the number of blades depends on");
    if (meadow.amount == 1)
        controls.number("Density", meadow.density, {1.0f, 100'000.0f, "/m²", "%.0f", true},
                        "Blades per square metre");
    if (meadow.amount == 2)
        controls.number("Spacing", meadow.spacing, {0.001f, 10.0f, "m", "%.3f", true},
                        "Smallest distance between two roots");
    if (meadow.amount == 3)
        controls.wholeNumber("Count", meadow.count, 1, 5'000'000, "Exact number of blades");
}

void drawProgress(Controls& controls, ViewerState& state)
{
    const BakeProgress& progress = state.baking->progress();
    const std::string stageName = progress.state.empty() ? "starting" : progress.state;
    ImGui::PushStyleColor(ImGuiCol_PlotHistogram, controls.style().color(palette::accent, 0.55f));
    ImGui::ProgressBar(static_cast<float>(progress.share), {-1.0f, 0.0f},
                       fmt::format("{}  {:.0f} %", stageName, 100.0 * progress.share).c_str());
    ImGui::PopStyleColor();
    controls.tell("Progress", stageName, "Stage of the bake");
    if (controls.button("Cancel", "Cancels the bake; the field that is shown stays", true))
        state.requests.cancelBake = true;
}

} // namespace

void drawMeadowPanel(Controls& controls, ViewerState& state)
{
    MeadowRequests& meadow = state.meadow;
    bool browses = false;
    controls.file("Ground", meadow.ground, "a mesh, a recipe, or hills",
                  "What grass grows on: .glb .gltf .obj .ply .stl .off, a heightmap, a recipe "
                  ".json, or plane sphere hills dunes torus arch",
                  browses);
    if (browses)
        state.files =
            FileDialog{.browser = {std::filesystem::path(meadow.ground).parent_path(),
                                   apps::groundExtensions()},
                       .title = "Ground",
                       .verb = "Choose",
                       .act = [&meadow](const std::string& path) { meadow.ground = path; }};
    ImGui::BeginDisabled(!meadow.meadowFile.empty());
    drawMeadowChoice(controls, state);
    ImGui::EndDisabled();
    controls.file(
        "Meadow file", meadow.meadowFile, "none: the meadow above",
        "A meadow of your own (.json, as for sward bake --meadow), sown instead of the one "
        "above; with --watch the field is baked again when it changes",
        browses);
    if (browses)
        state.files = FileDialog{
            .browser = {std::filesystem::path(meadow.meadowFile).parent_path(), {".json"}},
            .title = "Meadow file",
            .verb = "Choose",
            .act = [&meadow](const std::string& path) { meadow.meadowFile = path; }};
    drawSpeciesEditor(controls, state);
    drawAmount(controls, meadow);
    controls.number("Slope from", meadow.slopeLow, {0.0f, 180.0f, "°", "%.0f"},
                    "Smallest slope on which grass grows");
    controls.number("Slope to", meadow.slopeHigh, {0.0f, 180.0f, "°", "%.0f"},
                    "Largest slope on which grass grows; undersides are above 90°");
    controls.number("Slope fades", meadow.slopeSoft, {0.0f, 90.0f, "°", "%.0f"},
                    "Width over which grass thins out beyond both limits");
    controls.text(
        "Masks", meadow.masks, "vertex-color:R",
        "Multiply the density: vertex-color:C, texture:FILE:C or material-texture:C, "
        "with C one of R G B A, or ground:green, and perhaps :invert; separated by "
        "blanks. Empty: the green of ground that is clearly green in part; none: no mask");
    controls.text("Changed keys", meadow.traits, "clump_size_m=1",
                  "Changes of the meadow's keys: KEY=VALUE as for sward bake --set, separated by "
                  "blanks");
    controls.wholeNumber("Random seed", meadow.seed, 0, 9999, "Start value of the random numbers");

    controls.space(4.0f);
    if (state.baking != nullptr) {
        drawProgress(controls, state);
    } else {
        ImGui::BeginDisabled(meadow.ground.empty());
        if (controls.button("Bake again",
                            "Bakes with these settings; the present field stays until it is done",
                            true))
            state.requests.bake = true;
        ImGui::EndDisabled();
        if (meadow.ground.empty())
            controls.note("A field file does not contain its ground. Enter its name above, or "
                          "drop the mesh on the window.");
    }

    if (state.difference) {
        const BakeDifference& difference = *state.difference;
        controls.section("Before and after");
        controls.fact("Blades",
                      fmt::format("{} to {}", countText(difference.bladesBefore),
                                  countText(difference.bladesAfter)),
                      "Number of blades before and after the last bake");
        controls.fact(
            "Mean height",
            fmt::format("{:.2f} to {:.2f} m", difference.heightBefore, difference.heightAfter),
            "Mean height of all blades before and after");
        bool former = state.showsFormer;
        if (controls.toggle("Show before", former, "Shows the field before the last bake"))
            state.requests.compare = true;
    }
    if (!state.bakeReport.empty()) {
        controls.section("Last bake");
        ImGui::PushTextWrapPos(0.0f);
        ImGui::TextUnformatted(state.bakeReport.c_str());
        ImGui::PopTextWrapPos();
        controls.tell("Report", state.bakeReport, "Roots kept, and roots rejected by reason");
    }
}

} // namespace sward::view
