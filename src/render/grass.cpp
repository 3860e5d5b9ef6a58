#include "render/grass.h"

#include "core/embedded.h"
#include "core/error.h"
#include "render/grass_parts.h"
#include "render/host_checks.h"
#include "shaders/shared/passes.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace sward::embedded {
std::span<const EmbeddedFile> shaders();
} // namespace sward::embedded

namespace sward::render {
namespace {

const gpu::DeviceContext& contextForGrass(const gpu::DeviceContext& context,
                                          const Grass::Settings& settings)
{
    gpu::requireDevice(context);
    requireValid(settings);
    return context;
}

void requireSlot(const Grass::Settings& settings, std::uint32_t slot)
{
    requireUsage(slot < settings.framesInFlight, "slot {}, and framesInFlight is {}", slot,
                 settings.framesInFlight);
}

} // namespace

Grass::Parts::Parts(const gpu::DeviceContext& deviceContext, const Settings& wanted)
    : context(contextForGrass(deviceContext, wanted))
    , settings(wanted)
    , shaders(embedded::shaders())
    , walk(context, shaders)
    , update(context)
    , shadowMaps(context, wanted.framesInFlight, wanted.maxViews)
    , raster(context, shadowMaps, {wanted.framesInFlight, wanted.maxViews, wanted.keepsMotion})
    , frameOfSlot(wanted.framesInFlight, 0)
    , depths(wanted.framesInFlight * wanted.maxViews)
{
    update.prepare(shaders, culling);
}

Grass::Grass(const gpu::DeviceContext& context, const Settings& settings)
    : parts_(std::make_unique<Parts>(context, settings))
{
}

Grass::~Grass() = default;

InstanceId Grass::add(const FieldInstance& instance)
{
    Parts& parts = *parts_;
    requireUsage(instance.field != nullptr, "FieldInstance::field is null");
    requireValid(instance.placement);
    parts.take(instance.field->parts());
    const std::uint64_t id = ++parts.lastId;
    parts.placed.emplace(id,
                         std::make_unique<PlacedField>(parts.context, instance, parts.settings));
    return InstanceId{id};
}

void Grass::move(InstanceId id, const Placement& placement)
{
    PlacedField& instance = parts_->instance(id);
    requireValid(placement);
    instance.place(placement);
}

void Grass::remove(InstanceId id)
{
    const PlacedField* const gone = &parts_->instance(id);
    const auto found = parts_->placed.find(static_cast<std::uint64_t>(id));
    std::ranges::replace(parts_->instances, gone, static_cast<const PlacedField*>(nullptr));
    parts_->removed.push_back({std::move(found->second), parts_->frame});
    parts_->placed.erase(found);
}

void Grass::edit(ResidentField& field, const field::Delta& delta)
{
    ResidentField::Parts& edited = field.parts();
    requireUsage(edited.edits != nullptr, "FieldBudget::isEditable of the field is not set");
    parts_->take(edited);
    edited.edits->apply(delta);
}

void Grass::begin(std::uint32_t slot, const GrassFrame& frame)
{
    Parts& parts = *parts_;
    requireSlot(parts.settings, slot);
    requireValid(frame, parts.settings);

    // The slot's former frame and all earlier ones have completed.
    std::erase_if(parts.removed, [&](const Parts::Removed& removed) {
        return removed.lastFrame <= parts.frameOfSlot[slot];
    });
    parts.frameOfSlot[slot] = ++parts.frame;
    parts.slot = slot;
    // Without views until all has been made: nothing is recorded of a frame that has failed.
    parts.viewCount = 0;
    parts.isUpdated = false;
    parts.time = frame.time;

    std::vector<shared::DepthPyramid> pyramids;
    for (const HostView& view : frame.views) {
        const auto index = static_cast<std::uint32_t>(pyramids.size());
        const bool hides = (frame.settings.cullMask & shared::cullOcclusion) != 0;
        Parts::ViewDepth& depth = parts.depthOf(index);
        depth.pyramid = nullptr;
        pyramids.push_back(hides ? parts.lookAtDepth(view, depth) : shared::DepthPyramid{});
    }
    parts.instances.clear();
    for (const auto& [id, field] : parts.placed) {
        if (!field->isUploaded())
            continue;
        if (field->edits() != nullptr)
            field->edits()->begin();
        if (field->blades().bladeCount() > 0)
            parts.instances.push_back(field.get());
        field->write(slot, frame, parts.frame, pyramids);
        const shared::Environment& environment = field->environment();
        parts.moving = {environment.wind.counts, environment.colliderCount > 0,
                        UpdateCullPass::Role::move, parts.settings.keepsMotion, true};
        parts.update.prepare(parts.shaders, parts.moving);
    }
    parts.drawings.clear();
    for (const HostView& view : frame.views)
        parts.drawings.push_back(
            {.obstacle = parts.raster.obstacle(view, parts.instances),
             .storeObstacle = parts.raster.storeObstacle(view, parts.instances, frame.settings),
             .samples = view.samples,
             .hasReversedZ = view.hasReversedZ});
    parts.shadowMaps.begin(slot, frame.light, frame.views);
    parts.raster.begin(parts.shaders, slot, frame.views, parts.instances, frame.settings);
    parts.viewCount = static_cast<std::uint32_t>(frame.views.size());
    parts.hasBegun = true;
}

/// A frame has begun, and there is a buffer to record into.
void Grass::Parts::requireRecording(VkCommandBuffer commands) const
{
    requireUsage(commands != VK_NULL_HANDLE, "the command buffer is null");
    requireUsage(hasBegun, "no frame has begun: Grass::begin() comes first");
}

const Grass::Parts::ViewDrawing& Grass::Parts::drawing(std::uint32_t view) const
{
    requireUsage(view < viewCount, "view {} of a frame with {} views", view, viewCount);
    return drawings[view];
}

PlacedField& Grass::Parts::instance(InstanceId id) const
{
    const auto found = placed.find(static_cast<std::uint64_t>(id));
    requireUsage(found != placed.end(), "there is no instance {}, or no more",
                 static_cast<std::uint64_t>(id));
    return *found->second;
}

/// The field is on the same device. A streamed field holds what the views of one Grass see, in
/// slots of its own; so does an editable one with the edits that one Grass records.
void Grass::Parts::take(const ResidentField::Parts& field) const
{
    requireUsage(field.context.device == context.device,
                 "the field is on another device than the grass");
    if (field.streaming == nullptr && field.edits == nullptr)
        return;
    const char* const kind = field.streaming ? "streamed" : "editable";
    if (field.budget.framesInFlight < settings.framesInFlight)
        fail(ErrorKind::usage, "the field is {} for {} frames in flight; the grass has {}", kind,
             field.budget.framesInFlight, settings.framesInFlight);
    const std::shared_ptr<const void> other = field.grass.lock();
    if (other && other != owner)
        fail(ErrorKind::usage, "the field is {}, and other grass draws it", kind);
    field.grass = owner;
}

shared::DepthPyramid Grass::Parts::lookAtDepth(const HostView& view, ViewDepth& depth)
{
    // The view's depth does not apply to a frozen camera.
    if (!view.depth || view.cullViewFrom)
        return {};
    const PyramidPass::Settings wanted{view.depth->samples, view.hasReversedZ, view.depth->slack};
    const auto made = pyramids.try_emplace({wanted.samples, wanted.hasReversedZ, wanted.slack},
                                           context, shaders, wanted);
    depth.pyramid = &made.first->second;
    depth.pyramid->fit(depth.cells, view.depth->view, view.depth->layout, view.size);
    return depth.cells.layout;
}

FrameStats Grass::stats(std::uint32_t view, std::uint32_t slot) const
{
    requireSlot(parts_->settings, slot);
    requireUsage(view < parts_->settings.maxViews, "view {}, and Grass::Settings::maxViews is {}",
                 view, parts_->settings.maxViews);
    FrameStats sum;
    for (const auto& [id, field] : parts_->placed)
        field->addCounts(slot, view, sum);
    return sum;
}

StreamingStats Grass::streamingStats() const
{
    return parts_->streaming.stats(parts_->instances);
}

const Grass::Settings& Grass::settings() const
{
    return parts_->settings;
}

VkDeviceSize Grass::deviceBytes() const
{
    VkDeviceSize sum = 0;
    for (const auto& [id, field] : parts_->placed)
        sum += field->bytes();
    for (const Parts::Removed& removed : parts_->removed)
        sum += removed.field->bytes();
    for (const Parts::ViewDepth& depth : parts_->depths)
        sum += depth.cells.bytes();
    sum += parts_->raster.bytes();
    return sum;
}

} // namespace sward::render
