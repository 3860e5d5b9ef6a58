#include "render/grass.h"

#include "core/embedded.h"
#include "core/error.h"
#include "core/expect.h"
#include "gpu/barrier.h"
#include "gpu/debug.h"
#include "gpu/shader_library.h"
#include "render/cull/pyramid_pass.h"
#include "render/cull/update_cull_pass.h"
#include "render/cull/walk_pass.h"
#include "render/field/placed_field.h"
#include "render/host_shadow_maps.h"
#include "render/host_streaming.h"
#include "render/raster/host_raster.h"
#include "shaders/shared/passes.h"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

namespace sward::embedded {
std::span<const EmbeddedFile> shaders();
} // namespace sward::embedded

namespace sward::render {
namespace {

constexpr UpdateCullPass::Variant culling{0, false, UpdateCullPass::Role::cull};

} // namespace

struct Grass::Parts {
    Parts(const gpu::DeviceContext& deviceContext, const Settings& wanted)
        : context(deviceContext)
        , settings(wanted)
        , walk(context, shaders)
        , update(context)
        , shadowMaps(context, wanted.framesInFlight, wanted.maxViews)
        , raster(context, shadowMaps, {wanted.framesInFlight, wanted.maxViews, wanted.keepsMotion})
        , frameOfSlot(wanted.framesInFlight, 0)
        , depths(wanted.framesInFlight * wanted.maxViews)
    {
        update.prepare(shaders, culling);
    }

    /// A removed instance that commands in flight may still use.
    struct Removed {
        std::unique_ptr<PlacedField> field;
        std::uint32_t lastFrame = 0;
    };

    const gpu::DeviceContext& context;
    Settings settings;
    gpu::ShaderLibrary shaders{embedded::shaders()};
    WalkPass walk;
    UpdateCullPass update;
    HostShadowMaps shadowMaps;
    HostRaster raster;
    HostStreaming streaming;
    std::shared_ptr<const void> owner = std::make_shared<char>(); ///< see ResidentField::Parts
    std::map<std::uint64_t, std::unique_ptr<PlacedField>> placed;
    std::vector<Removed> removed;
    std::uint64_t lastId = 0;

    // The frame being recorded.
    std::vector<std::uint32_t> frameOfSlot; ///< number of the frame last begun per slot
    std::uint32_t frame = 0;                ///< its number, starting at 1
    std::uint32_t slot = 0;
    std::uint32_t viewCount = 0;
    double time = 0.0;
    UpdateCullPass::Variant moving;
    std::vector<const PlacedField*> instances; ///< with blades; null: removed since begin()

    /// How a view is drawn.
    struct ViewDrawing {
        const char* obstacle = nullptr;      ///< why it is not rasterised; null: none
        const char* storeObstacle = nullptr; ///< why it is not stored; null: none
        std::uint32_t samples = 1;
        bool isRastered = false; ///< in this frame, and stored if there is no obstacle
    };
    std::vector<ViewDrawing> drawings;

    /// Depth pyramid of a view in a slot.
    struct ViewDepth {
        DepthCells cells;
        const PyramidPass* pyramid = nullptr; ///< null: no occlusion test
    };
    std::vector<ViewDepth> depths;                                          ///< [slot][view]
    std::map<std::tuple<std::uint32_t, bool, float>, PyramidPass> pyramids; ///< by their settings

    ViewDepth& depthOf(std::uint32_t view) { return depths[slot * settings.maxViews + view]; }
    shared::DepthPyramid lookAtDepth(const HostView& view, ViewDepth& depth);

    void take(const ResidentField::Parts& field) const;

    /// Calls `use` for each instance that is in the frame.
    template <typename Use>
    void forEach(const Use& use) const
    {
        for (const auto& [id, field] : placed)
            if (field->isInFrame(frame))
                use(*field);
    }

    void walkAll(const gpu::Recording& commands, std::uint32_t firstView, std::uint32_t endView,
                 bool isUpdate) const;
};

Grass::Grass(const gpu::DeviceContext& context, const Settings& settings)
    : parts_(std::make_unique<Parts>(context, settings))
{
    expect(settings.framesInFlight >= 1, "at least one frame is in flight");
    expect(settings.maxViews >= 1, "a frame has at least one view");
}

Grass::~Grass() = default;

InstanceId Grass::add(const FieldInstance& instance)
{
    Parts& parts = *parts_;
    expect(instance.field != nullptr, "an instance is one of a field");
    expect(instance.placement.scale > 0.0, "an instance has a size");
    parts.take(instance.field->parts());
    const std::uint64_t id = ++parts.lastId;
    parts.placed.emplace(id,
                         std::make_unique<PlacedField>(parts.context, instance, parts.settings));
    return InstanceId{id};
}

void Grass::move(InstanceId id, const Placement& placement)
{
    const auto found = parts_->placed.find(static_cast<std::uint64_t>(id));
    expect(found != parts_->placed.end(), "there is such an instance");
    expect(placement.scale > 0.0, "an instance has a size");
    found->second->place(placement);
}

void Grass::remove(InstanceId id)
{
    const auto found = parts_->placed.find(static_cast<std::uint64_t>(id));
    expect(found != parts_->placed.end(), "there is such an instance");
    std::ranges::replace(parts_->instances, static_cast<const PlacedField*>(found->second.get()),
                         static_cast<const PlacedField*>(nullptr));
    parts_->removed.push_back({std::move(found->second), parts_->frame});
    parts_->placed.erase(found);
}

void Grass::begin(std::uint32_t slot, const GrassFrame& frame)
{
    Parts& parts = *parts_;
    expect(slot < parts.settings.framesInFlight, "the slot is one of the frames in flight");
    expect(frame.views.size() <= parts.settings.maxViews, "a frame has at most maxViews");
    requireValid(frame.light);
    for (const HostView& view : frame.views) {
        if (view.shadow)
            requireValid(*view.shadow);
        if (view.stored)
            requireValid(*view.stored, view.size);
    }

    // The slot's former frame and all earlier ones have completed.
    std::erase_if(parts.removed, [&](const Parts::Removed& removed) {
        return removed.lastFrame <= parts.frameOfSlot[slot];
    });
    parts.frameOfSlot[slot] = ++parts.frame;
    parts.slot = slot;
    parts.viewCount = static_cast<std::uint32_t>(frame.views.size());
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
             .samples = view.samples});
    parts.shadowMaps.begin(slot, frame.light, frame.views);
    parts.raster.begin(parts.shaders, slot, frame.views, parts.instances, frame.settings);
}

/// A streamed field holds what the views of one Grass see, in slots of its own.
void Grass::Parts::take(const ResidentField::Parts& field) const
{
    if (field.streaming == nullptr)
        return;
    if (field.budget.framesInFlight < settings.framesInFlight)
        fail(ErrorKind::usage, "the field is streamed for {} frames in flight; the grass has {}",
             field.budget.framesInFlight, settings.framesInFlight);
    const std::shared_ptr<const void> other = field.grass.lock();
    if (other && other != owner)
        fail(ErrorKind::usage, "the field is streamed, and other grass draws it");
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

void Grass::recordUpdate(VkCommandBuffer buffer) noexcept
{
    Parts& parts = *parts_;
    const gpu::Recording commands(parts.context, buffer);
    const gpu::LabelScope label(parts.context, commands, "grass/update");

    // Wait for the frame before, and clear its lists and counts.
    gpu::memoryBarrier(commands, gpu::anyAccess, gpu::transferAccess);
    for (const auto& [id, field] : parts.placed) {
        if (!field->isInFrame(parts.frame))
            continue;
        commands.vk->CmdFillBuffer(commands, field->moved().get(), 0, VK_WHOLE_SIZE, 0);
        for (std::uint32_t view = 0; view < parts.viewCount; ++view)
            field->list(view).clear(commands);
        // Treats every blade as settled: none is still moving from the straight pose of the bake.
        if (field->beginsToMove())
            field->states().rest(commands,
                                 static_cast<float>(parts.time - double(shared::settlingTime)));
    }
    gpu::transferToCompute(commands);
    parts.streaming.record(commands, parts.slot, static_cast<float>(parts.time), parts.instances);
    parts.shadowMaps.record(commands);

    // Each view moves only blades that no earlier view has moved.
    parts.walkAll(commands, 0, parts.viewCount, true);
    for (std::uint32_t view = 0; view < parts.viewCount; ++view) {
        if (view > 0)
            gpu::computeToCompute(commands);
        parts.forEach([&](const PlacedField& field) {
            parts.update.record(commands, field.blades(), field.list(view), parts.moving,
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

void Grass::recordCull(VkCommandBuffer buffer, std::uint32_t view) noexcept
{
    const Parts& parts = *parts_;
    expect(view < parts.viewCount, "the view is one of the frame's");
    const gpu::Recording commands(parts.context, buffer);
    const gpu::LabelScope label(parts.context, commands, "grass/cull");
    gpu::memoryBarrier(commands, gpu::anyAccess, gpu::fillAccess);
    parts.forEach([&](const PlacedField& field) { field.list(view).clear(commands); });
    const Parts::ViewDepth& depth = parts_->depthOf(view);
    if (depth.pyramid != nullptr) {
        // All fields share the view's pyramid: fill it once.
        bool isFilled = false;
        parts.forEach([&](const PlacedField& field) {
            if (!std::exchange(isFilled, true))
                depth.pyramid->record(commands, depth.cells,
                                      field.cullView(parts.slot, view).address);
        });
    }
    gpu::memoryBarrier(commands, gpu::fillAccess, gpu::dispatchAccess);
    parts.walkAll(commands, view, view + 1, false);
    parts.forEach([&](const PlacedField& field) {
        parts.update.record(commands, field.blades(), field.list(view), culling,
                            UpdateCullPass::Scope::visible,
                            {.frame = field.cullView(parts.slot, view)});
    });
    gpu::memoryBarrier(commands, gpu::computeAccess, gpu::anyAccess);
    parts.forEach(
        [&](const PlacedField& field) { field.recordCounts(commands, parts.slot, view); });
    gpu::memoryBarrier(commands, gpu::transferAccess, gpu::hostAccess);
}

void Grass::recordRaster(VkCommandBuffer buffer, std::uint32_t view) noexcept
{
    Parts& parts = *parts_;
    if (whyTessellated(view) != nullptr)
        return;
    const gpu::Recording commands(parts.context, buffer);
    const gpu::LabelScope label(parts.context, commands, "grass/raster");
    const Parts::ViewDepth& depth = parts.depthOf(view);
    parts.raster.record(commands, parts.slot, view, parts.instances,
                        depth.pyramid != nullptr ? &depth.cells.picture : nullptr);
    parts.drawings[view].isRastered = true;
}

const char* Grass::whyTessellated(std::uint32_t view) const noexcept
{
    expect(view < parts_->viewCount, "the view is one of the frame's");
    return parts_->drawings[view].obstacle;
}

const char* Grass::whyNotStored(std::uint32_t view) const noexcept
{
    expect(view < parts_->viewCount, "the view is one of the frame's");
    return parts_->drawings[view].storeObstacle;
}

void Grass::recordDraw(VkCommandBuffer buffer, std::uint32_t view,
                       const BladeTarget& target) const noexcept
{
    const Parts& parts = *parts_;
    expect(view < parts.viewCount, "the view is one of the frame's");
    const gpu::Recording commands(parts.context, buffer);
    const gpu::LabelScope label(parts.context, commands, "grass/draw");
    expect(!target.settings().writesMotion || parts.settings.keepsMotion,
           "a target with motion needs Grass::Settings::keepsMotion");
    const gpu::GraphicsPipeline* const visibility = target.visibilityPipeline();
    const Parts::ViewDrawing& drawing = parts.drawings[view];
    // What is stored is not drawn a second time; only its depth may be.
    if (drawing.isRastered && drawing.storeObstacle == nullptr &&
        !target.settings().colorFormats.empty())
        return;
    if (drawing.isRastered && visibility != nullptr &&
        target.settings().samples == drawing.samples) {
        parts.raster.recordDraw(commands, parts.slot, view, *visibility);
        return;
    }
    const gpu::ImageSet* const shadowMap =
        target.settings().colorFormats.empty() ? nullptr : parts.shadowMaps.of(parts.slot, view);
    const gpu::GraphicsPipeline& pipeline =
        shadowMap != nullptr ? target.hostLightPipeline() : target.pipeline();
    pipeline.bind(commands);
    if (shadowMap != nullptr)
        shadowMap->bind(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline.layout());
    parts.forEach([&](const PlacedField& field) {
        if (field.blades().bladeCount() == 0)
            return;
        const VkDeviceAddress drawn = field.drawnFrame(parts.slot, view).address;
        if (target.settings().writesMotion)
            pipeline.push(commands, shared::MotionPush{drawn, field.motion(parts.slot, view)});
        else
            pipeline.push(commands, shared::ViewPush{drawn});
        commands.vk->CmdDrawIndirect(commands, field.list(view).draw().get(), 0, 1,
                                     sizeof(shared::DrawArguments));
    });
}

void Grass::recordDepth(VkCommandBuffer commands, std::uint32_t view,
                        const BladeTarget& target) const noexcept
{
    expect(target.settings().colorFormats.empty(), "a shadow's map has no colours");
    recordDraw(commands, view, target);
}

FrameStats Grass::stats(std::uint32_t view, std::uint32_t slot) const
{
    expect(slot < parts_->settings.framesInFlight, "the slot is one of the frames in flight");
    expect(view < parts_->settings.maxViews, "the view is one of a frame's");
    FrameStats sum;
    for (const auto& [id, field] : parts_->placed)
        field->addCounts(slot, view, sum);
    return sum;
}

StreamingStats Grass::streamingStats() const
{
    return parts_->streaming.stats(parts_->instances);
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
