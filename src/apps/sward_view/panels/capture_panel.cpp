#include "apps/sward_view/panels/panels.h"

#include <fmt/core.h>

namespace sward::view {

void drawCapturePanel(Controls& controls, Stage& stage)
{
    controls.section("Picture");
    controls.text("Picture file", stage.pictureFile, "sward.png",
                  "A PNG of what is shown, without panels, with every pixel of the window");
    if (controls.button("Take picture", "Writes it; an older file of that name goes (P)", true))
        stage.wishes.picture = true;

    controls.section("Sequence");
    ImGui::BeginDisabled(!stage.hasFfmpeg);
    controls.toggle("Film", stage.makesFilm,
                    stage.hasFfmpeg ? "ffmpeg makes a film of the pictures while they come"
                                    : "Needs the program ffmpeg, which is not installed here "
                                      "(Debian: apt install ffmpeg)");
    ImGui::EndDisabled();
    if (stage.makesFilm)
        controls.text("Film file", stage.filmFile, "sward.mp4",
                      "Its ending says in which format: .mp4, .mkv, .webm, .gif");
    else
        controls.text("Picture names", stage.sequenceFiles, "frame_%04d.png",
                      "With %d or %04d for the number");
    controls.wholeNumber("Pictures", stage.sequenceLength, 1, 10'000, "How many");
    controls.number("Apart", stage.sequenceStep, {0.001f, 1.0f, "s", "%.4f", true},
                    "Time of the field from picture to picture");
    const bool runs = stage.sequenceDone > 0;
    if (controls.button(runs ? "Stop sequence" : "Take sequence",
                        "Draws at a fixed step, however long each picture takes", true))
        stage.wishes.sequence = true;
    if (runs)
        controls.note(fmt::format("{} of {} pictures", stage.sequenceDone, stage.sequenceLength));
    if (!stage.hasFfmpeg)
        controls.note("ffmpeg -framerate 30 -i frame_%04d.png sward.mp4 makes a film of them.");

    controls.section("Settings");
    controls.text("Settings file", stage.settingsFile, "settings.json",
                  "JSON that render, bench and this window take with --settings");
    if (controls.button("Save settings", "Writes wind, physics, colliders, culling and look"))
        stage.wishes.saveSettings = stage.settingsFile;
    ImGui::SameLine();
    if (controls.button("Load settings", "Lays the file over what is set"))
        stage.wishes.loadSettings = stage.settingsFile;
    if (controls.button("Field's own settings", "Back to what the field was saved with", true))
        stage.wishes.resetSettings = true;
}

} // namespace sward::view
