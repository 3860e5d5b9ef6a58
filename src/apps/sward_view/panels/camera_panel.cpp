#include "apps/sward_view/panels/panels.h"

#include <fmt/core.h>

namespace sward::view {

void drawCameraPanel(Controls& controls, ViewerState& state)
{
    if (controls.button("Frame field", "Shows the whole field (F)"))
        state.requests.frameField = true;
    ImGui::SameLine();
    if (controls.button("Home", "Returns the camera to where it started (Home)"))
        state.requests.goHome = true;
    bool walks = state.walking;
    if (controls.toggle("Walk", walks, "Walks on the ground with W A S D, around a planet too (G)"))
        state.requests.walk = true;
    controls.fact("Speed", fmt::format("{:.2f} m/s", state.flySpeed),
                  "Speed of flying with the right mouse button held; the wheel changes it");
    controls.section("Bookmarks");
    controls.note(
        "1 to 9 recall a bookmark, Ctrl+1 to Ctrl+9 set it, for later runs too. Initially 1 shows "
        "the whole field, 2 eye level, 3 the field from above, 4 its border; then follow the "
        "cameras stored in the field.");

    controls.section("Path");
    controls.text("File", state.pathFile, "camera_path.json",
                  "Camera or timed list of cameras, as for --camera of render and bench");
    bool records = state.recording;
    if (controls.toggle(
            "Record", records,
            "Records the camera ten times a second; the file is written at the end (R)"))
        state.requests.record = true;
    if (controls.button(state.replaying ? "Stop" : "Replay",
                        "Plays the camera path of the file, 1/60 s per frame", true))
        state.requests.replayPath = state.pathFile;
    if (controls.button("Save this camera",
                        "Writes the current camera into the file; asks if the file exists", true))
        state.requests.saveCamera = state.pathFile;
}

} // namespace sward::view
