// Fulfils requests of the panels and other work that takes longer than a frame.
#include "apps/sward_view/files/free_name.h"
#include "apps/sward_view/navigation/new_collider.h"
#include "apps/sward_view/scene/camera_file.h"
#include "apps/sward_view/window/viewer.h"
#include "core/error.h"
#include "core/files/atomic_file.h"
#include "core/log.h"
#include "presentation/camera_presets.h"
#include "presentation/settings_file.h"
#include "presentation/settings_text.h"

#include <fmt/core.h>
#include <glm/geometric.hpp>

#include <utility>

namespace sward::view {

void Viewer::complain(const std::string& message)
{
    log::error("{}", message);
    viewerState_.error = message;
}

void Viewer::notice(const std::string& message)
{
    if (message.empty())
        return;
    viewerState_.notice = message;
    times_.lastNotice = Clock::now();
}

void Viewer::write(const gpu::Image& image)
{
    try {
        notice(capture_.write(device_.context(), image));
    } catch (const Error& error) {
        complain(error.what());
    }
}

void Viewer::fulfil()
{
    const Requests requests = std::exchange(viewerState_.requests, Requests());
    try {
        if (requests.answer)
            requests.answer();
        fulfilFields(requests);
        watch();
        if (loadedField_)
            fulfilPainting(requests);
        if (loadedField_)
            fulfilFiles(requests);
    } catch (const Error& error) {
        if (isFirstInput_)
            throw;
        complain(error.what());
    }
    if (requests.forgetTimes)
        timestamps_.clearHistory();
    if (!loadedField_)
        return;

    Navigation& navigation = loadedField_->navigation();
    if (requests.compare && former_ && !viewerState_.painter) {
        device_.waitIdle();
        former_->navigation().show(navigation.framing());
        std::swap(loadedField_, former_);
        viewerState_.showsFormer = !viewerState_.showsFormer;
        viewerState_.picked.reset();
        times_.frames = times_.framesAtTitle = rest_.moving = 0;
        return;
    }
    if (requests.frameField) {
        const Pane pane = paneBesidePanel();
        const field::FieldView& view = loadedField_->field().view;
        navigation.show(framedBeside(
            presentation::presetCamera(presentation::CameraPreset::fit, view,
                                       {.groundUp = groundUpOf(view),
                                        .aspect = pane.freeAspect(),
                                        .sunDirection = viewerState_.settings.sunDirection,
                                        .surface = &loadedField_->field().ground}),
            pane, view));
    }
    if (requests.goHome)
        navigation.goHome();
    if (requests.walk && !navigation.isWalking() && !navigation.walk(true))
        notice("No ground below the camera to walk on");
    else if (requests.walk && viewerState_.walking)
        navigation.walk(false);
    auto& frozen = viewerState_.settings.cullingCamera;
    if (requests.freeze)
        frozen = frozen ? std::nullopt : std::optional(navigation.camera());
    if (requests.addCapsule) {
        auto& colliders = viewerState_.settings.colliders;
        const Aabb& bounds = loadedField_->field().summary.bounds;
        const NewCollider where{
            .ground = loadedField_->field().ground,
            .upAt = [this](const glm::dvec3& at) { return upAt(viewerState_.settings, at); },
            .fieldSize = bounds.isEmpty() ? 10.0 : glm::length(glm::dvec3(bounds.size())),
            .time = viewerState_.time.now};
        const glm::vec2 middle = 0.5f * glm::vec2(window_.size()) *
                                 glm::vec2(1.0f + 2.0f * paneBesidePanel().shift(), 1.0f);
        colliders.push_back(newCollider(where, sightAt(middle), *requests.addCapsule, colliders));
        viewerState_.hand.chosen = colliders.size() - 1;
    }
    if (requests.resetSettings) {
        viewerState_.settings = render::FrameSettings::of(loadedField_->field().view);
        viewerState_.hand.forget();
    }
    if (requests.picture)
        capture_.takePicture(freeName(viewerState_.pictureFile));
}

void Viewer::fulfilFiles(const Requests& requests)
{
    if (requests.saveSettings) {
        writeText(*requests.saveSettings, presentation::settingsText(viewerState_.settings));
    }
    if (requests.saveField && !viewerState_.painter) {
        const auto field = loadedField_->field().members.at(viewerState_.chosen);
        writeUnlessTaken(*requests.saveField,
                         [this, field](const std::filesystem::path& path, bool replaces) {
                             saveField(*field, path, replaces);
                         });
    }
    if (requests.loadSettings) {
        // Read into a copy, so that an invalid file changes nothing.
        render::FrameSettings settings = viewerState_.settings;
        const std::vector<std::string> warnings =
            presentation::readSettings(*requests.loadSettings, settings);
        viewerState_.settings = settings;
        viewerState_.hand.forget();
        notice(warnings.empty() ? *requests.loadSettings + ": read" : warnings.front());
    }
    const glm::vec3 up = groundUpOf(loadedField_->field().view);
    if (requests.saveCamera) {
        CameraPath path(loadedField_->navigation().camera());
        writeText(*requests.saveCamera, cameraPathText(path, PathRecorder::recordStep));
    }
    if (requests.replayPath) {
        if (recorder_.isPlaying())
            recorder_.stopPlaying();
        else
            recorder_.play(readCameraPath(*requests.replayPath, up));
    }
    if (requests.record)
        record();
    if (requests.sequence) {
        if (capture_.isSequence())
            notice(capture_.stopSequence());
        else
            startSequence();
    }
}

void Viewer::record()
{
    if (!recorder_.isRecording()) {
        recorder_.stopPlaying();
        recorder_.startRecording();
        recorder_.note(loadedField_->navigation().camera(), 0.0);
        return;
    }
    const std::string text = recorder_.stopRecording();
    const std::filesystem::path path = freeName(viewerState_.pathFile);
    writeTextFile(path, text, false);
    notice(path.string() + ": written");
}

} // namespace sward::view
