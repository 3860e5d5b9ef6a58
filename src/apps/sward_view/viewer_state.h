#pragma once

#include "apps/sward_view/baking.h"
#include "apps/sward_view/collider_dragger.h"
#include "apps/sward_view/meadow_requests.h"
#include "apps/sward_view/picking.h"
#include "apps/sward_view/recent_files.h"
#include "apps/sward_view/shown_field.h"
#include "gpu/timestamps.h"
#include "render/frame_settings.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace sward::view {

/// The time of the field, as the user lets it pass.
struct FieldTime {
    double now = 0.0;   ///< [s]
    double scale = 1.0; ///< field seconds per second
    bool paused = false;
    bool stepOnce = false;    ///< takes one step of `step` although it is paused
    double step = 1.0 / 60.0; ///< [s]
};

/// A field before and after it was baked again.
struct BakeDifference {
    std::uint64_t bladesBefore = 0, bladesAfter = 0;
    double heightBefore = 0.0, heightAfter = 0.0; ///< [m] mean
};

/// What the panels ask the viewer for; it does that between two frames.
struct Requests {
    std::vector<std::string> open;     ///< instead of what is shown
    std::vector<std::string> add;      ///< to what is shown
    std::optional<std::size_t> remove; ///< a field by its number
    std::optional<std::size_t> choose; ///< the field that is baked again
    std::optional<std::string> loadSettings;
    std::optional<std::string> saveSettings;
    std::optional<std::string> saveCamera;
    std::optional<std::string> replayPath;
    bool resetSettings = false;
    bool bake = false;
    bool cancelBake = false;
    bool compare = false; ///< the field before the last bake, or the one after it
    bool frameField = false;
    bool goHome = false;
    bool walk = false;   ///< or no longer
    bool freeze = false; ///< or no longer
    bool record = false; ///< or no longer
    bool picture = false;
    bool sequence = false; ///< or no longer
    bool forgetTimes = false;
};

/// Everything that the panels show and turn. What is turned is obeyed by the next frame.
struct ViewerState {
    // Turned by the panels.
    render::FrameSettings settings;
    FieldTime time;
    MeadowRequests meadow;
    ColliderDragger hand;
    bool automaticScale = true;
    float scale = 1.0f; ///< of the window's pixels that are drawn
    std::string settingsFile = "settings.json";
    std::string pictureFile = "sward.png";
    std::string sequenceFiles = "frame_%04d.png";
    std::string pathFile = "camera_path.json";
    std::string videoFile = "sward.mp4";
    std::string another;               ///< field or ground that is typed in
    bool dropAdds = false;             ///< what is dropped is shown beside the rest
    bool makesVideo = false;           ///< of a sequence, instead of numbered pictures
    int sequenceLength = 120;          ///< frames
    float sequenceStep = 1.0f / 30.0f; ///< [s]
    bool showWindArrows = false;
    bool showColliders = false;
    Requests requests;

    // Told by the viewer.
    const ShownField* field = nullptr; ///< none yet: null
    std::size_t chosen = 0;            ///< of its members
    const gpu::Timestamps* times = nullptr;
    const RecentFiles* recent = nullptr;
    render::FrameStats counts;
    std::size_t deviceBytes = 0;
    double frameSeconds = 0.0; ///< smoothed
    std::string device;
    std::string loading; ///< what is being read; empty: nothing
    const Baking* baking = nullptr;
    std::string bakeReport; ///< of the last bake, by reason
    std::optional<BakeDifference> difference;
    bool showsFormer = false; ///< the field before the last bake
    std::optional<PickedBlade> picked;
    std::string error;       ///< stays until it is closed
    std::string shaderError; ///< stays until the shaders compile again
    std::string notice;      ///< goes by itself
    bool hasFfmpeg = false;  ///< which makes films
    float heading = 0.0f;    ///< [rad] of the view: 0 is +x, π/2 is +z
    bool walking = false;
    bool recording = false;
    bool replaying = false;
    double flySpeed = 0.0;        ///< [m/s]
    std::size_t sequenceDone = 0; ///< pictures; 0 while none is taken
};

} // namespace sward::view
