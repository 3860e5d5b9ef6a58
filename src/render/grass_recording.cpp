#include "core/error.h"
#include "gpu/context/debug.h"
#include "gpu/recording/barrier.h"
#include "render/access.h"
#include "render/grass_parts.h"
#include "render/tessellation/blade_target_parts.h"
#include "shaders/shared/passes.h"

#include <algorithm>
#include <utility>

namespace sward::render {

void Grass::Parts::walkAll(const gpu::Recording& commands, std::uint32_t firstView,
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
                walk.recordStep(
                    commands, field.blades(), field.list(view),
                    (isUpdate ? field.updateFrame(slot, view) : field.cullView(slot, view)).address,
                    step);
        });
        gpu::computeToCompute(commands);
    }
}

/// Records the edits of each field in the frame, once for all its instances.
void Grass::Parts::recordEdits(const gpu::Recording& commands) const
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

void Grass::recordUpdate(VkCommandBuffer buffer)
{
    Parts& parts = *parts_;
    parts.requireRecording(buffer);
    requireUsage(!std::exchange(parts.isUpdated, true),
                 "Grass::recordUpdate() is called a second time in a frame");
    const gpu::Recording commands(parts.context, buffer);
    const gpu::LabelScope label(parts.context, commands, "grass/update");

    // Wait for the frame before, and clear its lists and counts.
    gpu::memoryBarrier(commands, gpu::anyAccess, gpu::transferAccess);
    for (const auto& [id, field] : parts.placed) {
        if (!field->isInFrame(parts.frame))
            continue;
        field->recordReplaced(commands, parts.slot);
        if (!parts.movesWithCull) {
            commands.vk->CmdFillBuffer(commands, field->moved().get(), 0, VK_WHOLE_SIZE, 0);
            for (std::uint32_t view = 0; view < parts.viewCount; ++view)
                field->list(view).clear(commands);
        }
        field->recordStart(commands, parts.time);
    }
    parts.recordEdits(commands);
    gpu::transferToCompute(commands);
    parts.streaming.record(commands, parts.slot, parts.settledAt(), parts.instances);
    parts.shadowMaps.record(commands);

    // The blades of a single view are moved when they are culled.
    if (parts.movesWithCull)
        return;
    // Each view moves only blades that no earlier view has moved.
    parts.walkAll(commands, 0, parts.viewCount, true);
    for (std::uint32_t view = 0; view < parts.viewCount; ++view) {
        if (view > 0)
            gpu::computeToCompute(commands);
        parts.forEach([&](const PlacedField& field) {
            parts.update.record(commands, field.blades(), field.list(view), parts.movingOf(field),
                                UpdateCullPass::Scope::visible,
                                {.frame = field.updateFrame(parts.slot, view),
                                 .views = field.updateFrame(parts.slot, 0).address,
                                 .viewCount = parts.viewCount,
                                 .before = field.states().before()});
        });
    }
    gpu::computeToTransfer(commands);
    parts.forEach([&](const PlacedField& field) { field.recordMoved(commands, parts.slot); });
    gpu::memoryBarrier(commands, gpu::transferAccess, gpu::hostAccess);
}

void Grass::recordCull(VkCommandBuffer buffer, std::uint32_t view)
{
    Parts& parts = *parts_;
    parts.requireRecording(buffer);
    parts.drawing(view);
    requireUsage(parts.isUpdated, "Grass::recordCull() needs recordUpdate() before it");
    parts.drawings[view].isCulled = true;
    const gpu::Recording commands(parts.context, buffer);
    const gpu::LabelScope label(parts.context, commands, "grass/cull");
    gpu::memoryBarrier(commands, gpu::anyAccess, gpu::fillAccess);
    parts.forEach([&](const PlacedField& field) { field.list(view).clear(commands); });
    const Parts::ViewDrawing& drawing = parts.drawings[view];
    const Parts::ViewDepth& depth = parts.depthOf(view);
    if (drawing.hasTwoPasses)
        parts.forEach([&](PlacedField& field) { field.history(view).begin(commands); });
    if (depth.pyramid != nullptr && !depth.isOwn) {
        // All fields share the view's pyramid: fill it once.
        bool isFilled = false;
        parts.forEach([&](const PlacedField& field) {
            if (!std::exchange(isFilled, true))
                depth.pyramid->record(commands, depth.cells,
                                      field.cullView(parts.slot, view).address);
        });
    }
    if (drawing.obstacle == nullptr)
        parts.raster.recordBegin(commands, parts.slot, view,
                                 depth.pyramid != nullptr ? &depth.cells.picture : nullptr);
    else
        gpu::memoryBarrier(commands, gpu::fillAccess, gpu::dispatchAccess);
    parts.walkAll(commands, view, view + 1, false);
    parts.forEach([&](const PlacedField& field) {
        UpdateCullPass::Input input{.frame = field.cullView(parts.slot, view)};
        if (drawing.hasTwoPasses)
            input.history = {.address = field.history(view).address(),
                             .frame = field.history(view).frame()};
        if (parts.movesWithCull)
            input.before = field.states().before();
        parts.update.record(commands, field.blades(), field.list(view),
                            parts.movesWithCull ? parts.movingOf(field) : Parts::culling,
                            UpdateCullPass::Scope::visible, input);
    });
    gpu::memoryBarrier(commands, gpu::computeAccess, gpu::anyAccess);
    parts.forEach(
        [&](const PlacedField& field) { field.recordCounts(commands, parts.slot, view); });
    // The rasteriser counts on.
    gpu::memoryBarrier(commands, gpu::transferAccess, gpu::hostOrDispatchAccess);
}

void Grass::recordRaster(VkCommandBuffer buffer, std::uint32_t view)
{
    Parts& parts = *parts_;
    parts.requireRecording(buffer);
    requireUsage(parts.drawing(view).isCulled,
                 "Grass::recordRaster() of view {} needs its recordCull() before it", view);
    if (whyTessellated(view) != nullptr)
        return;
    const gpu::Recording commands(parts.context, buffer);
    const gpu::LabelScope label(parts.context, commands, "grass/raster");
    parts.raster.record(commands, parts.slot, view, parts.instances);
    parts.drawings[view].isRastered = true;
    // The late pass has counted hidden blades.
    if (!parts.drawings[view].hasTwoPasses)
        return;
    parts.forEach(
        [&](const PlacedField& field) { field.recordCounts(commands, parts.slot, view); });
    gpu::memoryBarrier(commands, gpu::transferAccess, gpu::hostAccess);
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

void Grass::recordDraw(VkCommandBuffer buffer, std::uint32_t view, const BladeTarget& target) const
{
    const Parts& parts = *parts_;
    parts.requireRecording(buffer);
    const Parts::ViewDrawing& drawing = parts.drawing(view);
    requireUsage(drawing.isCulled,
                 "Grass::recordDraw() of view {} needs its recordCull() before it", view);
    parts.requireTarget(view, target);
    const gpu::Recording commands(parts.context, buffer);
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
    const gpu::GraphicsPipeline& pipeline = isColored && parts.shadowMaps.isLit(parts.slot, view)
                                                ? drawn.hostLight
                                                : drawn.tessellated;
    pipeline.bind(commands);
    if (isColored)
        parts.shadowMaps.of(parts.slot, view)
            .bind(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline.layout());
    parts.forEach([&](const PlacedField& field) {
        if (field.blades().bladeCount() == 0)
            return;
        // A late list is that of a view with two passes, in a target that the view does not suit.
        for (std::uint32_t list = 0; list < (drawing.hasTwoPasses ? 2u : 1u); ++list) {
            pipeline.push(commands,
                          shared::BladePush{.frame = field.drawnFrame(parts.slot, view).address,
                                            .rounds = field.list(view).rounds().address(),
                                            .motion = target.settings().writesMotion
                                                          ? field.motion(parts.slot, view)
                                                          : 0,
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

} // namespace sward::render
