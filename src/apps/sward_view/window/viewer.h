#pragma once

#include "apps/sward_view/files/shader_sources.h"
#include "apps/sward_view/interface/interface.h"
#include "apps/sward_view/navigation/bookmarks.h"
#include "apps/sward_view/navigation/path_recorder.h"
#include "apps/sward_view/panels/layout.h"
#include "apps/sward_view/picture/capture.h"
#include "apps/sward_view/picture/internal_resolution.h"
#include "apps/sward_view/window/frame_times.h"
#include "apps/sward_view/window/loaded_field.h"
#include "apps/sward_view/window/opening.h"
#include "apps/sward_view/window/rest.h"
#include "apps/sward_view/window/viewer_options.h"
#include "apps/sward_view/window/window.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace sward::view {

/// Shows fields in a window: camera, time, two frames in flight, the requests of its panels.
class Viewer {
public:
    /// `window` and objects referenced by `options` must outlive this.
    Viewer(Window& window, const ViewerOptions& options);
    /// Until the window is closed. Throws Error{interrupted}, and as opening the first field does.
    void run();
    const gpu::Instance& instance() const { return instance_; }

private:
    using Clock = FrameTimes::Clock;
    // viewer.cpp: the frame loop, and drawing while nothing changes
    void look();
    bool draw();
    bool drawMoving();
    void present(const gpu::FrameRing::Frame& frame, const gpu::Swapchain::Target& target);
    void keepTime();
    void tell();
    bool hasChanged();
    AtRest::Draws drawsNext();
    bool drawRefined(AtRest::Draws draws);
    // viewer_input.cpp: mouse and keys
    void steer(Input& input);
    KeyboardFocus::Keys keysForControls(Input& input) const;
    void pressKeys(const Input& input);
    void press(const KeyPress& key);
    void useBookmark(const KeyPress& key);
    bool handleColliders(const Input& input, bool mouse);
    void pick(glm::vec2 pixel);
    Pane paneBesidePanel() const;
    std::uint32_t pictureShift() const;
    Sight sightAt(glm::vec2 place) const;
    Style::Scale uiScale() const;
    // viewer_paint.cpp: the brush
    void steerBrush(Input& input, bool mouse);
    void followPainter();
    void fulfilPainting(const Requests& requests);
    void offerLeftStrokes();
    void startPainting(std::optional<std::filesystem::path> left);
    void endPainting();
    void drawEditable(bool isEditable);
    // viewer_requests.cpp: what takes longer than a frame: requests, shown fields, saving
    void fulfil();
    void fulfilFiles(const Requests& requests);
    void complain(const std::string& message);
    void notice(const std::string& message);
    void write(const gpu::Image& image);
    void record();
    void fulfilFields(const Requests& requests);
    void open(std::vector<std::string> inputs);
    void exchange(std::size_t member, const std::string& input, const MeadowRequests& requests);
    void takeOpened();
    void show(Opening::Opened opened);
    void choose(std::size_t member);
    void watch();
    void reloadShaders();
    bool isDone();
    bool closeTopmost();
    void askToSave(OpenedFields fields, const std::string& verb, std::function<void()> act);
    void saveField(OpenedField& field, const std::filesystem::path& path, bool replaces);
    void writeUnlessTaken(const std::filesystem::path& path,
                          std::function<void(const std::filesystem::path&, bool)> write);
    void writeText(const std::filesystem::path& path, std::string text);
    void startSequence();
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
    Rest rest_;
    ViewerState viewerState_;
    RecentFiles recent_;
    Bookmarks bookmarks_;
    ControlMap controlMap_;
    Controls controls_;
    Layout layout_;
    std::optional<ShaderSources> shaders_;
    std::shared_ptr<const ShaderModules> goodShaders_; ///< last working shaders; null: built-in
    std::unique_ptr<LoadedField> loadedField_;
    std::unique_ptr<LoadedField> former_; ///< field before the last bake
    Opening opening_;
    std::vector<std::string> waiting_; ///< inputs to be added
    PathRecorder recorder_;
    Capture capture_;
    InternalResolution resolution_;
    std::optional<WatchedFile> watchedSettings_;
    FrameTimes times_;
    int uiZoom_ = 0; ///< steps of text and controls by the user's keys
    bool isFirstInput_ = true, dragsCollider_ = false, isClosing_ = false; ///< closing: in any case
};

} // namespace sward::view
