#include "apps/sward_view/panels/panels.h"

#include <fmt/core.h>

namespace sward::view {

void drawCameraPanel(Controls& controls, Stage& stage)
{
    if (controls.button("Frame field", "Shows all of it (F)"))
        stage.wishes.frameField = true;
    ImGui::SameLine();
    if (controls.button("Home", "Back to where the camera started (Home)"))
        stage.wishes.goHome = true;
    bool walks = stage.walking;
    if (controls.toggle("Walk", walks,
                        "Stand on the ground and go with W A S D, around a planet too (G)"))
        stage.wishes.walk = true;
    controls.fact("Speed", fmt::format("{:.2f} m/s", stage.flySpeed),
                  "Of flying with the right button held; the wheel changes it meanwhile");
    controls.section("Bookmarks");
    controls.note("1 to 9 recall a place, Ctrl+1 to Ctrl+9 set it. At first 1 is the whole field, "
                  "2 at eye level, 3 from above, 4 from its border, then those of the field. They "
                  "are there again in the next run.");

    controls.section("Path");
    controls.text("File", stage.pathFile, "camera_path.json",
                  "A timed list of cameras, as render and bench take with --camera");
    bool records = stage.recording;
    if (controls.toggle("Record", records,
                        "Notes the camera ten times a second; written when it ends (R)"))
        stage.wishes.record = true;
    if (controls.button(stage.replaying ? "Stop" : "Replay",
                        "Plays the file, a sixtieth of a second a frame", true))
        stage.wishes.replayPath = stage.pathFile;
    if (controls.button("Save this camera", "Writes the camera as it is now into the file", true))
        stage.wishes.saveCamera = stage.pathFile;
}

} // namespace sward::view
