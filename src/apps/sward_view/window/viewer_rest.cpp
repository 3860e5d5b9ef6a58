// What a slow device draws while nothing changes: a fine picture, tile by tile, then nothing.
#include "apps/sward_view/window/viewer.h"
#include "core/error.h"
#include "gpu/memory/image_use.h"
#include "presentation/settings_text.h"

#include <utility>

namespace sward::view {

bool Viewer::hasChanged()
{
    // A streamed field holds the blades of one view, not of tiles in turn.
    if (!viewerState_.refinesAtRest || !loadedField_ || times_.frames < ring_.slots() ||
        swapchain_.extent().width == 0 || loadedField_->renderer().isStreamed() ||
        viewerState_.settings.cullingCamera ||
        viewerState_.settings.debug == render::DebugMode::reason || capture_.isSequence() ||
        recorder_.isPlaying() || recorder_.isRecording())
        return true;
    Seen seen{.camera = loadedField_->navigation().camera(),
              .settings = presentation::settingsText(viewerState_.settings),
              .debug = static_cast<std::uint32_t>(viewerState_.settings.debug),
              .window = window_.drawableSize(),
              .shift = pictureShift(),
              .isPaused = viewerState_.time.paused,
              .timeScale = viewerState_.time.scale};
    const bool isOther = rest_.seen != seen;
    rest_.seen = std::move(seen);
    return std::exchange(rest_.isDisturbed, false) || isOther;
}

AtRest::Draws Viewer::drawsNext()
{
    const bool isWritten =
        rest_.state.passesDone() > 0 && capture_.wantsFrame() && !capture_.isSequence();
    const bool changes = hasChanged() || (capture_.wantsFrame() && !isWritten);
    const std::chrono::duration<double> now = Clock::now() - times_.begun;
    const AtRest::Draws draws = rest_.state.next(now.count(), changes);
    if (draws == AtRest::Draws::moving)
        rest_.hasBegun = false;
    else if (isWritten)
        write(rest_.picture.image());
    return draws;
}

bool Viewer::drawRefined(AtRest::Draws draws)
{
    if (draws == AtRest::Draws::refined) {
        if (!std::exchange(rest_.hasBegun, true))
            rest_.picture.begin(picture_, swapchain_.extent(), pictureShift());
        const render::FrameSettings settings =
            refinedSettings(viewerState_.settings, loadedField_->samples());
        const RefinedPicture::Progress progress = rest_.picture.drawTile(
            ring_, {loadedField_->renderer(), loadedField_->navigation().camera(), settings,
                    viewerState_.time.now});
        if (progress.endsPass)
            rest_.state.finishPass();
        rest_.mustShow = rest_.mustShow || progress.isShown;
        // The statistics of the slots are those of tiles.
        rest_.moving = 0;
    }
    // Draw the window again only where it looks different.
    const bool isBusy = draws == AtRest::Draws::refined;
    if (!rest_.mustShow && !interface_.hasChanged())
        return isBusy;
    const std::optional<gpu::Swapchain::Target> target = swapchain_.acquire();
    if (!target)
        return isBusy;
    rest_.mustShow = false;
    const gpu::FrameRing::Frame frame = ring_.begin();
    spreadPicture(frame.commands, rest_.picture.image(), *target, swapchain_.extent(),
                  rest_.picture.shift());
    present(frame, *target);
    return true;
}

} // namespace sward::view
