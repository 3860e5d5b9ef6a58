#include "apps/sward_view/panels/panels.h"

#include <fmt/core.h>

namespace sward::view {

void drawCapturePanel(Controls& controls, ViewerState& state)
{
    controls.section("Picture");
    controls.text("Picture file", state.pictureFile, "sward.png",
                  "PNG file of the picture without panels, at the full resolution of the window");
    if (controls.button("Take picture",
                        "Writes the next frame; if the file exists, under the next free name (P)",
                        true))
        state.requests.picture = true;

    controls.section("Sequence");
    ImGui::BeginDisabled(!state.hasFfmpeg);
    controls.toggle("Video", state.makesVideo,
                    state.hasFfmpeg ? "Encodes the pictures as a video with ffmpeg"
                                    : "Needs the program ffmpeg, which is not installed here "
                                      "(Debian: apt install ffmpeg)");
    ImGui::EndDisabled();
    if (state.makesVideo)
        controls.text("Video file", state.videoFile, "sward.mp4",
                      "The extension decides the format: .mp4, .mkv, .webm, .gif");
    else
        controls.text("File pattern", state.sequenceFiles, "frame_%04d.png",
                      "Names of the pictures, with %d or %04d for the number");
    controls.wholeNumber("Pictures", state.sequenceLength, 1, 10'000, "Number of pictures");
    controls.number("Interval", state.sequenceStep, {0.001f, 1.0f, "s", "%.4f", true},
                    "Simulated time between two pictures");
    const bool runs = state.sequenceDone > 0;
    if (controls.button(runs ? "Stop sequence" : "Take sequence",
                        "Draws pictures at a fixed interval of simulated time", true))
        state.requests.sequence = true;
    if (runs)
        controls.note(fmt::format("{} of {} pictures", state.sequenceDone, state.sequenceLength));
    if (!state.hasFfmpeg)
        controls.note("To make a video of them: ffmpeg -framerate 30 -i frame_%04d.png sward.mp4");

    controls.section("Settings");
    controls.text("Settings file", state.settingsFile, "settings.json",
                  "JSON file, as for --settings of render, bench and this window");
    if (controls.button(
            "Save settings",
            "Writes wind, physics, colliders, culling and look; asks if the file exists"))
        state.requests.saveSettings = state.settingsFile;
    ImGui::SameLine();
    if (controls.button("Load settings", "Applies the settings of the file; others stay"))
        state.requests.loadSettings = state.settingsFile;
    if (controls.button("Reset to the field's settings",
                        "Restores the settings that are stored in the field", true))
        state.requests.resetSettings = true;
}

} // namespace sward::view
