#include "render/grass.h"

#include "core/embedded.h"
#include "core/error.h"
#include "gpu/context/context.h"
#include "render/access.h"
#include "render/frame/frame.h"
#include "render/frame/wind.h"
#include "render/grass_parts.h"
#include "render/host/host_checks.h"
#include "shaders/shared/environment.h"
#include "shaders/shared/passes.h"

#include <algorithm>
#include <optional>
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

/// How blades are moved in frames like this one, of any field and without wind.
UpdateCullPass::Variant movingLike(const GrassFrame& frame, const Grass::Settings& settings,
                                   bool testsSmall)
{
    using Role = UpdateCullPass::Role;
    UpdateCullPass::Variant moving{.role = Role::move, .keepsBefore = settings.keepsMotion};
    if (frame.views.size() != 1)
        return moving;
    shared::Eyepoint tests = testsOf(frame.settings);
    if (isParallel(frame.views.front().worldToClip))
        tests.cullMask &= ~shared::cullDistance;
    moving.role = Role::moveAndCull;
    moving.testsSmall = testsSmall;
    moving.features = shared::featuresOf(tests, false, false, false);
    return moving;
}

/// The same of a field.
UpdateCullPass::Variant movingIn(UpdateCullPass::Variant moving, const BakedBlades& blades)
{
    if (blades.hasOrgans())
        moving.features |= shared::featureOrgans;
    // Streaming thins out what is not in memory.
    if (blades.isPaged())
        moving.features |= shared::featurePages | shared::featureThinning;
    return moving;
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

/// Whether a view's depth hides blades: it does not apply to a frozen camera.
bool readsDepth(const HostView& view, const FrameSettings& settings)
{
    return (settings.cullMask & shared::cullOcclusion) != 0 && view.depth && !view.cullViewFrom;
}

/// What makes a view's depth pyramid; unset: it has none. `isOwn`: see ViewDepth.
std::optional<PyramidPass::Settings> pyramidOf(const HostView& view, const FrameSettings& settings,
                                               bool isOwn)
{
    if (readsDepth(view, settings))
        return PyramidPass::Settings{view.depth->samples, view.hasReversedZ, view.depth->slack};
    if (isOwn)
        return PyramidPass::Settings{};
    return std::nullopt;
}

} // namespace

Grass::Parts::Parts(const gpu::DeviceContext& deviceContext, const Settings& wanted)
    : sharing(contextForGrass(deviceContext, wanted))
    , context(sharing.context)
    , settings(wanted)
    , shaders(embedded::shaders())
    , walk(context, shaders)
    , update(context)
    , shadowMaps(context, wanted.framesInFlight, wanted.maxViews)
    , raster(context, shadowMaps,
             {.slots = wanted.framesInFlight,
              .maxViews = wanted.maxViews,
              .keepsMotion = wanted.keepsMotion,
              .groupsDrawLarge = !wanted.rastersForCpu.value_or(context.isCpu()),
              .limitsLists = wanted.maxListed < Settings{}.maxListed})
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
    parts.take(Access::of(*instance.field));
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
    ResidentField::Parts& edited = Access::of(field);
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

    parts.instances.clear();
    std::vector<PlacedField*> uploaded;
    for (const auto& [id, field] : parts.placed) {
        if (!field->isUploaded())
            continue;
        if (field->edits() != nullptr)
            field->edits()->begin();
        if (field->blades().bladeCount() > 0)
            parts.instances.push_back(field.get());
        uploaded.push_back(field.get());
    }
    parts.drawings.clear();
    std::vector<ViewPyramids> pyramids;
    for (const HostView& view : frame.views) {
        Parts::ViewDrawing drawing{
            .obstacle = parts.raster.obstacle(view, parts.instances),
            .storeObstacle = parts.raster.storeObstacle(view, parts.instances, frame.settings),
            .samples = view.samples,
            .hasReversedZ = view.hasReversedZ};
        drawing.hasTwoPasses = drawing.obstacle == nullptr &&
                               parts.raster.hasTwoPasses(view, parts.instances, frame.settings);
        parts.drawings.push_back(drawing);
        pyramids.push_back(
            parts.lookAtDepth(view, drawing, frame.settings,
                              parts.depthOf(static_cast<std::uint32_t>(pyramids.size()))));
    }
    const auto viewCount = static_cast<std::uint32_t>(frame.views.size());
    for (PlacedField* const field : uploaded) {
        field->write(slot, frame, parts.frame, pyramids);
        for (std::uint32_t view = 0; view < viewCount; ++view)
            if (parts.drawings[view].hasTwoPasses)
                field->expectHistory(view);
    }
    parts.shadowMaps.begin(slot, frame.light, frame.views);
    parts.raster.begin(parts.shaders, slot, frame.views, parts.instances, frame.settings);
    parts.movesWithCull = viewCount == 1;
    parts.moving = movingLike(frame, parts.settings, parts.raster.drawsLargeByGroups());
    for (const PlacedField* const field : uploaded)
        parts.update.prepare(parts.shaders, parts.movingOf(*field));
    parts.viewCount = viewCount;
    parts.hasBegun = true;
}

void Grass::prepare(const GrassFrame& frame, const PreparedFields& fields) const
{
    const Parts& parts = *parts_;
    requireValid(frame, parts.settings);
    requireUsage(!fields.fields.empty(), "PreparedFields::fields is empty");
    for (const ResidentField* field : fields.fields) {
        requireUsage(field != nullptr, "a field of PreparedFields::fields is null");
        parts.requireDevice(Access::of(*field));
    }
    // Passes of this call alone: their pipelines stay among the shared objects, where those of the
    // grass find them. So no lock is held while one is compiled.
    UpdateCullPass update(parts.context);
    const UpdateCullPass::Variant moving =
        movingLike(frame, parts.settings, parts.raster.drawsLargeByGroups());
    for (const ResidentField* field : fields.fields)
        prepareMoves(update, parts.shaders, frame, moving, Access::of(*field).blades);
    for (const HostView& view : frame.views) {
        const bool isOwn = parts.raster.obstacle(view, {}) == nullptr &&
                           HostRaster::hasOwnPyramid(view, frame.settings);
        const auto wanted = pyramidOf(view, frame.settings, isOwn);
        if (wanted && !isOwn)
            PyramidPass(parts.context, *wanted).prepare(parts.shaders);
    }
    parts.raster.preparePipelines(parts.shaders, frame, fields);
}

UpdateCullPass::Variant Grass::Parts::movingOf(const PlacedField& field) const
{
    const shared::Environment& environment = field.environment();
    UpdateCullPass::Variant variant = movingIn(moving, field.blades());
    variant.windCounts = environment.wind.counts;
    variant.hasColliders = environment.colliderCount > 0;
    variant.keepsEtas = field.states().hasEtas();
    return variant;
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

void Grass::Parts::requireDevice(const ResidentField::Parts& field) const
{
    requireUsage(field.context.device == context.device,
                 "the field is on another device than the grass");
}

/// The field is on the same device. A streamed field holds what the views of one Grass see, in
/// slots of its own; so does an editable one with the edits that one Grass records.
void Grass::Parts::take(const ResidentField::Parts& field) const
{
    requireDevice(field);
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

ViewPyramids Grass::Parts::lookAtDepth(const HostView& view, const ViewDrawing& drawing,
                                       const FrameSettings& frameSettings, ViewDepth& depth)
{
    depth.pyramid = nullptr;
    depth.isOwn = drawing.obstacle == nullptr && HostRaster::hasOwnPyramid(view, frameSettings) &&
                  (view.depth || drawing.hasTwoPasses);
    const std::optional<PyramidPass::Settings> wanted = pyramidOf(view, frameSettings, depth.isOwn);
    if (!wanted)
        return {};
    PyramidPass& pass =
        pyramids
            .try_emplace({wanted->samples, wanted->hasReversedZ, wanted->slack}, context, *wanted)
            .first->second;
    if (!depth.isOwn)
        pass.prepare(shaders);
    if (!readsDepth(view, frameSettings)) {
        pass.fit(depth.cells, view.size);
        return {.raster = depth.cells.layout};
    }
    depth.pyramid = &pass;
    pass.fit(depth.cells, view.depth->view, view.depth->layout, view.size);
    return {.culling = depth.cells.layout, .raster = depth.cells.layout};
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
