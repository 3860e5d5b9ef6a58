// Handles mouse and keys.
#include "apps/sward_view/scene/camera_file.h"
#include "apps/sward_view/window/viewer.h"
#include "core/error.h"
#include "presentation/camera_presets.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace sward::view {
namespace {

constexpr float uiZoomStep = 1.1f; ///< of text and controls, by a press of a key

// What a key requests; null if it is for something else.
bool Requests::*requestOf(Key key)
{
    switch (key) {
    case Key::frame:
        return &Requests::frameField;
    case Key::home:
        return &Requests::goHome;
    case Key::walk:
        return &Requests::walk;
    case Key::freeze:
        return &Requests::freeze;
    case Key::record:
        return &Requests::record;
    case Key::picture:
        return &Requests::picture;
    default:
        return nullptr;
    }
}

// The steps of text and controls after a key, where `scale` is theirs before it.
int zoomAfter(Key key, int steps, float scale)
{
    if (key == Key::larger)
        return steps + (scale < static_cast<float>(largestUiScale) ? 1 : 0);
    if (key == Key::smaller)
        return steps - (scale > static_cast<float>(smallestUiScale) ? 1 : 0);
    return key == Key::usualSize ? 0 : steps;
}

// Undo, redo and the choice of a species. Returns what the user should know, or nothing.
std::string editStrokes(Key key, Painter& painter, StrokeDesk& desk)
{
    if (key == Key::undo && !painter.strokes.undo())
        return "No change of the strokes is left to undo";
    if (key == Key::redo && !painter.strokes.redo())
        return "No change of the strokes is left to redo";
    if (key == Key::species)
        desk.takesSpecies = !desk.takesSpecies;
    return {};
}

// Whether the chosen field was baked or painted in this window.
bool isMadeHere(const ShownField& shown, const ViewerState& state)
{
    return state.painter || shown.members.at(state.chosen)->source.requests;
}

} // namespace

KeyboardFocus::Keys Viewer::keysForControls(Input& input) const
{
    KeyboardFocus::Keys keys{.rows = input.steps, .sides = input.sides, .entered = input.entered};
    if (!layout_.takesTab(viewerState_))
        return keys;
    std::erase_if(input.keys, [&](const KeyPress& press) {
        keys.tabs += press.key == Key::tab ? (press.shift ? -1 : 1) : 0;
        keys.space |= press.key == Key::pause;
        return press.key == Key::tab;
    });
    return keys;
}

void Viewer::pressKeys(const Input& input)
{
    if (!interface_.takesKeys()) {
        const bool takesSpace = controls_.focus().takesSpace();
        for (const KeyPress& key : input.keys)
            if (key.key != Key::pause || !takesSpace)
                press(key);
    } else if (std::any_of(input.keys.begin(), input.keys.end(),
                           [](const KeyPress& key) { return key.key == Key::escape; }) &&
               !(viewerState_.files && closeTopmost())) {
        interface_.endTyping();
    }
}

void Viewer::steer(Input& input)
{
    if (!input.dropped.empty()) {
        const bool adds = input.dropsMore || viewerState_.dropAdds;
        (adds ? viewerState_.requests.add : viewerState_.requests.open) =
            std::exchange(input.dropped, {});
    }
    if (!loadedField_)
        return;

    Navigation& navigation = loadedField_->navigation();
    const bool mouse = !interface_.takesMouse();
    // A click into a text field takes the keys that are held with it, too.
    const bool keys = !interface_.takesKeys() && (mouse || !input.leftPressed);
    steerBrush(input, mouse);
    if (!handleColliders(input, mouse)) {
        if (mouse && input.clicked)
            rest_.pickAt = input.clicked;
        if (rest_.pickAt && rest_.state.isResting())
            rest_.isDisturbed = true;
        else if (rest_.pickAt)
            pick(*std::exchange(rest_.pickAt, std::nullopt));
        const bool moves = input.rotate != glm::vec2(0.0f) || input.pan != glm::vec2(0.0f) ||
                           input.look != glm::vec2(0.0f) || input.wheel != 0.0f;
        // Moving the camera ends the path.
        if (mouse && moves)
            recorder_.stopPlaying();
        navigation.steer(input, static_cast<float>(window_.size().y), times_.frameSeconds, mouse,
                         keys);
    }
    if (recorder_.isPlaying())
        navigation.show(recorder_.next());
    if (recorder_.isRecording())
        recorder_.note(navigation.camera(), times_.frameSeconds);
}

void Viewer::press(const KeyPress& key)
{
    if (bool Requests::*const request = requestOf(key.key); request != nullptr)
        viewerState_.requests.*request = true;
    uiZoom_ = zoomAfter(key.key, uiZoom_, uiScale().interface);
    if (viewerState_.painter)
        notice(editStrokes(key.key, *viewerState_.painter, viewerState_.desk));
    switch (key.key) {
    case Key::escape:
        if (!closeTopmost())
            window_.close();
        break;
    case Key::help:
        layout_.keySheet = !layout_.keySheet;
        break;
    case Key::tab:
    case Key::hide:
        layout_.shown = !layout_.shown;
        break;
    case Key::pause:
        viewerState_.time.paused = !viewerState_.time.paused;
        break;
    case Key::step:
        viewerState_.time.paused = true;
        viewerState_.time.stepOnce = true;
        break;
    case Key::save:
        if (loadedField_ && isMadeHere(loadedField_->field(), viewerState_))
            viewerState_.requests.saveField = viewerState_.fieldFile;
        break;
    case Key::bookmark:
        if (loadedField_)
            useBookmark(key);
        break;
    default:
        break;
    }
}

// Sets a bookmark, or goes to it. Another window of this input may have set it meanwhile.
void Viewer::useBookmark(const KeyPress& key)
{
    const std::string& input = loadedField_->field().members[0]->source.input;
    Navigation& navigation = loadedField_->navigation();
    if (key.control) {
        navigation.setBookmark(key.number);
        notice(fmt::format("Bookmark {} set", key.number));
        try {
            bookmarks_.set(input, key.number, navigation.camera());
        } catch (const Error& error) {
            complain(fmt::format("Bookmark {} is set in this window, but not kept for later ones: "
                                 "{}",
                                 key.number, error.what()));
        }
    } else {
        for (const auto& [number, camera] : bookmarks_.of(input))
            navigation.setBookmark(number, camera);
        const bool isShown = navigation.showBookmark(key.number);
        // The first is the whole field, beside what is open now.
        if (!isShown && key.number == 1)
            viewerState_.requests.frameField = true;
        else if (!isShown)
            notice(fmt::format("No bookmark {}; Ctrl+{} sets it", key.number, key.number));
    }
    if (const std::string complaint = bookmarks_.takeComplaint(); !complaint.empty())
        complain(complaint);
}

Style::Scale Viewer::uiScale() const
{
    const float asked = options_.uiScale.value_or(window_.contentScale());
    const float zoomed = asked * std::pow(uiZoomStep, static_cast<float>(uiZoom_));
    const float points = static_cast<float>(std::max(window_.size().x, 1u));
    const float pixels = static_cast<float>(std::max(window_.drawableSize().x, 1u));
    return {
        std::clamp(zoomed, static_cast<float>(smallestUiScale), static_cast<float>(largestUiScale)),
        pixels / points};
}

Pane Viewer::paneBesidePanel() const
{
    const glm::vec2 size(glm::max(window_.size(), glm::uvec2(1)));
    return paneOf(size, layout_.covered(interface_.style(), size.x));
}

// Written pictures have as many pixels as the window, with the middle of its free part in their
// middle [pixels]. A streamed field holds the blades of the window's picture.
std::uint32_t Viewer::pictureShift() const
{
    if (!loadedField_ || loadedField_->renderer().isStreamed())
        return 0;
    const auto width = static_cast<float>(window_.drawableSize().x);
    return static_cast<std::uint32_t>(
        std::lround(std::max(paneBesidePanel().shift(), 0.0f) * width));
}

Sight Viewer::sightAt(glm::vec2 place) const
{
    // Tolerances count in pixels of an unscaled interface.
    const float unit = interface_.style().scaled(1.0f);
    return sightThrough(loadedField_->navigation().camera(), place / unit,
                        glm::vec2(window_.size()) / unit);
}

bool Viewer::handleColliders(const Input& input, bool mouse)
{
    const presentation::GroundSurface& ground = loadedField_->field().ground;
    if (mouse && input.leftPressed && !loadedField_->navigation().isWalking())
        dragsCollider_ =
            viewerState_.hand.grab(viewerState_.settings.colliders, sightAt(input.pressedAt),
                                   ground, viewerState_.time.now);
    if (!dragsCollider_)
        return false;
    const auto up = [this](const glm::dvec3& place) { return upAt(viewerState_.settings, place); };
    // A click alone does not move the camera.
    if (input.rotate != glm::vec2(0.0f) || input.pan != glm::vec2(0.0f))
        viewerState_.hand.drag(sightAt(input.cursor), ground, up);
    if (!input.leftHeld) {
        viewerState_.hand.release();
        dragsCollider_ = false;
    }
    return true;
}

void Viewer::pick(glm::vec2 pixel)
{
    // Numbers of blades on the device are those of the painted field.
    if (viewerState_.painter)
        return notice("Blades can be picked after painting has stopped");
    const bool onlyDrawn = viewerState_.settings.debug != render::DebugMode::reason;
    viewerState_.picked =
        pickBlade(loadedField_->renderer(), loadedField_->field(), sightAt(pixel), onlyDrawn);
    if (!viewerState_.picked)
        notice("No blade here");
}

} // namespace sward::view
