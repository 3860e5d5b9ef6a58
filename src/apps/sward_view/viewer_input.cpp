// What the user does with mouse and keys.
#include "apps/sward_view/camera_file.h"
#include "apps/sward_view/viewer.h"
#include "render/camera_presets.h"

#include <fmt/core.h>

#include <utility>

namespace sward::view {

void Viewer::steer(Input input)
{
    if (!input.dropped.empty()) {
        const bool adds = input.dropsMore || stage_.dropAdds;
        (adds ? stage_.wishes.add : stage_.wishes.open) = std::exchange(input.dropped, {});
    }
    const bool keys = !interface_.takesKeys();
    if (keys)
        for (const KeyPress& key : input.keys)
            press(key);
    if (!exhibit_)
        return;

    Navigation& navigation = exhibit_->navigation();
    const bool mouse = !interface_.takesMouse();
    if (!handleColliders(input, mouse)) {
        if (mouse && input.clicked)
            pick(*input.clicked);
        const bool moves = input.rotate != glm::vec2(0.0f) || input.pan != glm::vec2(0.0f) ||
                           input.look != glm::vec2(0.0f) || input.wheel != 0.0f;
        // Whoever takes the camera in hand has seen enough of the path.
        if (mouse && moves)
            recorder_.stopPlaying();
        navigation.steer(input, static_cast<float>(window_.drawableSize().y), frameSeconds_, mouse,
                         keys);
    }
    if (recorder_.isPlaying())
        navigation.show(recorder_.next());
    if (recorder_.isRecording())
        recorder_.note(navigation.camera(), frameSeconds_);
}

void Viewer::press(const KeyPress& key)
{
    switch (key.key) {
    case Key::escape:
        if (!std::exchange(layout_.keySheet, false))
            window_.close();
        break;
    case Key::help:
        layout_.keySheet = !layout_.keySheet;
        break;
    case Key::panels:
        layout_.shown = !layout_.shown;
        break;
    case Key::pause:
        stage_.time.paused = !stage_.time.paused;
        break;
    case Key::step:
        stage_.time.paused = true;
        stage_.time.stepOnce = true;
        break;
    case Key::frame:
        stage_.wishes.frameField = true;
        break;
    case Key::home:
        stage_.wishes.goHome = true;
        break;
    case Key::walk:
        stage_.wishes.walk = true;
        break;
    case Key::freeze:
        stage_.wishes.freeze = true;
        break;
    case Key::record:
        stage_.wishes.record = true;
        break;
    case Key::picture:
        stage_.wishes.picture = true;
        break;
    case Key::bookmark:
        if (!exhibit_)
            break;
        if (key.control) {
            exhibit_->navigation().setBookmark(key.number);
            bookmarks_.set(exhibit_->field().members[0]->source.input, key.number,
                           exhibit_->navigation().camera());
            notice(fmt::format("Bookmark {} is set", key.number));
        } else if (!exhibit_->navigation().showBookmark(key.number)) {
            notice(fmt::format("There is no bookmark {}; Ctrl+{} sets it", key.number, key.number));
        }
        break;
    }
}

Sight Viewer::sightAt(glm::vec2 pixel) const
{
    return sightThrough(exhibit_->navigation().camera(), pixel, window_.drawableSize());
}

bool Viewer::handleColliders(const Input& input, bool mouse)
{
    const GroundSurface& ground = exhibit_->field().ground;
    if (mouse && input.leftPressed && !exhibit_->navigation().isWalking())
        dragsCollider_ = stage_.hand.grab(stage_.settings.colliders, sightAt(input.pressedAt),
                                          ground, stage_.time.now);
    if (!dragsCollider_)
        return false;
    const auto up = [this](const glm::dvec3& place) { return upAt(stage_.settings, place); };
    // A click alone leaves it where it is.
    if (input.rotate != glm::vec2(0.0f) || input.pan != glm::vec2(0.0f))
        stage_.hand.drag(sightAt(input.cursor), ground, up);
    if (!input.leftHeld) {
        stage_.hand.release();
        dragsCollider_ = false;
    }
    return true;
}

void Viewer::pick(glm::vec2 pixel)
{
    const bool onlyDrawn = stage_.settings.debug != render::DebugMode::reason;
    stage_.picked = pickBlade(exhibit_->renderer(), exhibit_->field(), sightAt(pixel), onlyDrawn);
}

void Viewer::freeze()
{
    auto& frozen = stage_.settings.cullingCamera;
    if (frozen)
        frozen.reset();
    else
        frozen = exhibit_->navigation().camera();
}

} // namespace sward::view
