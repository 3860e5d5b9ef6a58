#include "apps/sward_view/panels/panels.h"

#include <fmt/core.h>

namespace sward::view {

void drawCapturePanel(Controls& controls, ViewerState& state)
{
    controls.section("Picture");
    controls.text("Picture file", state.pictureFile, "sward.png",
                  "A PNG of what is shown, without panels, with every pixel of the window");
    if (controls.button("Take picture",
                        "Writes the next frame; if the file exists, under the next free name (P)",
                        true))
        state.requests.picture = true;

    controls.section("Sequence");
    ImGui::BeginDisabled(!state.hasFfmpeg);
    controls.toggle("Film", state.makesVideo,
                    state.hasFfmpeg ? "ffmpeg makes a film of the pictures while they come"
                                    : "Needs the program ffmpeg, which is not installed here "
                                      "(Debian: apt install ffmpeg)");
    ImGui::EndDisabled();
    if (state.makesVideo)
        controls.text("VideoEncoder file", state.videoFile, "sward.mp4",
                      "Its ending says in which format: .mp4, .mkv, .webm, .gif");
    else
        controls.text("Picture names", state.sequenceFiles, "frame_%04d.png",
                      "With %d or %04d for the number");
    controls.wholeNumber("Pictures", state.sequenceLength, 1, 10'000, "How many");
    controls.number("Apart", state.sequenceStep, {0.001f, 1.0f, "s", "%.4f", true},
                    "Time of the field from picture to picture");
    const bool runs = state.sequenceDone > 0;
    if (controls.button(runs ? "Stop sequence" : "Take sequence",
                        "Draws at a fixed step, however long each picture takes", true))
        state.requests.sequence = true;
    if (runs)
        controls.note(fmt::format("{} of {} pictures", state.sequenceDone, state.sequenceLength));
    if (!state.hasFfmpeg)
        controls.note("ffmpeg -framerate 30 -i frame_%04d.png sward.mp4 makes a film of them.");

    controls.section("Settings");
    controls.text("Settings file", state.settingsFile, "settings.json",
                  "JSON that render, bench and this window take with --settings");
    if (controls.button(
            "Save settings",
            "Writes wind, physics, colliders, culling and look; asks if the file exists"))
        state.requests.saveSettings = state.settingsFile;
    ImGui::SameLine();
    if (controls.button("Load settings", "Lays the file over what is set"))
        state.requests.loadSettings = state.settingsFile;
    if (controls.button("Field's own settings", "Back to what the field was saved with", true))
        state.requests.resetSettings = true;
}

} // namespace sward::view
