// Which fields are shown: opened, baked, added, taken away, watched.
#include "apps/sward_view/files/free_name.h"
#include "apps/sward_view/scene/camera_file.h"
#include "apps/sward_view/window/viewer.h"
#include "core/error.h"
#include "core/log.h"

#include <algorithm>
#include <utility>

namespace sward::view {
namespace {

constexpr double watchInterval = 0.25; ///< [s] between polls of watched files

} // namespace

void Viewer::fulfilFields(const Requests& requests)
{
    if (!requests.open.empty())
        askToSave(loadedField_ ? loadedField_->field().unsaved() : OpenedFields(), "open",
                  [this, inputs = requests.open] { open(inputs); });
    waiting_.insert(waiting_.end(), requests.add.begin(), requests.add.end());
    if (requests.cancelBake)
        opening_.cancel();
    if (requests.saveMeadow && viewerState_.editor)
        writeUnlessTaken(*requests.saveMeadow,
                         [this](const std::filesystem::path& path, bool replaces) {
                             viewerState_.editor->save(path, replaces, viewerState_.meadow);
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
        askToSave(std::move(lost), "remove", [this, others] {
            opening_.open({{}, others, 0}, {});
        });
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
                                        .recordCullResults = true,
                                        .deviceBytes = frame.gpuMemory,
                                        .largestTarget = window_.screenSize()},
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

} // namespace sward::view
