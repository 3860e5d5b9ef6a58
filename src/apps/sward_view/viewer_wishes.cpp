// What the panels ask for, and what takes longer than a frame.
#include "apps/sward_view/camera_file.h"
#include "apps/sward_view/viewer.h"
#include "core/atomic_file.h"
#include "core/error.h"
#include "core/log.h"
#include "render/camera_presets.h"
#include "render/settings_file.h"
#include "render/settings_text.h"

#include <fmt/core.h>

#include <utility>

namespace sward::view {

void Viewer::complain(const std::string& message)
{
    log::error("{}", message);
    stage_.error = message;
}

void Viewer::notice(const std::string& message)
{
    if (message.empty())
        return;
    stage_.notice = message;
    lastNotice_ = Clock::now();
}

void Viewer::fulfil()
{
    const Wishes wishes = std::exchange(stage_.wishes, Wishes());
    try {
        fulfilFields(wishes);
        watch();
        if (exhibit_)
            fulfilFiles(wishes);
    } catch (const Error& error) {
        if (isFirstInput_)
            throw;
        complain(error.what());
    }
    if (wishes.forgetTimes)
        timestamps_.clearHistory();
    if (!exhibit_)
        return;

    Navigation& navigation = exhibit_->navigation();
    if (wishes.compare && former_) {
        device_.waitIdle();
        former_->navigation().show(navigation.camera());
        std::swap(exhibit_, former_);
        stage_.showsFormer = !stage_.showsFormer;
        stage_.picked.reset();
        frames_ = framesAtTitle_ = 0;
        return;
    }
    if (wishes.frameField)
        navigation.show(render::presetCamera(render::CameraPreset::fit, exhibit_->field().view,
                                             groundUpOf(exhibit_->field().view), aspect()));
    if (wishes.goHome)
        navigation.goHome();
    if (wishes.walk && !navigation.isWalking() && !navigation.walk(true))
        notice("There is no ground below the camera to walk on");
    else if (wishes.walk && stage_.walking)
        navigation.walk(false);
    if (wishes.freeze)
        freeze();
    if (wishes.resetSettings) {
        stage_.settings = render::FrameSettings::of(exhibit_->field().view);
        stage_.hand.forget();
    }
    if (wishes.picture)
        capture_.takePicture(stage_.pictureFile);
}

void Viewer::fulfilFiles(const Wishes& wishes)
{
    if (wishes.saveSettings) {
        writeTextFile(*wishes.saveSettings, render::settingsText(stage_.settings), true);
        notice(*wishes.saveSettings + ": written");
    }
    if (wishes.loadSettings) {
        // Over a copy: half of a wrong file must not stay.
        render::FrameSettings settings = stage_.settings;
        render::readSettings(*wishes.loadSettings, settings);
        stage_.settings = settings;
        stage_.hand.forget();
        notice(*wishes.loadSettings + ": read");
    }
    const glm::vec3 up = groundUpOf(exhibit_->field().view);
    if (wishes.saveCamera) {
        CameraPath path(exhibit_->navigation().camera());
        writeTextFile(*wishes.saveCamera, cameraPathText(path, PathRecorder::recordStep), true);
        notice(*wishes.saveCamera + ": written");
    }
    if (wishes.replayPath) {
        if (recorder_.isPlaying())
            recorder_.stopPlaying();
        else
            recorder_.play(readCameraPath(*wishes.replayPath, up));
    }
    if (wishes.record)
        record();
    if (wishes.sequence) {
        const auto pictures = static_cast<std::uint64_t>(stage_.sequenceLength);
        const auto step = static_cast<double>(stage_.sequenceStep);
        if (capture_.isSequence())
            notice(capture_.stopSequence());
        else if (stage_.makesFilm)
            capture_.takeFilm(stage_.filmFile, pictures, step);
        else
            capture_.takeSequence(stage_.sequenceFiles, pictures, step);
    }
}

void Viewer::record()
{
    if (!recorder_.isRecording()) {
        recorder_.stopPlaying();
        recorder_.startRecording();
        recorder_.note(exhibit_->navigation().camera(), 0.0);
        return;
    }
    const std::string text = recorder_.stopRecording();
    writeTextFile(stage_.pathFile, text, true);
    notice(stage_.pathFile + ": written");
}

} // namespace sward::view
