#include "render/recorder.h"

#include "core/embedded.h"
#include "core/error.h"
#include "render/access.h"
#include "render/resident/resident_parts.h"
#include "shaders/shared/environment.h"
#include "shaders/shared/passes.h"

#include <algorithm>
#include <utility>

namespace sward::embedded {
std::span<const EmbeddedFile> shaders();
} // namespace sward::embedded

namespace sward::render {
namespace {

/// Whether a view's depth hides blades: it does not apply to a frozen camera.
bool readsDepth(const HostView& view, const FrameSettings& settings)
{
    return (settings.cullMask & shared::cullOcclusion) != 0 && view.depth && !view.cullViewFrom;
}

} // namespace

Recorder::Recorder(const gpu::DeviceContext& deviceContext, const Grass::Settings& wanted,
                   const RecorderExtras& extras)
    : sharing(deviceContext)
    , context(sharing.context)
    , settings(wanted)
    , shaders(extras.shaders.empty() ? embedded::shaders() : extras.shaders)
    , walk(context, shaders)
    , update(context)
    , shadowMaps(context, wanted.framesInFlight, wanted.maxViews)
    , raster(context, shadowMaps,
             {.slots = wanted.framesInFlight,
              .maxViews = wanted.maxViews,
              .keepsMotion = wanted.keepsMotion,
              .groupsDrawLarge = !wanted.rastersForCpu.value_or(context.isCpu()),
              .limitsLists = wanted.maxListed < Grass::Settings{}.maxListed})
    , bladeShadows(context, wanted.maxViews)
    , testsSmall(extras.testsSmall.value_or(raster.drawsLargeByGroups()))
    , frameOfSlot(wanted.framesInFlight, 0)
    , depths(wanted.framesInFlight * wanted.maxViews)
{
}

UpdateCullPass::Variant Recorder::movingLike(const GrassFrame& like) const
{
    using Role = UpdateCullPass::Role;
    UpdateCullPass::Variant result{.role = Role::move, .keepsBefore = settings.keepsMotion};
    if (like.views.size() != 1)
        return result;
    shared::Eyepoint tests = testsOf(like.settings);
    if (isParallel(like.views.front().worldToClip))
        tests.cullMask &= ~shared::cullDistance;
    result.role = Role::moveAndCull;
    result.testsSmall = testsSmall;
    result.features = shared::featuresOf(tests, false, false, false);
    return result;
}

UpdateCullPass::Variant movingIn(UpdateCullPass::Variant moving, const BakedBlades& blades)
{
    if (blades.hasOrgans())
        moving.features |= shared::featureOrgans;
    // Streaming thins out what is not in memory.
    if (blades.isPaged())
        moving.features |= shared::featurePages | shared::featureThinning;
    return moving;
}

/// How the blades of an instance are moved: by recordUpdate() for all views, or by the recordCull()
/// of the only view.
UpdateCullPass::Variant Recorder::movingOf(const PlacedField& field) const
{
    const shared::Environment& environment = field.environment();
    UpdateCullPass::Variant variant = movingIn(moving, field.blades());
    if (field.cullResults().address() != 0)
        variant.features |= shared::featureCullResults;
    variant.windCounts = environment.wind.counts;
    variant.hasColliders = environment.colliderCount > 0;
    variant.keepsEtas = field.states().hasEtas();
    return variant;
}

std::optional<PyramidPass::Settings>
Recorder::pyramidOf(const HostView& view, const FrameSettings& frameSettings, bool isOwn)
{
    if (readsDepth(view, frameSettings))
        return PyramidPass::Settings{view.depth->samples, view.hasReversedZ, view.depth->slack};
    if (isOwn)
        return PyramidPass::Settings{};
    return std::nullopt;
}

void Recorder::begin(std::uint32_t slotNumber, const GrassFrame& wanted,
                     const ViewExtras& viewExtras, const ToInstance& toInstance)
{
    // The slot's former frame and all earlier ones have completed.
    std::erase_if(removed,
                  [&](const Removed& gone) { return gone.lastFrame <= frameOfSlot[slotNumber]; });
    frameOfSlot[slotNumber] = ++frame;
    slot = slotNumber;
    // Without views until all has been made: nothing is recorded of a frame that has failed.
    viewCount = 0;
    isUpdated = false;
    time = wanted.time;
    extras = viewExtras;

    beginInstances();
    beginViews(wanted);
    const auto views = static_cast<std::uint32_t>(wanted.views.size());
    for (auto& [id, instance] : placed) {
        if (!instance.field->isUploaded())
            continue;
        if (!std::exchange(instance.isWritten, true))
            instance.placement.before = instance.placement.now;
        InstanceFrame written = toInstance(instance);
        addPyramids(written, wanted);
        addShadows(written, *instance.field);
        instance.field->write(slot, written, frame);
        instance.placement.before = instance.placement.now;
        for (std::uint32_t view = 0; view < views; ++view)
            if (drawings[view].hasTwoPasses)
                instance.field->expectHistory(view);
    }
    shadowMaps.begin(slot, wanted.light, wanted.views);
    raster.begin(shaders, slot, wanted.views, drawings, instances, wanted.settings);
    beginLayers(wanted);
    movesWithCull = views == 1;
    moving = movingLike(wanted);
    forEach([&](const PlacedField& field) { update.prepare(shaders, movingOf(field)); });
    viewCount = views;
    hasBegun = true;
}

/// Finds the instances of a frame, which follow the edits of their fields.
void Recorder::beginInstances()
{
    instances.clear();
    instanceIds.clear();
    for (const auto& [id, instance] : placed) {
        PlacedField& field = *instance.field;
        if (!field.isUploaded())
            continue;
        if (field.edits() != nullptr)
            field.edits()->begin();
        // A layer's picture needs an instance, even if it is bare.
        if (field.blades().bladeCount() == 0 && extras.layer == nullptr)
            continue;
        instances.push_back(&field);
        instanceIds.push_back(id);
    }
}

/// Prepares the layers of views that want some and are rasterised.
void Recorder::beginLayers(const GrassFrame& wanted)
{
    std::vector<Placement> placements;
    for (std::uint32_t i = 0; i < wanted.views.size(); ++i) {
        const HostView& view = wanted.views[i];
        const bool hasLayers = view.layers && view.layers->wanted != 0;
        drawings[i].hasLayers = hasLayers && drawings[i].obstacle == nullptr && !instances.empty();
        if (!drawings[i].hasLayers)
            continue;
        if (placements.empty())
            for (const std::uint64_t id : instanceIds)
                placements.push_back(placed.at(id).placement.now);
        if (!hostLayers)
            hostLayers.emplace(context, shadowMaps, settings.framesInFlight, settings.maxViews);
        hostLayers->prepare(shaders, slot, i, view, placements);
    }
}

ViewDrawing Recorder::drawingOf(const HostView& view, const FrameSettings& frameSettings) const
{
    ViewDrawing result{
        .samples = view.samples, .hasReversedZ = view.hasReversedZ, .onlyMoves = extras.onlyMoves};
    if (extras.layer != nullptr) {
        // The history is the picture's. Without the occlusion test hidden blades count as drawn;
        // the late pass drops them all the same, since this changes no picture.
        result.layer = extras.layer;
        result.drawsAll = extras.drawsAll;
        result.hasTwoPasses = raster.drawsLargeByGroups() && !view.cullViewFrom && !extras.drawsAll;
        return result;
    }
    result.obstacle = raster.obstacle(view, instances);
    result.storeObstacle = raster.storeObstacle(view, instances, frameSettings);
    result.hasTwoPasses =
        result.obstacle == nullptr && raster.hasTwoPasses(view, instances, frameSettings);
    return result;
}

/// Decides how the views are drawn, and makes their pyramids.
void Recorder::beginViews(const GrassFrame& wanted)
{
    drawings.clear();
    for (const HostView& view : wanted.views) {
        drawings.push_back(drawingOf(view, wanted.settings));
        lookAtDepth(view, drawings.back(), wanted.settings,
                    depthOf(static_cast<std::uint32_t>(drawings.size() - 1)));
    }
}

void Recorder::lookAtDepth(const HostView& view, const ViewDrawing& drawing,
                           const FrameSettings& frameSettings, ViewDepth& depth)
{
    depth.pyramid = nullptr;
    const bool looks = (frameSettings.cullMask & shared::cullOcclusion) != 0;
    if (drawing.layer != nullptr) {
        depth.hides = looks && !view.cullViewFrom;
        depth.isOwn = depth.hides || drawing.hasTwoPasses;
    } else {
        depth.hides = readsDepth(view, frameSettings);
        depth.isOwn = drawing.obstacle == nullptr &&
                      ViewRaster::hasOwnPyramid(view, frameSettings) &&
                      (view.depth || drawing.hasTwoPasses);
    }
    const std::optional<PyramidPass::Settings> wanted = pyramidOf(view, frameSettings, depth.isOwn);
    if (!wanted)
        return;
    PyramidPass& pass =
        pyramids
            .try_emplace({wanted->samples, wanted->hasReversedZ, wanted->slack}, context, *wanted)
            .first->second;
    if (!depth.isOwn)
        pass.prepare(shaders);
    if (!readsDepth(view, frameSettings)) {
        pass.fit(depth.cells, view.size);
        return;
    }
    depth.pyramid = &pass;
    pass.fit(depth.cells, view.depth->view, view.depth->layout, view.size);
}

void Recorder::addPyramids(InstanceFrame& instance, const GrassFrame& wanted)
{
    for (std::uint32_t i = 0; i < instance.views.size(); ++i) {
        InstanceView& view = instance.views[i];
        const ViewDepth& depth = depthOf(i);
        if (depth.hides)
            view.cullPyramid = depth.cells.layout;
        else if (i == 0 && wanted.views[i].cullViewFrom)
            view.cullPyramid = extras.frozen;
        if (depth.isOwn || depth.pyramid != nullptr)
            view.rasterPyramid = depth.cells.layout;
    }
}

/// Decides which views have shadows of blades, the same for all instances.
void Recorder::addShadows(InstanceFrame& instance, PlacedField& field)
{
    field.expectViews(static_cast<std::uint32_t>(instance.views.size()));
    for (std::uint32_t i = 0; i < instance.views.size(); ++i) {
        InstanceView& view = instance.views[i];
        if (!bladeShadows.isPossible())
            view.shadowBox.reset();
        drawings[i].hasShadows = view.shadowBox.has_value();
        if (!view.shadowBox)
            continue;
        view.shadowMap = bladeShadows.expectMap(i);
        field.expectShadow(i);
        bladeShadows.prepare(shaders, BladeShadowPass::variantOf(field));
    }
}

VkDeviceSize Recorder::deviceBytes() const
{
    VkDeviceSize sum = raster.bytes() + bladeShadows.bytes();
    for (const auto& [id, instance] : placed)
        sum += instance.field->bytes();
    for (const Removed& gone : removed)
        sum += gone.field->bytes();
    for (const ViewDepth& depth : depths)
        sum += depth.cells.bytes();
    return sum;
}

} // namespace sward::render
