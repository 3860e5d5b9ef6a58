#include "render/grass.h"

#include "core/error.h"
#include "gpu/context/context.h"
#include "gpu/context/debug.h"
#include "render/access.h"
#include "render/frame/frame.h"
#include "render/frame/wind.h"
#include "render/host/host_checks.h"
#include "render/layers/frame_layers.h"
#include "render/layers/host_layers_pass.h"
#include "render/recorder.h"
#include "render/resident/resident_parts.h"
#include "render/tessellation/blade_target_parts.h"
#include "shaders/shared/environment.h"
#include "shaders/shared/passes.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

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

/// Prepares frames with and without colliders, if this one has some. Instances keep their collision
/// state afterwards.
void prepareMoves(UpdateCullPass& pass, const gpu::ShaderLibrary& shaders, const GrassFrame& frame,
                  const UpdateCullPass::Variant& moving, const BakedBlades& blades)
{
    UpdateCullPass::Variant variant = movingIn(moving, blades);
    variant.windCounts = together(blowing(frame.settings.winds, glm::dvec3(0.0)), 1.0f).counts;
    variant.keepsEtas = blades.isPaged();
    pass.prepare(shaders, variant);
    if (frame.colliders.empty())
        return;
    variant.keepsEtas = true;
    pass.prepare(shaders, variant);
    variant.hasColliders = true;
    pass.prepare(shaders, variant);
}

} // namespace

/// The recorder, for hosts.
struct Grass::Parts : Recorder {
    Parts(const gpu::DeviceContext& deviceContext, const Settings& wanted)
        : Recorder(contextForGrass(deviceContext, wanted), wanted)
    {
        update.prepare(shaders, culling);
    }

    std::shared_ptr<const void> owner = std::make_shared<char>(); ///< see ResidentField::Parts

    gpu::Recording recording(VkCommandBuffer commands) const;
    const ViewDrawing& drawing(std::uint32_t view) const;
    void requireTarget(std::uint32_t view, const BladeTarget& target) const;
    Placed& instance(InstanceId id);
    void requireDevice(const ResidentField::Parts& field) const;
    void take(const ResidentField::Parts& field) const;
    void requireLayers(const GrassFrame& frame) const;
};

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
    const ResidentField::Parts& field = Access::of(*instance.field);
    parts.take(field);
    const std::uint64_t id = ++parts.lastId;
    const PlacedField::Settings settings{.framesInFlight = parts.settings.framesInFlight,
                                         .maxViews = parts.settings.maxViews,
                                         .keepsMotion = parts.settings.keepsMotion,
                                         .maxListed = parts.settings.maxListed};
    auto placed =
        std::make_unique<PlacedField>(parts.context, field.field, settings, instance.field);
    parts.placed.emplace(id, Recorder::Placed{std::move(placed), {instance.placement, {}}});
    return InstanceId{id};
}

void Grass::move(InstanceId id, const Placement& placement)
{
    Recorder::Placed& instance = parts_->instance(id);
    requireValid(placement);
    instance.placement.now = placement;
}

void Grass::remove(InstanceId id)
{
    Recorder::Placed& gone = parts_->instance(id);
    std::ranges::replace(parts_->instances, gone.field.get(), static_cast<PlacedField*>(nullptr));
    parts_->removed.push_back({std::move(gone.field), parts_->frame});
    parts_->placed.erase(static_cast<std::uint64_t>(id));
}

void Grass::edit(ResidentField& field, const field::Delta& delta)
{
    ResidentField::Parts& edited = Access::of(field);
    requireUsage(edited.field.isEditable(), "FieldBudget::isEditable of the field is not set");
    parts_->take(edited);
    edited.field.apply(delta);
}

void Grass::begin(std::uint32_t slot, const GrassFrame& frame)
{
    Parts& parts = *parts_;
    requireSlot(parts.settings, slot);
    requireValid(frame, parts.settings);
    parts.requireLayers(frame);
    parts.begin(slot, frame, {}, [&](const Recorder::Placed& instance) {
        return inField(frame, instance.placement, instance.field->field().shape, parts.frame);
    });
}

void Grass::prepare(const GrassFrame& frame, const PreparedFields& fields) const
{
    const Parts& parts = *parts_;
    requireValid(frame, parts.settings);
    parts.requireLayers(frame);
    requireUsage(!fields.fields.empty(), "PreparedFields::fields is empty");
    for (const ResidentField* field : fields.fields) {
        requireUsage(field != nullptr, "a field of PreparedFields::fields is null");
        parts.requireDevice(Access::of(*field));
    }
    // Passes of this call alone: their pipelines stay among the shared objects, where those of the
    // grass find them. So no lock is held while one is compiled.
    UpdateCullPass update(parts.context);
    const UpdateCullPass::Variant moving = parts.movingLike(frame);
    for (const ResidentField* field : fields.fields)
        prepareMoves(update, parts.shaders, frame, moving, Access::of(*field).field.blades);
    for (const HostView& view : frame.views) {
        const bool isOwn = parts.raster.obstacle(view, {}) == nullptr &&
                           ViewRaster::hasOwnPyramid(view, frame.settings);
        const auto wanted = Recorder::pyramidOf(view, frame.settings, isOwn);
        if (wanted && !isOwn)
            PyramidPass(parts.context, *wanted).prepare(parts.shaders);
    }
    parts.raster.preparePipelines(parts.shaders, frame, fields);
    HostLayersPass layers(parts.context, parts.shadowMaps, 1, 1);
    for (const HostView& view : frame.views)
        if (view.layers && parts.raster.obstacle(view, {}) == nullptr)
            layers.pipelineOf(parts.shaders, {.samples = view.samples,
                                              .hasHostLight = isLitByHost(frame.light, view)});
}

/// The layers that views want can be written.
void Grass::Parts::requireLayers(const GrassFrame& frame) const
{
    for (std::size_t i = 0; i < frame.views.size(); ++i) {
        if (!frame.views[i].layers)
            continue;
        requireValid(*frame.views[i].layers, i, settings.keepsMotion);
        requireUsage(placed.size() <= LayerId::maxFields,
                     "view {}: layers of {} instances; at most {}", i, placed.size(),
                     LayerId::maxFields);
    }
}

/// A frame has begun, and there is a buffer to record into.
gpu::Recording Grass::Parts::recording(VkCommandBuffer commands) const
{
    requireUsage(commands != VK_NULL_HANDLE, "the command buffer is null");
    requireUsage(hasBegun, "no frame has begun: Grass::begin() comes first");
    return {context, commands};
}

const ViewDrawing& Grass::Parts::drawing(std::uint32_t view) const
{
    requireUsage(view < viewCount, "view {} of a frame with {} views", view, viewCount);
    return drawings[view];
}

Recorder::Placed& Grass::Parts::instance(InstanceId id)
{
    const auto found = placed.find(static_cast<std::uint64_t>(id));
    requireUsage(found != placed.end(), "there is no instance {}, or no more",
                 static_cast<std::uint64_t>(id));
    return found->second;
}

void Grass::Parts::requireDevice(const ResidentField::Parts& field) const
{
    requireUsage(field.context.device == context.device,
                 "the field is on another device than the grass");
}

/// The field is on the same device. A streamed field holds what the views of one Grass see, in
/// slots of its own; so do a sown one and an editable one with the edits that one Grass records.
void Grass::Parts::take(const ResidentField::Parts& field) const
{
    requireDevice(field);
    if (field.field.streaming == nullptr && field.field.edits == nullptr &&
        field.field.sowing == nullptr)
        return;
    const char* const kind = field.field.streaming ? "streamed"
                             : field.field.sowing  ? "sown"
                                                   : "editable";
    if (field.budget.framesInFlight < settings.framesInFlight)
        fail(ErrorKind::usage, "the field is {} for {} frames in flight; the grass has {}", kind,
             field.budget.framesInFlight, settings.framesInFlight);
    const std::shared_ptr<const void> other = field.grass.lock();
    if (other && other != owner)
        fail(ErrorKind::usage, "the field is {}, and other grass draws it", kind);
    field.grass = owner;
}

void Grass::recordUpdate(VkCommandBuffer buffer)
{
    const gpu::Recording commands = parts_->recording(buffer);
    requireUsage(!parts_->isUpdated, "Grass::recordUpdate() is called a second time in a frame");
    const gpu::LabelScope label(parts_->context, commands, "grass/update");
    parts_->recordUpdate(commands);
}

void Grass::recordCull(VkCommandBuffer buffer, std::uint32_t view)
{
    const gpu::Recording commands = parts_->recording(buffer);
    parts_->drawing(view);
    requireUsage(parts_->isUpdated, "Grass::recordCull() needs recordUpdate() before it");
    const gpu::LabelScope label(parts_->context, commands, "grass/cull");
    parts_->recordCull(commands, view, nullptr);
}

void Grass::recordRaster(VkCommandBuffer buffer, std::uint32_t view)
{
    const gpu::Recording commands = parts_->recording(buffer);
    requireUsage(parts_->drawing(view).isCulled,
                 "Grass::recordRaster() of view {} needs its recordCull() before it", view);
    if (whyTessellated(view) != nullptr)
        return;
    const gpu::LabelScope label(parts_->context, commands, "grass/raster");
    parts_->recordRaster(commands, view, nullptr);
}

/// The target is of the device, and suits the view.
void Grass::Parts::requireTarget(std::uint32_t view, const BladeTarget& target) const
{
    requireUsage(target.device() == context.device,
                 "the target is of another device than the grass");
    requireUsage(target.settings().hasReversedZ == drawing(view).hasReversedZ,
                 "HostTarget::hasReversedZ is {}, and HostView::hasReversedZ of view {} is {}",
                 target.settings().hasReversedZ, view, drawing(view).hasReversedZ);
    requireUsage(!target.settings().writesMotion || settings.keepsMotion,
                 "a target that writes motion needs Grass::Settings::keepsMotion");
}

const char* Grass::whyTessellated(std::uint32_t view, const BladeTarget& target) const
{
    const char* const obstacle = whyTessellated(view);
    parts_->requireTarget(view, target);
    if (obstacle != nullptr)
        return obstacle;
    if (target.settings().samples != parts_->drawing(view).samples)
        return "the target has another number of samples than the view";
    return Access::of(target).visibility
               ? nullptr
               : "the device draws the rasteriser's result into no such target";
}

const char* Grass::whyTessellated(std::uint32_t view) const
{
    return parts_->drawing(view).obstacle;
}

const char* Grass::whyNotStored(std::uint32_t view) const
{
    return parts_->drawing(view).storeObstacle;
}

std::vector<InstanceId> Grass::layerInstances() const
{
    std::vector<InstanceId> ids;
    for (const std::uint64_t id : parts_->instanceIds)
        ids.push_back(InstanceId{id});
    return ids;
}

void Grass::recordDraw(VkCommandBuffer buffer, std::uint32_t view, const BladeTarget& target) const
{
    const Parts& parts = *parts_;
    const gpu::Recording commands = parts.recording(buffer);
    const ViewDrawing& drawing = parts.drawing(view);
    requireUsage(drawing.isCulled,
                 "Grass::recordDraw() of view {} needs its recordCull() before it", view);
    parts.requireTarget(view, target);
    const gpu::LabelScope label(parts.context, commands, "grass/draw");
    const BladeTarget::Parts& drawn = Access::of(target);
    // What is stored is not drawn a second time; only its depth may be.
    if (drawing.isRastered && drawing.storeObstacle == nullptr &&
        !target.settings().colorFormats.empty())
        return;
    if (drawing.isRastered && whyTessellated(view, target) == nullptr) {
        parts.raster.recordDraw(commands, parts.slot, view, *drawn.visibility);
        return;
    }
    const bool isColored = !target.settings().colorFormats.empty();
    const gpu::GraphicsPipeline& pipeline =
        isColored && parts.shadowMaps.isLit(parts.slot, view) ? drawn.hostLight : drawn.tessellated;
    pipeline.bind(commands);
    if (isColored)
        parts.shadowMaps.of(parts.slot, view)
            .bind(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline.layout());
    parts.forEach([&](const PlacedField& field) {
        if (field.blades().bladeCount() == 0)
            return;
        // A late list is that of a view with two passes, in a target that the view does not suit.
        for (std::uint32_t list = 0; list < (drawing.hasTwoPasses ? 2u : 1u); ++list) {
            pipeline.push(
                commands,
                shared::BladePush{
                    .frame =
                        field.place(parts.slot, InstanceConstants::Kind::drawing, view).address,
                    .rounds = field.list(view).rounds().address(),
                    .motion = target.settings().writesMotion ? field.motion(parts.slot, view) : 0,
                    .isLate = list,
                    .reserved = 0});
            commands.vk->CmdDrawIndirect(commands, field.list(view).draw().get(),
                                         list * sizeof(shared::DrawArguments), 1,
                                         sizeof(shared::DrawArguments));
        }
    });
}

void Grass::recordDepth(VkCommandBuffer commands, std::uint32_t view,
                        const BladeTarget& target) const
{
    requireUsage(target.settings().colorFormats.empty(),
                 "Grass::recordDepth() draws into a target without colours; this one has {}",
                 target.settings().colorFormats.size());
    recordDraw(commands, view, target);
}

FrameStats Grass::stats(std::uint32_t view, std::uint32_t slot) const
{
    requireSlot(parts_->settings, slot);
    requireUsage(view < parts_->settings.maxViews, "view {}, and Grass::Settings::maxViews is {}",
                 view, parts_->settings.maxViews);
    FrameStats sum;
    for (const auto& [id, instance] : parts_->placed)
        instance.field->addCounts(slot, view, sum);
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
    return parts_->deviceBytes();
}

} // namespace sward::render
