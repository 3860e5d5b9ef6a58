#include "apps/sward_view/navigation/path_recorder.h"

#include "core/expect.h"

#include <utility>

namespace sward::view {

void PathRecorder::startRecording()
{
    recorded_.emplace();
    recordTime_ = 0.0;
}

void PathRecorder::note(const render::Camera& camera, double seconds)
{
    expect(recorded_.has_value(), "a path is being recorded");
    recordTime_ += recorded_->isEmpty() ? 0.0 : seconds;
    if (recorded_->isEmpty() || recordTime_ > recorded_->end())
        recorded_->add(recordTime_, camera);
}

std::string PathRecorder::stopRecording()
{
    expect(recorded_.has_value() && !recorded_->isEmpty(), "a path has been recorded");
    std::string text = cameraPathText(*recorded_, recordStep);
    recorded_.reset();
    return text;
}

void PathRecorder::play(CameraPath path)
{
    played_ = std::move(path);
    playTime_ = 0.0;
}

render::Camera PathRecorder::next()
{
    expect(played_.has_value(), "a path is being played");
    const render::Camera camera = played_->at(playTime_);
    if (playTime_ >= played_->end())
        played_.reset();
    playTime_ += replayStep;
    return camera;
}

} // namespace sward::view
