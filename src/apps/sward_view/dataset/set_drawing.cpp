#include "apps/sward_view/dataset/set_drawing.h"

#include "apps/common/interrupt.h"
#include "apps/sward_view/dataset/annotations.h"
#include "apps/sward_view/headless/picture_target.h"
#include "gpu/memory/image_use.h"
#include "gpu/recording/barrier.h"

#include <algorithm>

namespace sward::view {
namespace {

constexpr render::LayerMask aheadLayer = render::bitOf(render::Layer::flowForward);

/// Frames whose commands the device holds while the CPU waits.
constexpr std::uint32_t framesAhead = 2;
constexpr std::uint32_t maxSlots = 12;

/// Memory that places may take together [bytes], and their least number: a frame is drawn, one
/// waits for that, and one is read.
constexpr std::size_t bytesOfPlaces = std::size_t(2) << 30;
constexpr std::size_t minPlaces = 3;

std::uint32_t slotsFor(const DatasetScene& scene)
{
    const bool looksAhead = (SetDrawing::layersOf(scene) & aheadLayer) != 0;
    return std::min(framesAhead * (scene.settling + (looksAhead ? 2 : 1)), maxSlots);
}

render::FieldRendererSettings settingsOf(const DatasetScene& scene, const FrameOptions& options,
                                         VkFormat format, bool isRadiance)
{
    render::FieldRendererSettings settings = rendererFor(options, format, isRadiance);
    settings.framesInFlight = slotsFor(scene);
    settings.keepsMotion = (SetDrawing::layersOf(scene) & render::flowLayers) != 0;
    return settings;
}

gpu::Buffer readBufferOf(const gpu::DeviceContext& context, const char* name, std::size_t bytes)
{
    if (bytes == 0)
        return {};
    return {context,
            {.name = name,
             .bytes = bytes,
             .usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT,
             .memory = gpu::MemoryUse::readback}};
}

} // namespace

SetDrawing::SetDrawing(const gpu::Device& device, const DatasetScene& scene,
                       const FrameOptions& options, const field::FieldView& field, bool isRadiance,
                       std::uint32_t readers)
    : context_(device.context())
    , scene_(scene)
    , field_(field)
    , layers_(layersOf(scene))
    , settings_(options.settingsFor(field))
    , target_(context_, targetFor(context_, scene.size, options.geometry, isRadiance))
    , renderer_(device, field, settingsOf(scene, options, target_.format(), isRadiance))
    , timestamps_(context_, {.slots = slotsFor(scene)})
    , ring_(context_, slotsFor(scene))
{
    settings_.leavesThinned = true;
    if (isRadiance)
        settings_.exposure = 1.0f;
    const std::size_t ofLayers = render::layerBytes(layers_, scene.size);
    const std::size_t ofAhead = render::layerBytes(layers_ & aheadLayer, scene.size);
    const std::size_t ofPicture =
        std::size_t(scene.size.x) * scene.size.y * gpu::bytesPerPixel(target_.format());
    const std::size_t fitting = bytesOfPlaces / (ofLayers + ofAhead + ofPicture);
    places_.resize(std::max(std::min<std::size_t>(fitting, readers + framesAhead), minPlaces));
    for (Place& place : places_) {
        place.layers = readBufferOf(context_, "dataset/layers", ofLayers);
        place.ahead = readBufferOf(context_, "dataset/flow ahead", ofAhead);
        place.picture = readBufferOf(context_, "dataset/picture", ofPicture);
    }
}

render::LayerMask SetDrawing::layersOf(const DatasetScene& scene)
{
    return scene.layers | layersForObjects(scene);
}

std::uint32_t SetDrawing::takePlace()
{
    std::unique_lock lock(mutex_);
    const auto isFree = [](const Place& place) { return place.isFree; };
    freed_.wait(lock, [&] { return std::ranges::any_of(places_, isFree); });
    const auto found = std::ranges::find_if(places_, isFree);
    found->isFree = false;
    return static_cast<std::uint32_t>(found - places_.begin());
}

void SetDrawing::freePlace(std::uint32_t place)
{
    {
        const std::lock_guard lock(mutex_);
        places_[place].isFree = true;
    }
    freed_.notify_all();
}

/// Moves the blades without drawing.
void SetDrawing::move(const DrawnFrame& what, double time)
{
    const gpu::FrameRing::Frame frame = ring_.begin();
    timestamps_.beginFrame(frame.commands, frame.slot);
    {
        const gpu::TimedScope scope(timestamps_, context_, frame.commands, "move");
        renderer_.recordUpdateOnly(frame.commands, what.settings, time, frame.slot);
    }
    ring_.submit(frame);
}

/// Draws into the target. Layers go into `words`, and the picture into `picture` unless null.
gpu::FrameRing::Frame SetDrawing::draw(const render::Camera& camera, const render::Camera& before,
                                       const DrawnFrame& what, double time,
                                       render::LayerMask layers, const gpu::Buffer& words,
                                       const gpu::Buffer* picture)
{
    using gpu::ImageUse;
    const gpu::FrameRing::Frame frame = ring_.begin();
    const gpu::Recording commands(context_, frame.commands);
    timestamps_.beginFrame(frame.commands, frame.slot);
    {
        const gpu::TimedScope total(timestamps_, context_, frame.commands, "total");
        // The copy of the picture before may go on.
        gpu::transition(commands, target_,
                        hasDrawn_ ? ImageUse::transferSource : ImageUse::undefined,
                        ImageUse::colorTarget);
        renderer_.record(frame.commands,
                         {.image = target_.get(),
                          .view = target_.view(),
                          .size = scene_.size,
                          .stored = target_.storedView(),
                          .layers = layers,
                          .layerBuffer = words.get(),
                          .cameraBefore = layers != 0 ? &before : nullptr},
                         camera, what.settings, time, frame.slot, &timestamps_);
        gpu::transition(commands, target_, ImageUse::colorTarget, ImageUse::transferSource);
        hasDrawn_ = true;
        if (picture != nullptr) {
            VkBufferImageCopy all{};
            all.imageSubresource = {target_.aspect(), 0, 0, 1};
            all.imageExtent = {scene_.size.x, scene_.size.y, 1};
            commands.vk->CmdCopyImageToBuffer(commands, target_.get(),
                                              VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, picture->get(),
                                              1, &all);
            gpu::anythingToHost(commands);
        }
    }
    ring_.submit(frame);
    return frame;
}

SetDrawing::Submitted SetDrawing::submit(const DrawnFrame& what)
{
    apps::throwIfInterrupted("drawing");
    const std::uint32_t number = takePlace();
    Submitted submitted;
    submitted.place = std::shared_ptr<void>(nullptr, [this, number](void*) { freePlace(number); });
    const Place& place = places_[number];
    renderer_.forgetMotion();
    for (std::uint32_t i = scene_.settling; i > 0; --i)
        move(what, what.time - double(i) * scene_.step);
    submitted.last =
        draw(what.camera, what.before, what, what.time, layers_, place.layers, &place.picture);
    submitted.picture = place.picture.mapped();
    if (layers_ != 0) {
        submitted.layers = renderer_.layerWords(field_, submitted.last.slot);
        submitted.layers.words = place.layers.mappedAs<const std::uint32_t>();
    }
    if ((layers_ & aheadLayer) != 0) {
        submitted.last = draw(what.next, what.camera, what, what.time + scene_.step, aheadLayer,
                              place.ahead, nullptr);
        submitted.ahead = renderer_.layerWords(field_, submitted.last.slot);
        submitted.ahead.words = place.ahead.mappedAs<const std::uint32_t>();
    }
    return submitted;
}

render::FrameLayers SetDrawing::layersOf(const Submitted& frame) const
{
    render::FrameLayers layers;
    if (frame.layers.wanted != 0)
        layers = render::layersOf(frame.layers, field_);
    constexpr auto forward = static_cast<std::size_t>(render::Layer::flowForward);
    if (frame.ahead.wanted != 0)
        layers.arrays[forward] = render::layersOf(frame.ahead, field_).arrays[forward];
    return layers;
}

double SetDrawing::takeDeviceTime()
{
    double sum = 0.0;
    for (const char* name : {"total", "move"})
        for (const double time : timestamps_.history(name))
            sum += time;
    timestamps_.clearHistory();
    return sum;
}

} // namespace sward::view
