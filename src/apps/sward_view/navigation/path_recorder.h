#pragma once

#include "apps/sward_view/scene/camera_path.h"

#include <optional>
#include <string>

namespace sward::view {

/// Records a camera path and replays it at a fixed step.
class PathRecorder {
public:
    static constexpr double recordStep = 0.1;        ///< [s] between two recorded cameras
    static constexpr double replayStep = 1.0 / 60.0; ///< [s] from frame to frame

    void startRecording();

    /// Records the camera, `seconds` after the previous call.
    void note(const render::Camera& camera, double seconds);

    /// Returns the text of the file. Requires at least one camera.
    std::string stopRecording();
    bool isRecording() const { return recorded_.has_value(); }

    void play(CameraPath path);
    void stopPlaying() { played_.reset(); }
    bool isPlaying() const { return played_.has_value(); }

    /// Camera of the next frame; replay ends after the last.
    render::Camera next();

private:
    std::optional<CameraPath> recorded_;
    double recordTime_ = 0.0; ///< [s]
    std::optional<CameraPath> played_;
    double playTime_ = 0.0; ///< [s]
};

} // namespace sward::view
