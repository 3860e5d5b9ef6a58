#pragma once

#include "apps/sward_view/camera_path.h"

#include <optional>
#include <string>

namespace sward::view {

/// Records the camera's way and plays it again at a fixed step.
class PathRecorder {
public:
    static constexpr double recordStep = 0.1;        ///< [s] between two places of a file
    static constexpr double replayStep = 1.0 / 60.0; ///< [s] from frame to frame

    void startRecording();

    /// Notes where the camera is, `seconds` after the call before.
    void note(const render::Camera& camera, double seconds);

    /// The text of the file. There is at least one place.
    std::string stopRecording();
    bool isRecording() const { return recorded_.has_value(); }

    void play(CameraPath path);
    void stopPlaying() { played_.reset(); }
    bool isPlaying() const { return played_.has_value(); }

    /// The next frame's camera; after the last it has ended.
    render::Camera next();

private:
    std::optional<CameraPath> recorded_;
    double recordTime_ = 0.0; ///< [s]
    std::optional<CameraPath> played_;
    double playTime_ = 0.0; ///< [s]
};

} // namespace sward::view
