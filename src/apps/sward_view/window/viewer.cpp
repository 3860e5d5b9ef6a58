#include "apps/sward_view/window/viewer.h"

#include "apps/common/interrupt.h"
#include "apps/sward_view/graphics.h"
#include "apps/sward_view/interface/overlay.h"
#include "core/error.h"
#include "gpu/memory/image_use.h"
#include "presentation/settings_text.h"
#include "shaders/shared/physics.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <optional>
#include <span>
#include <string>
#include <utility>

namespace sward::embedded {
std::span<const EmbeddedFile> shaders();
} // namespace sward::embedded

namespace sward::view {
namespace {

constexpr std::uint32_t framesInFlight = 2;
constexpr std::uint32_t timesKept = 600; ///< frames
constexpr double titleInterval = 0.5;    ///< [s] between two title updates, to stay readable
constexpr double idleWait = 0.1;         ///< [s] between polls of an invisible window
constexpr double noticeTime = 4.0;       ///< [s] display time of a notice
constexpr double smoothing = 0.1;        ///< smoothing of the frame time

// Device time of a frame above which fewer pixels are drawn [s]. On a CPU the window adds a fifth,
// and the tolerance is a seventh: six frames a second. More would cost sharpness, which is missed
// more.
constexpr double wantedOnCpu = 0.12;
constexpr double wantedOnGpu = 1.0 / 30.0;

// Scale of the first frame on a CPU, small for a fast start; it rises if time permits.
constexpr double beginOnCpu = 0.4;

// Largest field time per frame [s]: two physics steps, the most that one update takes.
constexpr double longestOnCpu = 2.0 * static_cast<double>(shared::longestStep);
constexpr double longestOnGpu = 16.0 * static_cast<double>(shared::longestStep);

constexpr std::array background{0.012f, 0.016f, 0.016f, 1.0f};

VkExtent2D extentOf(glm::uvec2 size)
{
    return {size.x, size.y};
}

double secondsBetween(std::chrono::steady_clock::time_point begin,
                      std::chrono::steady_clock::time_point end)
{
    return std::chrono::duration<double>(end - begin).count();
}

VkSemaphoreSubmitInfo semaphoreAt(VkSemaphore semaphore, VkPipelineStageFlags2 stages)
{
    VkSemaphoreSubmitInfo submit{};
    submit.sType = VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO;
    submit.semaphore = semaphore;
    submit.stageMask = stages;
    return submit;
}

// Fills a window without a field with one colour.
void paintBackground(VkCommandBuffer commands, const gpu::Swapchain::Target& target)
{
    constexpr VkImageAspectFlags color = VK_IMAGE_ASPECT_COLOR_BIT;
    gpu::transition(commands, target.image, color, gpu::ImageUse::undefined,
                    gpu::ImageUse::transferTarget);
    VkClearColorValue value{};
    std::copy(background.begin(), background.end(), value.float32);
    const VkImageSubresourceRange whole{color, 0, 1, 0, 1};
    vkCmdClearColorImage(commands, target.image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, &value, 1,
                         &whole);
    gpu::transition(commands, target.image, color, gpu::ImageUse::transferTarget,
                    gpu::ImageUse::colorTarget);
}

} // namespace

Viewer::Viewer(Window& window, const ViewerOptions& options)
    : window_(window)
    , options_(options)
    , instance_(createInstance(options.frame->validation, window.instanceExtensions()))
    , surface_(window.createSurface(instance_.get()))
    , device_(instance_, {.selection = options.frame->device,
                          .surface = surface_.get(),
                          .wantsCopyQueue = options.frame->gpuMemory > 0})
    , swapchain_(device_.context(), surface_.get(), extentOf(window.drawableSize()))
    , interface_(instance_, device_, swapchain_, window.handle())
    , ring_(device_.context(), framesInFlight)
    , timestamps_(device_.context(), {.slots = framesInFlight, .historyFrames = timesKept})
    , picture_(device_.context())
    , rest_(device_.context())
    , controls_(interface_.style(), controlMap_)
    , resolution_(device_.isCpu() ? wantedOnCpu : wantedOnGpu,
                  device_.isCpu() ? beginOnCpu : InternalResolution::highest)
{
    viewerState_.times = &timestamps_;
    viewerState_.recent = &recent_;
    viewerState_.device = device_.context().name;
    viewerState_.hasFfmpeg = !VideoEncoder::program().empty();
    if (!options.frame->settingsFile.empty())
        viewerState_.settingsFile = options.frame->settingsFile;
    const auto* const known = std::ranges::find_if(
        meadowPresets, [&](const MeadowPreset& preset) { return options.meadow == preset.name; });
    if (known != std::end(meadowPresets))
        viewerState_.meadow.meadow = static_cast<int>(known - std::begin(meadowPresets));
    else
        viewerState_.meadow.meadowFile = options.meadow;
    viewerState_.scale = static_cast<float>(resolution_.scale());
    if (options.resolution > 0.0f) {
        viewerState_.automaticScale = false;
        viewerState_.scale = options.resolution;
    }
    viewerState_.refinesAtRest =
        options.refinesAtRest.value_or(device_.isCpu() && viewerState_.automaticScale);
    if (!options.shaderFolder.empty() && options.shaderFolder != "none")
        shaders_.emplace(options.shaderFolder, embedded::shaders());
    controlMap_.writeTo(options.controlsFile);
    layout_.shown = options.panel != "off";
    if (!options.panel.empty() && layout_.shown && !layout_.openPanel(options.panel))
        fail(ErrorKind::usage, "--panel: '{}' is not off or the name of a panel", options.panel);
}

void Viewer::run()
{
    if (options_.frame->fields.empty())
        isFirstInput_ = false;
    else
        open(options_.frame->fields);
    window_.show();
    bool drawn = true;
    while (!isDone()) {
        apps::throwIfInterrupted("viewing");
        // Poll an invisible window at intervals, not continuously.
        if (drawn)
            window_.poll();
        else
            window_.waitForEvents(idleWait);
        interface_.resize(uiScale()); // a new field is framed beside the panel
        takeOpened();
        look();
        fulfil();
        followPainter();
        drawn = draw();
        if (times_.firstShown &&
            secondsBetween(*times_.firstShown, Clock::now()) >= options_.seconds) {
            isClosing_ = true;
            window_.close();
        }
    }
    capture_.stopSequence(); // a film keeps its pictures so far
    device_.waitIdle();
}

void Viewer::look()
{
    // Process the input, then draw one frame of the interface.
    const Clock::time_point now = Clock::now();
    times_.frameSeconds = secondsBetween(times_.lastTick, now);
    times_.lastTick = now;
    interface_.begin();
    Input input = window_.takeInput();
    rest_.mustShow = rest_.mustShow || input.exposed;
    controls_.beginFrame(keysForControls(input));
    // After a click the controls come first: it may begin to type into one of them.
    const bool isClicked = input.leftPressed;
    if (!isClicked)
        pressKeys(input);
    steer(input);
    keepTime();
    tell();
    if (loadedField_ && window_.size() != glm::uvec2(0)) {
        const Overlay overlay(interface_.style(), loadedField_->navigation().camera(),
                              window_.size(), loadedField_->field());
        overlay.draw(viewerState_);
        overlay.tell(viewerState_, controlMap_);
    }
    layout_.draw(controls_, viewerState_);
    if (isClicked)
        pressKeys(input);
    interface_.end();
    controlMap_.finishFrame();
}

void Viewer::keepTime()
{
    // Use real time. After a slow frame, let field time pass more slowly instead of adding physics
    // steps, which would make the next frame slower still.
    FieldTime& time = viewerState_.time;
    const double passed =
        std::min(times_.frameSeconds, device_.isCpu() ? longestOnCpu : longestOnGpu);
    times_.frameBefore = time.now;
    if (capture_.isSequence())
        time.now += capture_.step();
    else if (recorder_.isPlaying())
        time.now += PathRecorder::replayStep;
    else if (time.stepOnce)
        time.now += time.step;
    else if (!time.paused && !rest_.state.isResting())
        time.now += time.scale * passed;
    rest_.isDisturbed = rest_.isDisturbed || time.stepOnce;
    time.stepOnce = false;
    if (!loadedField_)
        return;
    const auto up = [this](const glm::dvec3& place) { return upAt(viewerState_.settings, place); };
    viewerState_.hand.advance(viewerState_.settings.colliders, loadedField_->field().ground, up,
                              times_.frameBefore, time.now);
}

bool Viewer::draw()
{
    const glm::uvec2 size = window_.drawableSize();
    swapchain_.resize(extentOf(size));
    if (size.x == 0 || size.y == 0)
        return false;
    const AtRest::Draws draws = drawsNext();
    return draws == AtRest::Draws::moving ? drawMoving() : drawRefined(draws);
}

bool Viewer::drawMoving()
{
    // Return without an image: an acquired image must be presented, a begun frame submitted.
    const std::optional<gpu::Swapchain::Target> target = swapchain_.acquire();
    if (!target)
        return false;
    const double scale = capture_.wantsFrame() ? 1.0 : static_cast<double>(viewerState_.scale);
    if (loadedField_)
        picture_.resize(swapchain_.extent(), scale, swapchain_.format());
    const std::uint32_t shift = capture_.wantsFrame() ? pictureShift() : 0;

    const gpu::FrameRing::Frame frame = ring_.begin();
    if (loadedField_ && rest_.moving >= framesInFlight)
        viewerState_.counts = loadedField_->renderer().stats(frame.slot);
    timestamps_.beginFrame(frame.commands, frame.slot);
    if (loadedField_) {
        // Thin blades too, which also saves time on a CPU.
        const render::FrameSettings settings = device_.isCpu() && viewerState_.automaticScale
                                                   ? thinnedForScale(viewerState_.settings, scale)
                                                   : viewerState_.settings;
        gpu::transition(frame.commands, picture_.image(), gpu::ImageUse::undefined,
                        gpu::ImageUse::colorTarget);
        {
            const gpu::TimedScope total(timestamps_, device_.context(), frame.commands, "total");
            loadedField_->renderer().record(frame.commands,
                                            {.image = picture_.image().get(),
                                             .view = picture_.image().view(),
                                             .size = picture_.size(),
                                             .whole = shift > 0 ? picture_.size() : glm::uvec2(0),
                                             .first = glm::ivec2(static_cast<int>(shift), 0)},
                                            loadedField_->navigation().camera(), settings,
                                            viewerState_.time.now, frame.slot, &timestamps_);
        }
        const gpu::TimedScope scope(timestamps_, device_.context(), frame.commands, "scaling");
        picture_.spread(frame.commands, *target, swapchain_.extent(), shift);
    } else {
        paintBackground(frame.commands, *target);
    }
    present(frame, *target);
    if (!loadedField_)
        return true;

    ++times_.frames;
    ++rest_.moving;
    if (rest_.pickAt)
        pick(*std::exchange(rest_.pickAt, std::nullopt));
    if (capture_.wantsFrame()) {
        write(picture_.image());
    } else if (viewerState_.automaticScale && !viewerState_.settings.cullingCamera) {
        const std::vector<double> totals = timestamps_.history("total");
        if (!totals.empty() && rest_.moving > framesInFlight)
            resolution_.add(totals.back() / 1000.0);
        viewerState_.scale = static_cast<float>(resolution_.scale());
    }
    return true;
}

void Viewer::present(const gpu::FrameRing::Frame& frame, const gpu::Swapchain::Target& target)
{
    {
        const gpu::TimedScope scope(timestamps_, device_.context(), frame.commands, "interface");
        interface_.record(frame.commands, target);
    }
    gpu::transition(frame.commands, target.image, VK_IMAGE_ASPECT_COLOR_BIT,
                    gpu::ImageUse::colorTarget, gpu::ImageUse::present);

    // Wait for the window's image only in stages that write it.
    std::array<VkSemaphoreSubmitInfo, 2> waits{
        semaphoreAt(target.available, VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT |
                                          VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT)};
    const auto copied = loadedField_ ? loadedField_->renderer().copied() : std::nullopt;
    waits[1] = copied.value_or(waits[0]);
    const std::array signals{semaphoreAt(target.finished, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT)};
    ring_.submit(frame, std::span(waits).first(copied ? 2 : 1), signals);
    swapchain_.present(target);
}

void Viewer::tell()
{
    const Clock::time_point now = Clock::now();
    if (secondsBetween(times_.lastNotice, now) > noticeTime)
        viewerState_.notice.clear();
    const bool isResting = rest_.state.isResting();
    if (!isResting)
        viewerState_.frameSeconds += smoothing * (times_.frameSeconds - viewerState_.frameSeconds);
    viewerState_.passesAtRest = isResting ? std::optional(rest_.state.passesDone()) : std::nullopt;
    viewerState_.drawnAtRest = rest_.picture.drawnBlades();
    // A painted field has other blades than the last moving picture that was counted.
    if (isResting && rest_.picture.fieldBlades() > 0)
        viewerState_.counts.total = viewerState_.counts.resident = rest_.picture.fieldBlades();
    viewerState_.field = loadedField_ ? &loadedField_->field() : nullptr;
    viewerState_.baking = opening_.baking();
    viewerState_.loading = opening_.loading();
    viewerState_.recording = recorder_.isRecording();
    viewerState_.replaying = recorder_.isPlaying();
    viewerState_.sequenceDone = capture_.at();
    if (!loadedField_)
        return;
    viewerState_.deviceBytes = loadedField_->renderer().deviceBytes();
    const Navigation& navigation = loadedField_->navigation();
    viewerState_.heading = headingOf(navigation.camera());
    viewerState_.walking = navigation.isWalking();
    viewerState_.flySpeed = navigation.speed();

    const double seconds = secondsBetween(times_.lastTitle, now);
    if (seconds < titleInterval || times_.frames <= framesInFlight)
        return;
    const auto frames =
        static_cast<double>(std::max<std::uint64_t>(times_.frames - times_.framesAtTitle, 1));
    const std::string pace =
        isResting
            ? fmt::format("{} of {} pictures at rest", rest_.state.passesDone(), AtRest::passes)
            : fmt::format("{:.1f} ms per frame", 1000.0 * seconds / frames);
    window_.setTitle(fmt::format("Sward: {}, {} of {} blades drawn, {}", loadedField_->field().name,
                                 isResting ? viewerState_.drawnAtRest : viewerState_.counts.drawn,
                                 viewerState_.counts.total, pace));
    times_.lastTitle = now;
    times_.framesAtTitle = times_.frames;
}

bool Viewer::hasChanged()
{
    // A streamed field holds the blades of one view, not of tiles in turn.
    if (!viewerState_.refinesAtRest || !loadedField_ || times_.frames < ring_.slots() ||
        swapchain_.extent().width == 0 || loadedField_->renderer().isStreamed() ||
        !loadedField_->renderer().isSettled() || viewerState_.settings.cullingCamera ||
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
