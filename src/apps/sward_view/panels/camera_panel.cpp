#include "apps/sward_view/panels/panels.h"

#include <fmt/core.h>

namespace sward::view {

void drawCameraPanel(Controls& controls, ViewerState& state)
{
    if (controls.button("Frame field", "Shows all of it (F)"))
        state.requests.frameField = true;
    ImGui::SameLine();
    if (controls.button("Home", "Back to where the camera started (Home)"))
        state.requests.goHome = true;
    bool walks = state.walking;
    if (controls.toggle("Walk", walks,
                        "Stand on the ground and go with W A S D, around a planet too (G)"))
        state.requests.walk = true;
    controls.fact("Speed", fmt::format("{:.2f} m/s", state.flySpeed),
                  "Of flying with the right button held; the wheel changes it meanwhile");
    controls.section("Bookmarks");
    controls.note("1 to 9 recall a place, Ctrl+1 to Ctrl+9 set it. At first 1 is the whole field, "
                  "2 at eye level, 3 from above, 4 from its border, then those of the field. They "
                  "are there again in the next run.");

    controls.section("Path");
    controls.text("File", state.pathFile, "camera_path.json",
                  "A timed list of cameras, as render and bench take with --camera");
    bool records = state.recording;
    if (controls.toggle("Record", records,
                        "Notes the camera ten times a second; written when it ends (R)"))
        state.requests.record = true;
    if (controls.button(state.replaying ? "Stop" : "Replay",
                        "Plays the file, a sixtieth of a second a frame", true))
        state.requests.replayPath = state.pathFile;
    if (controls.button("Save this camera",
                        "Writes the camera as it is now into the file; asks if the file exists",
                        true))
        state.requests.saveCamera = state.pathFile;
}

} // namespace sward::view
