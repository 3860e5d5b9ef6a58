#pragma once

#include "apps/sward_view/bookmarks.h"
#include "apps/sward_view/capture.h"
#include "apps/sward_view/interface/controls.h"
#include "apps/sward_view/interface/interface.h"
#include "apps/sward_view/interface/layout.h"
#include "apps/sward_view/internal_resolution.h"
#include "apps/sward_view/loaded_field.h"
#include "apps/sward_view/opening.h"
#include "apps/sward_view/path_recorder.h"
#include "apps/sward_view/scaled_picture.h"
#include "apps/sward_view/shader_sources.h"
#include "apps/sward_view/viewer_options.h"
#include "apps/sward_view/viewer_state.h"
#include "apps/sward_view/watched_file.h"
#include "apps/sward_view/window.h"
#include "gpu/frame_ring.h"

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace sward::view {

/// Shows fields in a window: steers the camera, keeps the time, draws with two frames in flight,
/// and does what its panels ask for.
class Viewer {
public:
    /// `window` and what `options` point to outlive it.
    Viewer(Window& window, const ViewerOptions& options);

    /// Until the window is closed. Throws Error{interrupted}, what the first field's opening
    /// throws, and an Error if the device is lost.
    void run();

    const gpu::Instance& instance() const { return instance_; }

private:
    using Clock = std::chrono::steady_clock;

    // viewer.cpp: from frame to frame
    void look();
    bool draw();
    void keepTime();
    void tell();
    double scaleOfFrame() const;
    float aspect() const;

    // viewer_input.cpp: what the user does
    void steer(Input input);
    void press(const KeyPress& key);
    bool handleColliders(const Input& input, bool mouse);
    void pick(glm::vec2 pixel);
    void freeze();
    void record();
    Sight sightAt(glm::vec2 pixel) const;

    // viewer_requests.cpp: what takes longer than a frame
    void fulfil();
    void fulfilFiles(const Requests& requests);
    void complain(const std::string& message);
    void notice(const std::string& message);

    // viewer_fields.cpp: which fields are shown
    void fulfilFields(const Requests& requests);
    void open(std::vector<std::string> inputs);
    void exchange(std::size_t member, const std::string& input, const MeadowRequests& requests);
    void takeOpened();
    void show(Opening::Opened opened);
    void choose(std::size_t member);
    void watch();
    void reloadShaders();

    Window& window_;
    const ViewerOptions& options_;
    gpu::Instance instance_;
    gpu::Surface surface_;
    gpu::Device device_;
    gpu::Swapchain swapchain_;
    Interface interface_;
    gpu::FrameRing ring_;
    gpu::Timestamps timestamps_;
    ScaledPicture picture_;

    ViewerState viewerState_;
    RecentFiles recent_;
    Bookmarks bookmarks_;
    ControlMap controlMap_;
    Controls controls_;
    Layout layout_;
    std::optional<ShaderSources> shaders_;
    std::shared_ptr<const ShaderModules> goodShaders_; ///< that have drawn; null: built in
    std::unique_ptr<LoadedField> loadedField_;
    std::unique_ptr<LoadedField> former_; ///< before the last bake
    Opening opening_;
    std::vector<std::string> waiting_; ///< to be shown beside the rest
    PathRecorder recorder_;
    Capture capture_;
    InternalResolution resolution_;
    std::optional<WatchedFile> watchedSettings_;

    Clock::time_point begun_;
    Clock::time_point lastTick_;
    Clock::time_point lastTitle_;
    Clock::time_point lastLook_; ///< at watched files and the picked blade
    Clock::time_point lastNotice_;
    std::optional<Clock::time_point> firstShown_;
    double frameBefore_ = 0.0;  ///< [s] of the field
    double frameSeconds_ = 0.0; ///< real, since the frame before
    bool isFirstInput_ = true;  ///< what goes wrong with it ends the program
    bool dragsCollider_ = false;
    std::uint64_t frames_ = 0; ///< of this field
    std::uint64_t framesAtTitle_ = 0;
};

} // namespace sward::view
