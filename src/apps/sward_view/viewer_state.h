#pragma once

#include "apps/sward_view/fields/baking.h"
#include "apps/sward_view/fields/meadow_requests.h"
#include "apps/sward_view/fields/meadow_species.h"
#include "apps/sward_view/fields/picking.h"
#include "apps/sward_view/fields/shown_field.h"
#include "apps/sward_view/files/file_browser.h"
#include "apps/sward_view/files/recent_files.h"
#include "apps/sward_view/navigation/collider_dragger.h"
#include "apps/sward_view/paint/painter.h"
#include "apps/sward_view/paint/stroke_desk.h"
#include "apps/sward_view/question.h"
#include "apps/sward_view/requests.h"
#include "gpu/recording/timestamps.h"
#include "render/frame/frame_settings.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace sward::view {

/// Field time, controlled by the user.
struct FieldTime {
    double now = 0.0;   ///< [s]
    double scale = 1.0; ///< field seconds per second
    bool paused = false;
    bool stepOnce = false;    ///< advance one `step` while paused
    double step = 1.0 / 60.0; ///< [s]
};

/// Changes between a field and its new bake.
struct BakeDifference {
    std::uint64_t bladesBefore = 0, bladesAfter = 0;
    double heightBefore = 0.0, heightAfter = 0.0; ///< [m] mean
};

/// Everything that the panels show and change. The next frame uses the changes.
struct ViewerState {
    // Changed by the panels.
    render::FrameSettings settings;
    FieldTime time;
    MeadowRequests meadow;
    std::optional<MeadowEditor> editor; ///< of the meadow's species, if they are edited
    ColliderDragger hand;
    Brush brush;
    StrokeDesk desk;
    std::string strokesFile;          ///< strokes to begin painting with; empty: none
    std::unique_ptr<Painter> painter; ///< while the field is painted
    bool automaticScale = true;
    float scale = 1.0f;         ///< of the window's pixels that are drawn
    bool refinesAtRest = false; ///< fine pictures, and no time, while nothing changes
    std::string settingsFile = "settings.json";
    std::string pictureFile = "sward.png";
    std::string sequenceFiles = "frame_%04d.png";
    std::string pathFile = "camera_path.json";
    std::string videoFile = "sward.mp4";
    std::string fieldFile;             ///< of the chosen field, if it was baked in this window
    std::string another;               ///< typed name of a field or ground
    bool dropAdds = false;             ///< dropped files are added to the shown fields
    bool makesVideo = false;           ///< record a sequence as a video
    int sequenceLength = 120;          ///< frames
    float sequenceStep = 1.0f / 30.0f; ///< [s]
    double hour = 9.0;                 ///< [h] time of day of the sun's place
    bool showWindArrows = false;
    bool showColliders = false;
    Requests requests;
    std::optional<Question> question;
    std::optional<FileDialog> files; ///< choice of a file, while it is open

    // Set by the viewer.
    const ShownField* field = nullptr; ///< none yet: null
    std::size_t chosen = 0;            ///< index of the chosen member
    const gpu::Timestamps* times = nullptr;
    const RecentFiles* recent = nullptr;
    render::FrameStats counts;
    std::size_t deviceBytes = 0;
    double frameSeconds = 0.0;                 ///< smoothed
    std::optional<std::uint32_t> passesAtRest; ///< pictures in the mean; none: something changes
    std::uint64_t drawnAtRest = 0; ///< blades in the fine picture; more than once if in two tiles
    std::string device;
    std::string loading; ///< current load; empty: none
    const Baking* baking = nullptr;
    std::string bakeReport; ///< report of the last bake, by reason
    std::optional<BakeDifference> difference;
    bool showsFormer = false; ///< shows the field before the last bake
    std::optional<PickedBlade> picked;
    std::string error;       ///< stays until it is closed
    std::string shaderError; ///< stays until the shaders compile again
    std::string notice;      ///< disappears automatically
    bool hasFfmpeg = false;  ///< required for videos
    glm::vec2 brushAt{0.0f}; ///< where the cursor was when the stroke was last made longer
    std::vector<std::vector<glm::dvec3>> rings; ///< of the brush on the ground, world [m]
    float heading = 0.0f;                       ///< [rad] of the view: 0 is +x, π/2 is +z
    bool walking = false;
    bool recording = false;
    bool replaying = false;
    double flySpeed = 0.0;        ///< [m/s]
    std::size_t sequenceDone = 0; ///< pictures taken; 0: no sequence
};

} // namespace sward::view
