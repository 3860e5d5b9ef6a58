// What the user asks for beyond a frame: fields, files, and work that is not saved.
#include "apps/sward_view/files/free_name.h"
#include "apps/sward_view/navigation/new_collider.h"
#include "apps/sward_view/scene/camera_file.h"
#include "apps/sward_view/scene/frame_options.h"
#include "apps/sward_view/window/viewer.h"
#include "core/error.h"
#include "core/files/atomic_file.h"
#include "core/log.h"
#include "presentation/camera_presets.h"
#include "presentation/settings_file.h"
#include "presentation/settings_text.h"

#include <fmt/core.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <thread>
#include <utility>

namespace sward::view {
namespace {

namespace fs = std::filesystem;

constexpr double watchInterval = 0.25; ///< [s] between polls of watched files

std::string namesOf(const OpenedFields& fields)
{
    std::string names;
    for (const auto& field : fields)
        names += (names.empty() ? "" : ", ") + field->name;
    return names;
}

} // namespace

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
        viewerState_.settings = usualSettings(loadedField_->field().view);
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

void Viewer::fulfilFields(const Requests& requests)
{
    if (!requests.open.empty())
        askToSave(loadedField_ ? loadedField_->field().unsaved() : OpenedFields(), "open",
                  [this, inputs = requests.open] { open(inputs); });
    waiting_.insert(waiting_.end(), requests.add.begin(), requests.add.end());
    if (requests.cancelBake)
        opening_.cancel();
    if (requests.saveMeadow && viewerState_.editor)
        writeUnlessTaken(
            *requests.saveMeadow, [this](const std::filesystem::path& path, bool replaces) {
                viewerState_.editor->save(path.string(), replaces, viewerState_.meadow);
                notice(path.string() + ": written");
            });
    if (requests.bake && viewerState_.editor && viewerState_.editor->isChanged()) {
        MeadowEditor& editor = *viewerState_.editor;
        editor.save(editor.file(), editor.ownsFile(), viewerState_.meadow);
    }
    if (!loadedField_) {
        if (requests.bake)
            open({viewerState_.meadow.ground});
        else if (!opening_.isBusy() && !waiting_.empty())
            open(std::exchange(waiting_, {}));
        return;
    }
    if (requests.bake)
        exchange(viewerState_.chosen, viewerState_.meadow.ground, viewerState_.meadow);
    if (requests.choose)
        choose(*requests.choose);

    // Queue additions until the current order has finished.
    OpenedFields others = loadedField_->field().members;
    if (opening_.isBusy())
        return;
    if (requests.remove && others.size() > 1) {
        const auto gone = others.begin() + static_cast<std::ptrdiff_t>(*requests.remove);
        OpenedFields lost;
        if ((*gone)->isUnsaved())
            lost.push_back(*gone);
        others.erase(gone);
        askToSave(std::move(lost), "remove",
                  [this, others] { opening_.open({{}, others, 0}, {}); });
    } else if (!waiting_.empty()) {
        viewerState_.error.clear();
        const std::size_t place = others.size();
        opening_.open({std::exchange(waiting_, {}), std::move(others), place}, viewerState_.meadow);
    }
}

void Viewer::open(std::vector<std::string> inputs)
{
    viewerState_.error.clear();
    waiting_.clear();
    opening_.open({std::move(inputs), {}, 0}, viewerState_.meadow);
}

void Viewer::exchange(std::size_t member, const std::string& input, const MeadowRequests& requests)
{
    viewerState_.error.clear();
    OpenedFields others = loadedField_->field().members;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(member));
    opening_.open({{input}, std::move(others), member}, requests);
}

void Viewer::takeOpened()
{
    try {
        if (auto opened = opening_.poll())
            show(std::move(*opened));
    } catch (const Error& error) {
        // Without a field, rethrow: there is nothing to show.
        if (isFirstInput_)
            throw;
        if (error.kind() == ErrorKind::interrupted)
            notice("Bake cancelled");
        else
            complain(error.what());
    }
}

void Viewer::show(Opening::Opened opened)
{
    const FrameOptions& frame = *options_.frame;
    const OpenedFields members = opened.field->members;
    const field::FieldView& view = opened.field->view;
    const std::string first = members[0]->source.input;
    log::info("{}: {} blades in {} patches", opened.field->name, view.blades.size(),
              view.patches.size());

    // Keep camera and settings if a shown field remains or was baked again.
    const bool isSame =
        loadedField_ && std::any_of(members.begin(), members.end(), [this](const auto& member) {
            return loadedField_->field().has(member->source.input);
        });
    const bool isExchange = isSame && opened.count == 1 &&
                            loadedField_->field().members.size() == members.size() &&
                            loadedField_->field().members[opened.place]->source.input ==
                                members[opened.place]->source.input;
    const bool isBaked = opened.count == 1 && !members[opened.place]->source.report.empty();
    render::FrameSettings settings = isSame ? viewerState_.settings : frame.settingsFor(view);
    const Pane pane = paneBesidePanel();
    const bool fits = frame.camera == "fit";
    CameraPath path = chooseCamera(frame.camera, view, fits ? pane.freeAspect() : pane.aspect,
                                   settings.sunDirection);
    const Framing home = fits ? framedBeside(path.at(0.0), pane, view) : Framing(path.at(0.0));
    auto next = std::make_unique<LoadedField>(
        device_, std::move(opened.field),
        render::FieldRenderer::Settings{.colorFormat = swapchain_.format(),
                                        .samples = frame.samples.value_or(device_.isCpu() ? 1 : 4),
                                        .framesInFlight = 2,
                                        .castsShadows = true,
                                        .recordCullResults = true,
                                        .deviceBytes = frame.gpuMemory,
                                        .largestTarget = window_.screenSize(),
                                        .sownBytes = frame.sownMemory,
                                        .sowThreads =
                                            std::max(std::thread::hardware_concurrency() / 2, 1U)},
        goodShaders_, home, viewerState_.settings, window_.aspect());
    device_.waitIdle();

    for (const auto& [number, camera] : bookmarks_.of(first))
        next->navigation().setBookmark(number, camera);
    viewerState_.difference.reset();
    former_.reset();
    // The strokes are those of the field before; they stay in the autosave.
    if (viewerState_.painter && viewerState_.painter->strokes.isUnsaved())
        if (const auto autosave = viewerState_.painter->finishAutosave(); !autosave.empty())
            notice("Painting has ended; the strokes are in " + autosave.string());
    viewerState_.painter.reset();
    if (isSame)
        next->navigation().show(loadedField_->navigation().framing());
    if (isExchange && isBaked) {
        const field::Summary& before = loadedField_->field().members[opened.place]->summary;
        const field::Summary& after = members[opened.place]->summary;
        viewerState_.difference =
            BakeDifference{before.blades, after.blades, before.heightMean, after.heightMean};
        former_ = std::move(loadedField_);
    }
    std::swap(loadedField_, next);
    viewerState_.settings = std::move(settings);
    viewerState_.showsFormer = false;
    viewerState_.picked.reset();
    viewerState_.hand.forget();
    viewerState_.error.clear();
    // Keep the panel's requests during a rebake.
    if (isExchange && viewerState_.chosen == opened.place)
        viewerState_.bakeReport = members[opened.place]->source.report;
    else
        choose(opened.count > 0 ? opened.place : std::min(viewerState_.chosen, members.size() - 1));
    if (path.size() > 1 && !isSame)
        recorder_.play(std::move(path));
    if (frame.watch && !watchedSettings_)
        watchedSettings_.emplace(frame.settingsFile);
    timestamps_.clearHistory();
    times_.frames = times_.framesAtTitle = rest_.moving = 0;
    times_.lastTitle = Clock::now();
    if (!times_.firstShown)
        times_.firstShown = times_.lastTitle;
    isFirstInput_ = false;
    for (std::size_t i = opened.count; i-- > 0;)
        recent_.add(members[opened.place + i]->source.input);
    if (const std::string complaint = bookmarks_.takeComplaint(); !complaint.empty())
        complain(complaint);
}

void Viewer::choose(std::size_t member)
{
    const OpenedField& field = *loadedField_->field().members.at(member);
    viewerState_.chosen = member;
    viewerState_.bakeReport = field.source.report;
    viewerState_.fieldFile = fieldNameFor(field.source.input);
    // Take the requests of a field baked elsewhere from its provenance, without its ground.
    viewerState_.meadow = field.source.requests ? *field.source.requests
                                                : requestsOf(*field.mapped.view().provenance);
    if (viewerState_.meadow.ground.empty())
        viewerState_.meadow.ground = options_.ground;
}

void Viewer::watch()
{
    if (!loadedField_)
        return;
    const Clock::time_point now = Clock::now();
    if (std::chrono::duration<double>(now - times_.lastLook).count() < watchInterval)
        return;
    times_.lastLook = now;
    if (shaders_)
        reloadShaders();
    // At rest the state does not change, and the results of culling are those of tiles.
    if (viewerState_.picked && !rest_.state.isResting())
        viewerState_.picked =
            lookAgain(loadedField_->renderer(), loadedField_->field(), *viewerState_.picked);
    // Detect changes after the current order has finished.
    if (opening_.isBusy())
        return;
    const OpenedFields& members = loadedField_->field().members;
    for (std::size_t i = 0; i < members.size(); ++i) {
        FieldSource& source = members[i]->source;
        const bool isOther = source.watched.hasChanged();
        const bool isSownAnew = source.watchedMeadow.hasChanged();
        if (source.watched.hasGone())
            complain(source.input + ": the file was removed; the field is still shown");
        if (!options_.frame->watch || !(isOther || isSownAnew))
            continue;
        log::info("{}: changed; opening it again",
                  isOther ? source.input : source.requests->meadowFile);
        exchange(i, source.input,
                 i == viewerState_.chosen ? viewerState_.meadow
                                          : source.requests.value_or(MeadowRequests()));
        break;
    }
    if (watchedSettings_ && watchedSettings_->hasChanged()) {
        // Keep running on a partially written file; the next poll reads the complete one.
        viewerState_.settings = options_.frame->settingsFor(loadedField_->field().view);
        viewerState_.hand.forget();
        log::info("{}: read again", options_.frame->settingsFile);
    }
}

void Viewer::reloadShaders()
{
    const bool areNew = shaders_->poll();
    viewerState_.shaderError = shaders_->complaint();
    if (!areNew)
        return;
    // Report device errors like any other error.
    device_.waitIdle();
    loadedField_->drawWith(shaders_->modules());
    if (viewerState_.painter)
        viewerState_.painter->repeatAll();
    goodShaders_ = shaders_->modules();
    former_.reset();
    viewerState_.difference.reset();
    viewerState_.showsFormer = false;
    viewerState_.picked.reset();
    times_.frames = times_.framesAtTitle = rest_.moving = 0;
    timestamps_.clearHistory();
    notice("Shaders compiled again");
}

bool Viewer::isDone()
{
    if (!window_.isClosed())
        return false;
    OpenedFields unsaved = loadedField_ ? loadedField_->field().unsaved() : OpenedFields();
    const bool hasStrokes = viewerState_.painter && viewerState_.painter->strokes.isUnsaved();
    if (isClosing_ || (unsaved.empty() && !recorder_.isRecording() && !hasStrokes))
        return true;
    window_.keepOpen();
    isClosing_ = false;
    askToSave(std::move(unsaved), "close", [this] {
        isClosing_ = true;
        window_.close();
    });
    return false;
}

void Viewer::askToSave(OpenedFields fields, const std::string& verb, std::function<void()> act)
{
    const bool records = recorder_.isRecording() && verb == "close";
    const bool hasStrokes = viewerState_.painter && viewerState_.painter->strokes.isUnsaved();
    if (fields.empty() && !records && !hasStrokes)
        return act();
    std::string text;
    if (!fields.empty())
        text = fmt::format("{}: baked in this window, and not saved as a field file.",
                           namesOf(fields));
    if (records)
        text += std::string(text.empty() ? "" : "\n") + "A camera path is being recorded.";
    if (hasStrokes)
        text += fmt::format("{}{}: strokes are not saved as a file.", text.empty() ? "" : "\n",
                            loadedField_->field().name);
    std::string about = "Writes";
    for (const auto& field : fields)
        about += " " + freeName(fieldNameFor(field->source.input)).string();
    if (records)
        about += " " + freeName(viewerState_.pathFile).string();
    if (hasStrokes)
        about +=
            " " + freeName(strokesNameFor(loadedField_->field().members[0]->source.input)).string();
    const auto save = [this, fields = std::move(fields), records, hasStrokes, act] {
        for (const auto& field : fields)
            saveField(*field, freeName(fieldNameFor(field->source.input)), false);
        if (hasStrokes)
            viewerState_.painter->writeStrokes(
                freeName(strokesNameFor(loadedField_->field().members[0]->source.input)));
        if (records)
            record();
        act();
    };
    viewerState_.question =
        Question{std::move(text),
                 {{"Save and " + verb, std::move(about), save},
                  {fmt::format("{}{} without saving", static_cast<char>(verb[0] - 'a' + 'A'),
                               verb.substr(1)),
                   "What is not saved is lost",
                   [this, hasStrokes, act = std::move(act)] {
                       if (hasStrokes && viewerState_.painter)
                           viewerState_.painter->discard();
                       act();
                   }},
                  {"Cancel", "Changes nothing (Escape)", {}}}};
}

void Viewer::saveField(OpenedField& field, const fs::path& path, bool replaces)
{
    // A painted field is that of the session.
    if (viewerState_.painter && viewerState_.painter->isReady()) {
        viewerState_.painter->saveFieldNow(path, replaces);
        field.savedAs = path;
    } else {
        field.save(path, replaces);
    }
    log::info("{}: saved as {}", field.source.input, path.string());
    notice(path.string() + ": written");
    recent_.add(path.string());
}

void Viewer::writeUnlessTaken(const fs::path& path,
                              std::function<void(const fs::path&, bool)> write)
{
    if (freeName(path) == path)
        write(path, false);
    else
        viewerState_.question = replaceQuestion(path, std::move(write));
}

void Viewer::writeText(const fs::path& path, std::string text)
{
    writeUnlessTaken(path, [this, text = std::move(text)](const fs::path& chosen, bool replaces) {
        writeTextFile(chosen, text, replaces);
        notice(chosen.string() + ": written");
    });
}

void Viewer::startSequence()
{
    const auto pictures = static_cast<std::uint64_t>(viewerState_.sequenceLength);
    const auto step = static_cast<double>(viewerState_.sequenceStep);
    if (viewerState_.makesVideo)
        return writeUnlessTaken(viewerState_.videoFile,
                                [this, pictures, step](const fs::path& path, bool) {
                                    capture_.takeVideo(path, pictures, step);
                                });
    const std::string names = viewerState_.sequenceFiles;
    const auto start = [this, names, pictures, step] {
        capture_.takeSequence(names, pictures, step);
    };
    const FrameNames numbered(names);
    std::uint64_t taken = 0;
    for (std::uint64_t i = 0; numbered.numbered() && i < pictures; ++i)
        taken += freeName(numbered.of(i)) != numbered.of(i) ? 1u : 0u;
    if (taken == 0)
        return start();
    viewerState_.question =
        Question{fmt::format("{}: {} of these {} pictures exist already.", names, taken, pictures),
                 {{"Replace", "Writes the new pictures; the old ones are lost", start},
                  {"Cancel", "Writes nothing (Escape)", {}}}};
}

bool Viewer::closeTopmost()
{
    if (std::exchange(viewerState_.question, std::nullopt)) {
        interface_.closePopup();
        return true;
    }
    if (std::exchange(viewerState_.files, std::nullopt)) {
        interface_.closePopup();
        return true;
    }
    if (interface_.closePopup() || std::exchange(layout_.keySheet, false))
        return true;
    if (!std::exchange(viewerState_.error, {}).empty())
        return true;
    if (layout_.shown && std::exchange(viewerState_.picked, std::nullopt))
        return true;
    return layout_.shown && std::exchange(layout_.open, std::nullopt);
}

} // namespace sward::view
