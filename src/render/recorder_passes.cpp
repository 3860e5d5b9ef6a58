#include "gpu/recording/barrier.h"
#include "render/cull/pass_scope.h"
#include "render/recorder.h"
#include "shaders/shared/passes.h"

#include <algorithm>
#include <functional>
#include <utility>

namespace sward::render {

using Kind = InstanceConstants::Kind;

// 1. Waits for the frame before, carries out edits, and starts states and streaming.

void Recorder::recordBegin(const gpu::Recording& commands)
{
    isUpdated = true;
    gpu::memoryBarrier(commands, gpu::anyAccess, gpu::transferAccess);
    for (const auto& [id, instance] : placed) {
        PlacedField& field = *instance.field;
        if (!field.isInFrame(frame))
            continue;
        field.recordReplaced(commands, slot);
        if (!movesWithCull) {
            commands.vk->CmdFillBuffer(commands, field.moved().get(), 0, VK_WHOLE_SIZE, 0);
            for (std::uint32_t view = 0; view < viewCount; ++view)
                field.list(view).clear(commands);
        }
        field.recordStart(commands, time);
    }
    recordEdits(commands);
    gpu::transferToCompute(commands);
}

/// Records the edits of each field in the frame, once for all its instances.
void Recorder::recordEdits(const gpu::Recording& commands) const
{
    std::vector<const ResidentEdits*> recorded;
    forEach([&](const PlacedField& first) {
        ResidentEdits* const edits = first.edits();
        if (edits == nullptr || std::ranges::find(recorded, edits) != recorded.end())
            return;
        recorded.push_back(edits);
        std::vector<const BladeStates*> states;
        forEach([&](const PlacedField& field) {
            if (field.edits() == edits)
                states.push_back(&field.states());
        });
        edits->record(commands, states, settledAt(), slot);
    });
}

// 2. Moves the blades for several views. Those of a single view are moved when they are culled.

void Recorder::recordUpdate(const gpu::Recording& commands)
{
    recordBegin(commands);
    streaming.record(commands, slot, settledAt(), instances);
    shadowMaps.record(commands);
    if (movesWithCull)
        return;
    // Each view moves only blades that no earlier view has moved.
    walkAll(commands, 0, viewCount, true);
    for (std::uint32_t view = 0; view < viewCount; ++view) {
        if (view > 0)
            gpu::computeToCompute(commands);
        forEach([&](const PlacedField& field) {
            update.record(commands, field.blades(), field.list(view), movingOf(field),
                          UpdateCullPass::Scope::visible,
                          {.frame = field.place(slot, Kind::update, view),
                           .views = field.place(slot, Kind::update, 0).address,
                           .viewCount = viewCount,
                           .before = field.states().before()});
        });
    }
    gpu::computeToTransfer(commands);
    forEach([&](const PlacedField& field) { field.recordMoved(commands, slot); });
    gpu::memoryBarrier(commands, gpu::transferAccess, gpu::hostAccess);
}

void Recorder::recordMoveAll(const gpu::Recording& commands)
{
    recordBegin(commands);
    forEach([&](const PlacedField& field) {
        update.record(
            commands, field.blades(), field.list(0), movingOf(field), UpdateCullPass::Scope::all,
            {.frame = field.place(slot, Kind::culling, 0), .before = field.states().before()});
    });
}

// 3. Culls the blades of a view: depths, walk, and the list, unless its rounds are listed one by
// one between those of the rasteriser.

void Recorder::recordCull(const gpu::Recording& commands, std::uint32_t view,
                          gpu::Timestamps* times)
{
    ViewDrawing& drawn = drawings[view];
    drawn.isCulled = true;
    gpu::memoryBarrier(commands, gpu::anyAccess, gpu::fillAccess);
    forEach([&](PlacedField& field) {
        field.list(view).clear(commands);
        if (drawn.hasShadows)
            field.shadowList(view).clear(commands);
        field.clearCullResults(commands);
        if (drawn.hasTwoPasses)
            field.history(view).begin(commands);
    });
    if (drawn.hasShadows)
        bladeShadows.clear(commands, view);
    recordDepth(commands, view, times);
    {
        const DispatchScope scope(context, commands, times, "cull");
        walkAll(commands, view, view + 1, false);
    }
    const bool listsInRounds = drawn.layer != nullptr;
    if (listsInRounds && !extras.drawsAll)
        return;
    recordLists(commands, view, 0, false, times);
    recordShadow(commands, view, times);
    gpu::memoryBarrier(commands, gpu::computeAccess, gpu::anyAccess);
    recordCounts(commands, view);
    // The rasteriser counts on.
    gpu::memoryBarrier(commands, gpu::transferAccess, gpu::hostOrDispatchAccess);
    if (!extras.drawsAll)
        return;
    walkAgain(commands, view);
    if (!listsInRounds)
        recordLists(commands, view, 0, true, times);
}

/// Fills the pyramid of a view, and the visibility buffer.
void Recorder::recordDepth(const gpu::Recording& commands, std::uint32_t view,
                           gpu::Timestamps* times)
{
    const ViewDrawing& drawn = drawings[view];
    const ViewDepth& depth = depthOf(view);
    if (drawn.layer != nullptr) {
        raster.recordLayer(commands, slot, view, depth.hides, times);
        return;
    }
    if (depth.pyramid != nullptr && !depth.isOwn) {
        const DispatchScope scope(context, commands, times, "pyramid");
        // All fields share the view's pyramid: fill it once.
        bool isFilled = false;
        forEach([&](const PlacedField& field) {
            if (!std::exchange(isFilled, true))
                depth.pyramid->record(commands, depth.cells,
                                      field.place(slot, Kind::culling, view).address);
        });
    }
    if (drawn.obstacle == nullptr)
        raster.recordBegin(commands, slot, view,
                           depth.pyramid != nullptr ? &depth.cells.picture : nullptr);
    else
        gpu::memoryBarrier(commands, gpu::fillAccess, gpu::dispatchAccess);
}

/// Finds the visible patches of views: step by step, all instances together.
void Recorder::walkAll(const gpu::Recording& commands, std::uint32_t firstView,
                       std::uint32_t endView, bool isUpdate) const
{
    std::uint32_t steps = 0;
    forEach(
        [&](const PlacedField& field) { steps = std::max(steps, field.blades().tree().steps()); });
    for (std::uint32_t step = 0; step < steps; ++step) {
        forEach([&](const PlacedField& field) {
            if (step >= field.blades().tree().steps())
                return;
            for (std::uint32_t view = firstView; view < endView; ++view)
                walk.recordStep(commands, field.blades(), field.list(view),
                                (isUpdate ? field.place(slot, Kind::update, view)
                                          : field.place(slot, Kind::culling, view))
                                    .address,
                                step);
            for (std::uint32_t view = firstView; view < endView && !isUpdate; ++view)
                if (drawings[view].hasShadows)
                    walk.recordStep(commands, field.blades(), field.shadowList(view),
                                    field.place(slot, Kind::shadow, view).address, step);
        });
        gpu::computeToCompute(commands);
    }
}

/// Finds all patches, after what ViewExtras::drawsAll has culled.
void Recorder::walkAgain(const gpu::Recording& commands, std::uint32_t view) const
{
    gpu::memoryBarrier(commands, gpu::anyAccess, gpu::transferAccess);
    forEach([&](const PlacedField& field) { field.list(view).clear(commands); });
    gpu::transferToCompute(commands);
    forEach([&](const PlacedField& field) {
        walk.record(commands, field.blades(), field.list(view),
                    field.place(slot, Kind::listing, view).address);
    });
    gpu::computeToCompute(commands);
}

/// Culls and lists the blades of a round of visible patches, and moves those of a single view.
void Recorder::recordLists(const gpu::Recording& commands, std::uint32_t view, std::uint32_t round,
                           bool listsAll, gpu::Timestamps* times) const
{
    const DispatchScope scope(context, commands, times, "update");
    forEach([&](const PlacedField& field) {
        UpdateCullPass::Input input{.frame = listsAll ? field.place(slot, Kind::listing, view)
                                                      : field.place(slot, Kind::culling, view),
                                    .round = round};
        if (drawings[view].hasTwoPasses)
            input.history = {.address = field.history(view).address(),
                             .frame = field.history(view).frame()};
        if (movesWithCull)
            input.before = field.states().before();
        update.record(commands, field.blades(), field.list(view),
                      movesWithCull ? movingOf(field) : culling, UpdateCullPass::Scope::visible,
                      input);
    });
}

/// Draws the blades near the eye as the sun sees them, once they have moved.
void Recorder::recordShadow(const gpu::Recording& commands, std::uint32_t view,
                            gpu::Timestamps* times) const
{
    if (!drawings[view].hasShadows)
        return;
    gpu::computeToCompute(commands);
    const DispatchScope scope(context, commands, times, "shadow");
    forEach([&](const PlacedField& field) {
        bladeShadows.record(commands, view, BladeShadowPass::variantOf(field),
                            field.shadowList(view), field.place(slot, Kind::shadow, view));
    });
}

void Recorder::recordCounts(const gpu::Recording& commands, std::uint32_t view) const
{
    forEach([&](const PlacedField& field) { field.recordCounts(commands, slot, view); });
}

// 4. Rasterises the blades of a view: early, late, large and cut ones; then lights them.

void Recorder::recordRaster(const gpu::Recording& commands, std::uint32_t view,
                            gpu::Timestamps* times)
{
    ViewDrawing& drawn = drawings[view];
    const auto list = [&](std::uint32_t round) {
        recordLists(commands, view, round, extras.drawsAll, times);
    };
    ViewRaster::Rounds rounds;
    if (drawn.layer != nullptr) {
        forEach([&](const PlacedField& field) { rounds.count = field.roundCount(view); });
        rounds.list = std::ref(list); // a reference allocates nothing while recording
    }
    const auto layers = [&](const shared::HostViewPush& push) {
        const DispatchScope scope(context, commands, times, "layers");
        hostLayers->record(commands, slot, view, push);
    };
    if (drawn.hasLayers)
        rounds.beforeLight = std::ref(layers);
    raster.record(commands, slot, view, instances, rounds, times);
    // Of a host's view they are drawn by recordCull(): its list is whole then.
    if (drawn.layer != nullptr && drawn.hasShadows) {
        recordShadow(commands, view, times);
        gpu::memoryBarrier(commands, gpu::computeAccess, gpu::anyAccess);
    }
    drawn.isRastered = true;
    // Late passes have counted hidden blades, and rounds all of them.
    if (extras.drawsAll || (!drawn.hasTwoPasses && drawn.layer == nullptr))
        return;
    recordCounts(commands, view);
    gpu::memoryBarrier(commands, gpu::transferAccess, gpu::hostAccess);
}

} // namespace sward::render
