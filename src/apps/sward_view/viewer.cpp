#include "apps/sward_view/viewer.h"

#include "apps/common/interrupt.h"
#include "apps/sward_view/camera_file.h"
#include "apps/sward_view/graphics.h"
#include "core/error.h"
#include "core/log.h"
#include "gpu/image_use.h"
#include "render/camera_presets.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <utility>

namespace sward::view {
namespace {

constexpr std::uint32_t framesInFlight = 2;
constexpr double titleInterval = 0.5;  ///< [s] faster would not be readable
constexpr double watchInterval = 0.25; ///< [s] between looks at the settings file
constexpr double idleWait = 0.1;       ///< [s] between looks at a window that shows nothing

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

} // namespace

Viewer::Viewer(Window& window, const field::FieldView& field, const FrameOptions& options,
               std::string name)
    : window_(window)
    , options_(options)
    , field_(field)
    , name_(std::move(name))
    , instance_(createInstance(options.validation, window.instanceExtensions()))
    , surface_(window.createSurface(instance_.get()))
    , device_(instance_, {.selection = options.device, .surface = surface_.get()})
    , swapchain_(device_.context(), surface_.get(), extentOf(window.drawableSize()))
    , renderer_(device_, field,
                {.colorFormat = swapchain_.format(),
                 .samples = options.samples.value_or(device_.isCpu() ? 1 : 4),
                 .framesInFlight = framesInFlight})
    , ring_(device_.context(), framesInFlight)
    , settings_(options.settingsFor(field))
    , orbit_(chooseCamera(options.camera, field, aspect()), groundUpOf(field))
    , lastTick_(Clock::now())
    , lastTitle_(lastTick_)
{
}

void Viewer::run(double seconds)
{
    const Clock::time_point begin = Clock::now();
    lastTick_ = begin;
    lastTitle_ = begin;
    window_.show();
    bool drawn = true;
    while (!window_.isClosed() && secondsBetween(begin, Clock::now()) < seconds) {
        apps::throwIfInterrupted("viewing");
        // A window that shows nothing is asked now and then, not all the time.
        if (drawn)
            window_.poll();
        else
            window_.waitForEvents(idleWait);
        steer(window_.takeInput());
        keepTime();
        if (options_.watch)
            watchSettings();
        drawn = draw();
    }
    device_.waitIdle();
}

float Viewer::aspect() const
{
    const glm::uvec2 size = glm::max(window_.drawableSize(), glm::uvec2(1));
    return static_cast<float>(size.x) / static_cast<float>(size.y);
}

void Viewer::steer(const Input& input)
{
    const auto height = static_cast<float>(window_.drawableSize().y);
    if (input.rotate != glm::vec2(0.0f))
        orbit_.rotate(input.rotate, height);
    if (input.pan != glm::vec2(0.0f))
        orbit_.pan(input.pan, height);
    if (input.wheel != 0.0f)
        orbit_.dolly(input.wheel);
    if (input.frame)
        orbit_.show(
            render::presetCamera(render::CameraPreset::fit, field_, groundUpOf(field_), aspect()));
    if (input.home)
        orbit_.reset();
    if (input.pause)
        paused_ = !paused_;
}

void Viewer::keepTime()
{
    // Real time; the physics takes a step of any length, after a minute behind an icon too.
    const Clock::time_point now = Clock::now();
    if (!paused_)
        time_ += secondsBetween(lastTick_, now);
    lastTick_ = now;
}

void Viewer::watchSettings()
{
    const Clock::time_point now = Clock::now();
    if (secondsBetween(lastLook_, now) < watchInterval)
        return;
    lastLook_ = now;
    std::error_code absent;
    const auto written = std::filesystem::last_write_time(options_.settingsFile, absent);
    if (absent || written == settingsWritten_)
        return;
    const bool isFirst = settingsWritten_ == std::filesystem::file_time_type{};
    settingsWritten_ = written;
    if (isFirst)
        return;
    // Half a sentence is no reason to close the window: the next look finds the whole one.
    try {
        settings_ = options_.settingsFor(field_);
        log::info("{}: read again", options_.settingsFile);
    } catch (const Error& error) {
        log::warn("{}", error.what());
    }
}

bool Viewer::draw()
{
    // No image, no frame: an acquired image must be presented, a begun frame submitted.
    const glm::uvec2 size = window_.drawableSize();
    swapchain_.resize(extentOf(size));
    if (size.x == 0 || size.y == 0)
        return false;
    const std::optional<gpu::Swapchain::Target> target = swapchain_.acquire();
    if (!target)
        return false;

    const gpu::FrameRing::Frame frame = ring_.begin();
    tell(frame.slot);
    constexpr VkImageAspectFlags color = VK_IMAGE_ASPECT_COLOR_BIT;
    gpu::transition(frame.commands, target->image, color, gpu::ImageUse::undefined,
                    gpu::ImageUse::colorTarget);
    const VkExtent2D extent = swapchain_.extent();
    renderer_.record(frame.commands, {target->image, target->view, {extent.width, extent.height}},
                     orbit_.camera(), settings_, time_, frame.slot);
    gpu::transition(frame.commands, target->image, color, gpu::ImageUse::colorTarget,
                    gpu::ImageUse::present);

    // Updating and culling may run while the image is still shown; colour may not.
    const std::array waits{
        semaphoreAt(target->available, VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT)};
    const std::array signals{semaphoreAt(target->finished, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT)};
    ring_.submit(frame, waits, signals);
    swapchain_.present(*target);
    ++frames_;
    return true;
}

void Viewer::tell(std::uint32_t slot)
{
    const Clock::time_point now = Clock::now();
    const double seconds = secondsBetween(lastTitle_, now);
    const bool slotHasCounts = frames_ >= framesInFlight;
    if (seconds < titleInterval || !slotHasCounts)
        return;
    const render::FrameStats stats = renderer_.stats(slot);
    const auto frames = static_cast<double>(std::max<std::uint64_t>(frames_ - framesAtTitle_, 1));
    window_.setTitle(fmt::format("Sward: {}, {} of {} blades drawn, {:.1f} ms per frame", name_,
                                 stats.drawn, stats.total, 1000.0 * seconds / frames));
    lastTitle_ = now;
    framesAtTitle_ = frames_;
}

} // namespace sward::view
