// What the panels ask for, and what takes longer than a frame.
#include "apps/sward_view/camera_file.h"
#include "apps/sward_view/viewer.h"
#include "core/atomic_file.h"
#include "core/error.h"
#include "core/log.h"
#include "render/camera_presets.h"
#include "render/raster_pass.h"
#include "render/settings_file.h"
#include "render/settings_text.h"

#include <fmt/core.h>

#include <utility>

namespace sward::view {
namespace {

constexpr double watchInterval = 0.25; ///< [s] between looks at watched files

// Of few pixels each is shaded once: on a CPU that is worth more than the tessellator's speed.
render::Geometry geometryFor(const gpu::Device& device, VkFormat format, bool fewPixels)
{
    return device.isCpu() && fewPixels &&
                   render::obstacleToRaster(device.context(), format) == nullptr
               ? render::Geometry::raster
               : render::Geometry::automatic;
}

} // namespace

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
        if (wishes.open)
            open(*wishes.open);
        if (wishes.bake) {
            stage_.error.clear();
            opening_.open(stage_.meadow.ground, stage_.meadow);
        }
        if (wishes.cancelBake)
            opening_.cancel();
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

void Viewer::open(const std::string& input)
{
    stage_.error.clear();
    opening_.open(input, stage_.meadow);
}

void Viewer::takeOpened()
{
    try {
        if (auto opened = opening_.poll())
            show(std::move(*opened));
    } catch (const Error& error) {
        // Without a field there is nothing to go back to.
        if (isFirstInput_)
            throw;
        if (error.kind() == ErrorKind::interrupted)
            notice("The bake was cancelled");
        else
            complain(error.what());
    }
}

void Viewer::show(Opening::Opened opened)
{
    const FrameOptions& frame = *options_.frame;
    const field::FieldView& view = opened.field->view;
    const std::string input = opened.field->input;
    const bool isBaked = !opened.report.empty();
    const bool isSame = exhibit_ && exhibit_->field().input == input;
    log::info("{}: {} blades in {} patches", input, view.blades.size(), view.patches.size());

    // The same ground, grown again, is seen with the same eyes and settings.
    render::FrameSettings settings = isSame ? stage_.settings : frame.settingsFor(view);
    CameraPath path = chooseCamera(frame.camera, view, aspect());
    const render::Camera home = path.at(0.0);
    auto next = std::make_unique<Exhibit>(
        device_, std::move(opened.field),
        render::FieldRenderer::Settings{
            .colorFormat = swapchain_.format(),
            .samples = frame.samples.value_or(device_.isCpu() ? 1 : 4),
            .framesInFlight = 2,
            .geometry = geometryFor(device_, swapchain_.format(), stage_.automaticScale),
            .recordFates = true},
        home, stage_.settings, aspect());
    device_.waitIdle();

    for (const auto& [number, camera] : bookmarks_.of(input))
        next->navigation().setBookmark(number, camera);
    stage_.difference.reset();
    former_.reset();
    if (isSame && isBaked) {
        const field::Summary& before = exhibit_->field().summary;
        const field::Summary& after = next->field().summary;
        stage_.difference =
            BakeDifference{before.blades, after.blades, before.heightMean, after.heightMean};
        former_ = std::move(exhibit_);
        next->navigation().show(former_->navigation().camera());
    } else if (isSame) {
        next->navigation().show(exhibit_->navigation().camera());
    }
    exhibit_ = std::move(next);
    stage_.settings = std::move(settings);
    stage_.bakeReport = opened.report;
    stage_.showsFormer = false;
    stage_.picked.reset();
    stage_.hand.forget();
    stage_.error.clear();
    // What was grown elsewhere can be grown again here, once its ground is named.
    if (isBaked || wantsBaking(input))
        stage_.meadow.ground = input;
    else if (!isSame)
        stage_.meadow = wishesOf(*exhibit_->field().view.provenance);
    if (path.size() > 1 && !isSame)
        recorder_.play(std::move(path));
    if (frame.watch) {
        watchedInput_ = WatchedFile(input);
        watchedSettings_ = WatchedFile(frame.settingsFile);
    }
    timestamps_.clearHistory();
    frames_ = framesAtTitle_ = 0;
    lastTitle_ = Clock::now();
    if (!firstShown_)
        firstShown_ = lastTitle_;
    isFirstInput_ = false;
    recent_.add(input);
    bookmarks_.keepOnly(recent_.inputs());
}

void Viewer::watch()
{
    if (!exhibit_)
        return;
    const Clock::time_point now = Clock::now();
    if (std::chrono::duration<double>(now - lastLook_).count() < watchInterval)
        return;
    lastLook_ = now;
    if (stage_.picked)
        stage_.picked = lookAgain(exhibit_->renderer(), exhibit_->field().view, *stage_.picked);
    if (!options_.frame->watch)
        return;
    const std::string input = exhibit_->field().input;
    if (watchedInput_.hasChanged()) {
        log::info("{}: has changed", input);
        open(input);
    }
    if (watchedSettings_.hasChanged()) {
        // Half a sentence is no reason to close the window: the next look finds the whole one.
        stage_.settings = options_.frame->settingsFor(exhibit_->field().view);
        stage_.hand.forget();
        log::info("{}: read again", options_.frame->settingsFile);
    }
}

} // namespace sward::view
