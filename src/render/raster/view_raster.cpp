#include "render/raster/view_raster.h"

#include "gpu/recording/barrier.h"
#include "render/access.h"
#include "render/cull/pass_scope.h"
#include "render/host/host_shadow_maps.h"
#include "render/raster/raster_rounds.h"
#include "render/resident/placed_field.h"
#include "render/resident/resident_parts.h"

#include <algorithm>
#include <map>
#include <utility>

namespace sward::render {
namespace {

using Kind = InstanceConstants::Kind;

/// The visibility is 0 where there is no blade.
constexpr std::uint32_t firstId = 1;

/// Makes `buffer` hold exactly `bytes`. Frames in flight keep the buffer they began with.
void fit(const gpu::DeviceContext& context, std::shared_ptr<gpu::Buffer>& buffer, const char* name,
         VkDeviceSize bytes)
{
    if (!buffer || buffer->bytes() != bytes)
        buffer = std::make_shared<gpu::Buffer>(
            context, gpu::BufferSettings{.name = name,
                                         .bytes = bytes,
                                         .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT |
                                                  VK_BUFFER_USAGE_TRANSFER_DST_BIT});
}

/// Tiles of shared::HostViewPush::tiles.
std::uint32_t tileCount(glm::uvec2 size)
{
    return shared::tilesAlong(size.x, shared::hostTile) *
           shared::tilesAlong(size.y, shared::hostTile);
}

RasterPass::Variant variantOf(const HostView& view, const DeviceField& field, bool groupsDrawLarge)
{
    return {.samples = view.samples,
            .isPaged = field.blades.isPaged(),
            .groupsDrawLarge = groupsDrawLarge,
            .looks = field.looks};
}

} // namespace

ViewRaster::ViewRaster(const gpu::DeviceContext& context, const HostShadowMaps& shadowMaps,
                       const Settings& settings)
    : context_(&context)
    , shadowMaps_(&shadowMaps)
    , settings_(settings)
    , passes_(context, shadowMaps, settings.slots, settings.maxViews)
    , pictures_(settings.maxViews)
    , slots_(settings.slots)
{
    for (Slot& slot : slots_)
        slot.views.resize(settings.maxViews);
}

const char* ViewRaster::obstacle(const HostView& view,
                                 std::span<const PlacedField* const> instances) const
{
    std::uint64_t ids = firstId;
    for (const PlacedField* instance : instances)
        ids += instance->blades().indexCount();
    if (ids > 0xffffffffu)
        return "all instances together have 2^32 blades or more";
    if (view.geometry == Geometry::tessellation)
        return "the view asks for the tessellator";
    if (view.geometry == Geometry::automatic && context_->isCpu())
        return "a CPU tessellates faster";
    if (!context_->features.bufferInt64Atomics)
        return "the device has no 64-bit atomics on buffers (shaderBufferInt64Atomics)";
    if (view.samples != 1 && view.samples != 4)
        return "the view has neither 1 nor 4 samples a pixel";
    if (view.samples > 1 && !context_->features.sampleRateShading)
        return "the device shades no single samples (sampleRateShading)";
    if (isParallel(view.worldToClip))
        return "the rays of the view are parallel";
    return nullptr;
}

const char* ViewRaster::storeObstacle(const HostView& view, Instances instances,
                                      const FrameSettings& settings) const
{
    if (const char* const found = obstacle(view, instances))
        return found;
    if (!view.stored)
        return "the view has no picture that is stored into";
    if (view.depth && view.depth->samples != view.samples)
        return "the depth has another number of samples than the view";
    if (view.depth && view.cullViewFrom)
        return "the depth does not apply to a frozen camera";
    if (view.depth && (settings.cullMask & shared::cullOcclusion) == 0)
        return "the frame leaves out the test that reads the depth";
    return nullptr;
}

bool ViewRaster::hasOwnPyramid(const HostView& view, const FrameSettings& settings)
{
    return (settings.cullMask & shared::cullOcclusion) != 0 && !view.cullViewFrom &&
           (!view.depth || view.depth->samples == view.samples);
}

bool ViewRaster::hasTwoPasses(const HostView& view, Instances instances,
                              const FrameSettings& settings) const
{
    return settings_.groupsDrawLarge && instances.size() == 1 &&
           instances.front()->listsHoldAll() && hasOwnPyramid(view, settings);
}

void ViewRaster::preparePipelines(const gpu::ShaderLibrary& shaders, const GrassFrame& frame,
                                  const PreparedFields& fields) const
{
    ViewPasses passes(*context_, *shadowMaps_, 1, 1);
    for (const HostView& view : frame.views) {
        if (obstacle(view, {}) != nullptr)
            continue;
        std::vector<RasterPass::Variant> variants;
        for (const ResidentField* field : fields.fields)
            variants.push_back(
                variantOf(view, Access::of(*field).field, settings_.groupsDrawLarge));
        ViewPasses::Kind kind{.settings = frame.settings,
                              .isLit = isLitByHost(frame.light, view),
                              .stores = storeObstacle(view, {}, frame.settings) == nullptr};
        if (fields.several) {
            std::vector<RasterPass::Variant> several = variants;
            several.push_back(several.front());
            kind.instances = several;
            passes.prepare(shaders, view, kind);
        }
        if (!fields.one)
            continue;
        const bool mayHaveTwo = settings_.groupsDrawLarge && hasOwnPyramid(view, frame.settings);
        for (const RasterPass::Variant& variant : variants) {
            kind.instances = {&variant, 1};
            kind.hasTwoPasses = mayHaveTwo;
            passes.prepare(shaders, view, kind);
            // Lists without room for all blades have a single pass.
            kind.hasTwoPasses = false;
            if (mayHaveTwo && settings_.limitsLists)
                passes.prepare(shaders, view, kind);
        }
    }
}

void ViewRaster::prepare(const HostView& view, const ViewDrawing& drawing, std::uint32_t index,
                         View& out)
{
    out.isRastered = true;
    out.drawing = drawing;
    if (drawing.hasTwoPasses && !shadingCache_)
        shadingCache_.emplace(*context_);
    if (!largeList_)
        largeList_ = std::make_shared<LargeBladeList>(*context_, settings_.groupsDrawLarge);
    out.large = largeList_;

    Pictures& pictures = pictures_[index];
    const VkDeviceSize bytes = visibilityBytes(view.size, view.samples);
    const gpu::Buffer* const former = pictures.visibility.get();
    fit(*context_, pictures.visibility, "view/visibility", bytes);
    pictures.isEmpty = pictures.isEmpty && pictures.visibility.get() == former;
    if (drawing.layer == nullptr)
        fit(*context_, pictures.tiles, "view/tiles",
            VkDeviceSize(tileCount(view.size)) * sizeof(std::uint32_t));
    if (settings_.keepsMotion && drawing.layer == nullptr)
        fit(*context_, pictures.motions, "view/motions", bytes / 2);
    out.pictures = pictures;
    out.push = {.instances = 0,
                .visibility = pictures.visibility->address(),
                .motions = pictures.motions ? pictures.motions->address() : 0,
                .tiles = pictures.tiles ? pictures.tiles->address() : 0,
                .size = view.size,
                .instanceCount = 0,
                .slack = view.depth ? view.depth->slack : 0.0f,
                .firstStored = view.stored ? view.stored->first : glm::uvec2(0),
                .layers = 0};
}

/// Makes what rasterises and lights a view of at least one instance.
void ViewRaster::prepareShading(const gpu::ShaderLibrary& shaders, std::uint32_t slotIndex,
                                std::uint32_t index, const HostView& view,
                                const ViewDrawing& drawing, Instances instances,
                                const FrameSettings& settings)
{
    View& out = slots_[slotIndex].views[index];
    std::vector<RasterPass::Variant> variants;
    for (const PlacedField* instance : instances)
        variants.push_back(variantOf(view, instance->field(), settings_.groupsDrawLarge));
    const bool stores = drawing.storeObstacle == nullptr;
    out.pipelines = passes_.prepare(shaders, view,
                                    {.instances = variants,
                                     .settings = settings,
                                     .hasTwoPasses = drawing.hasTwoPasses,
                                     .hasLayer = drawing.layer != nullptr,
                                     .isLit = shadowMaps_->isLit(slotIndex, index),
                                     .stores = stores});
    if (drawing.layer == nullptr)
        out.lighting =
            passes_.lighting().prepare(slotIndex, index, view, stores, *out.pipelines.lighting);
}

void ViewRaster::begin(const gpu::ShaderLibrary& shaders, std::uint32_t slotIndex,
                       std::span<const HostView> views, std::span<const ViewDrawing> drawings,
                       Instances instances, const FrameSettings& settings)
{
    Slot& slot = slots_[slotIndex];
    std::ranges::fill(slot.views, View{});
    bool rasters = false;
    bool keeps = false;
    for (std::uint32_t i = 0; i < slot.views.size(); ++i) {
        if (i < views.size() && drawings[i].obstacle == nullptr) {
            prepare(views[i], drawings[i], i, slot.views[i]);
            if (!instances.empty())
                prepareShading(shaders, slotIndex, i, views[i], drawings[i], instances, settings);
            rasters = true;
        } else if (i < views.size() && drawings[i].onlyMoves) {
            keeps = true;
        } else {
            pictures_[i] = {};
        }
    }
    if (!rasters && !keeps)
        largeList_.reset();
    if (!rasters || instances.empty()) {
        slot.table = {};
        return;
    }
    writeTable(slot, slotIndex, views, instances);
}

RasterPass::View ViewRaster::viewOf(const View& view)
{
    RasterPass::View result{.instances = view.instances,
                            .large = view.large.get(),
                            .several = view.instances.size() > 1 ? &view.push : nullptr,
                            .size = view.push.size};
    if (!view.instances.empty())
        result.variant = view.instances.front().variant;
    return result;
}

void ViewRaster::writeTable(Slot& slot, std::uint32_t slotIndex, std::span<const HostView> views,
                            std::span<const PlacedField* const> instances) const
{
    const VkDeviceSize bytes = views.size() * instances.size() * sizeof(shared::HostInstance);
    if (slot.table.bytes() < bytes)
        slot.table = gpu::Buffer(*context_, {.name = "views/instances",
                                             .bytes = bytes,
                                             .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                                             .memory = gpu::MemoryUse::constants});
    const auto table = slot.table.mappedAs<shared::HostInstance>();
    for (std::uint32_t v = 0; v < views.size(); ++v) {
        View& view = slot.views[v];
        if (!view.isRastered)
            continue;
        const std::size_t first = v * instances.size();
        view.push.instances = slot.table.address() + first * sizeof(shared::HostInstance);
        view.push.instanceCount = static_cast<std::uint32_t>(instances.size());
        std::uint32_t id = view.drawing.layer != nullptr ? view.drawing.layer->firstBlade : firstId;
        for (std::uint32_t i = 0; i < instances.size(); ++i) {
            const PlacedField& field = *instances[i];
            const VkDeviceAddress frame = field.place(slotIndex, Kind::raster, v).address;
            shared::HostInstance entry = {};
            entry.raster.frame = frame;
            entry.raster.cullView = frame;
            if (view.drawing.drawsAll)
                entry.raster.cullView = field.place(slotIndex, Kind::listing, v).address;
            else if (views[v].cullViewFrom)
                entry.raster.cullView = field.place(slotIndex, Kind::culling, v).address;
            entry.raster.visibility = view.push.visibility;
            entry.raster.rounds = field.list(v).rounds().address();
            view.large->describe(entry.raster);
            if (view.drawing.hasTwoPasses)
                entry.raster.history = field.history(v).address();
            if (view.pipelines.cache != nullptr)
                shadingCache_->describe(entry.raster);
            entry.raster.nonEmptyPatches = field.blades().nonEmptyPatches();
            entry.raster.firstNonEmptyPatches = field.blades().firstNonEmptyPatches();
            entry.raster.size = views[v].size;
            entry.raster.isBgr =
                view.drawing.layer != nullptr && view.drawing.layer->isBgr ? 1u : 0u;
            entry.raster.firstBlade = id;
            entry.raster.instance = i;
            entry.motion = field.motion(slotIndex, v);
            table[first + i] = entry;
            view.instances.push_back(
                {.frame = field.place(slotIndex, Kind::raster, v),
                 .list = &field.list(v),
                 .variant = variantOf(views[v], field.field(), settings_.groupsDrawLarge),
                 .push = entry.raster});
            id += field.blades().indexCount();
        }
    }
}

void ViewRaster::recordBegin(const gpu::Recording& commands, std::uint32_t slotIndex,
                             std::uint32_t viewIndex, const gpu::ImageSet* depth)
{
    const View& view = slots_[slotIndex].views[viewIndex];
    view.large->clear(commands);
    clearedFor_ = viewIndex;
    commands.vk->CmdFillBuffer(commands, view.pictures.tiles->get(), 0, VK_WHOLE_SIZE, 0);
    const gpu::ComputePipeline* const seed = view.pipelines.seed;
    const bool isSeeded = seed != nullptr && depth != nullptr;
    if (!isSeeded)
        commands.vk->CmdFillBuffer(commands, view.pictures.visibility->get(), 0, VK_WHOLE_SIZE, 0);
    gpu::memoryBarrier(commands, gpu::fillAccess, gpu::dispatchAccess);
    if (!isSeeded)
        return;
    seed->bind(commands);
    depth->bind(commands, VK_PIPELINE_BIND_POINT_COMPUTE, seed->layout());
    seed->push(commands, view.push);
    const auto groups = [](std::uint32_t pixels) {
        return static_cast<std::uint32_t>(
            gpu::groupsFor(shared::pyramidCells(pixels, 0), shared::pyramidThreads));
    };
    commands.vk->CmdDispatch(commands, groups(view.push.size.x), groups(view.push.size.y), 1);
    gpu::computeToCompute(commands);
}

void ViewRaster::recordLayer(const gpu::Recording& commands, std::uint32_t slotIndex,
                             std::uint32_t viewIndex, bool fillsPyramid,
                             gpu::Timestamps* timestamps)
{
    View& view = slots_[slotIndex].views[viewIndex];
    {
        const DispatchScope scope(*context_, commands, timestamps, "ground");
        if (!std::exchange(pictures_[viewIndex].isEmpty, true))
            commands.vk->CmdFillBuffer(commands, view.pictures.visibility->get(), 0, VK_WHOLE_SIZE,
                                       0);
        view.large->clear(commands);
        clearedFor_ = viewIndex;
        view.drawing.layer->clear(commands);
        gpu::memoryBarrier(commands, gpu::fillAccess, gpu::dispatchAccess);
        view.drawing.layer->draw(commands, view.pictures.visibility->address());
        gpu::computeToCompute(commands);
    }
    if (!fillsPyramid || view.instances.empty())
        return;
    {
        const DispatchScope scope(*context_, commands, timestamps, "pyramid");
        passes_.raster().recordDepths(commands, viewOf(view), RasterPass::Levels::all);
    }
    gpu::computeToCompute(commands);
}

void ViewRaster::record(const gpu::Recording& commands, std::uint32_t slotIndex,
                        std::uint32_t viewIndex, Instances instances, const Rounds& rounds,
                        gpu::Timestamps* timestamps)
{
    View& view = slots_[slotIndex].views[viewIndex];
    if (std::exchange(clearedFor_, std::nullopt) != viewIndex) {
        // Another view was culled or rasterised since.
        gpu::memoryBarrier(commands, gpu::anyAccess, gpu::fillAccess);
        view.large->clear(commands);
        gpu::memoryBarrier(commands, gpu::fillAccess, gpu::dispatchAccess);
    }
    if (view.instances.empty())
        return;
    // Instances may have been removed after begin().
    for (std::size_t i = 0; i < view.instances.size(); ++i)
        if (instances[i] == nullptr)
            view.instances[i].list = nullptr;
    const RasterPass::View rastered = viewOf(view);
    const RasterPass::Instance& first = view.instances.front();
    const bool isOfOne = view.instances.size() == 1;
    if (!isOfOne || first.list != nullptr) {
        RasterRounds{.context = *context_,
                     .pass = passes_.raster(),
                     .view = rastered,
                     .hasTwoPasses = view.drawing.hasTwoPasses,
                     .shadingCache = view.pipelines.cache,
                     .rounds = rounds.count,
                     .list = rounds.list}
            .record(commands, timestamps);
        if (view.drawing.layer == nullptr) {
            gpu::computeToCompute(commands);
            if (rounds.beforeLight) {
                rounds.beforeLight(view.push);
                gpu::computeToCompute(commands);
            }
            HostLighting::record(commands, view.lighting, isOfOne ? &first.frame : nullptr,
                                 view.push);
        }
    }
    gpu::memoryBarrier(commands, gpu::computeAccess, gpu::anyAccess);
}

const shared::RasterPush& ViewRaster::pushOf(std::uint32_t slot, std::uint32_t view) const
{
    return slots_[slot].views[view].instances.front().push;
}

void ViewRaster::recordDraw(const gpu::Recording& commands, std::uint32_t slot, std::uint32_t view,
                            const gpu::GraphicsPipeline& pipeline) const
{
    const shared::HostViewPush& push = slots_[slot].views[view].push;
    if (push.instanceCount == 0)
        return;
    pipeline.bind(commands);
    pipeline.push(commands, push);
    commands.vk->CmdDraw(commands, 6 * tileCount(push.size), 1, 0, 0);
}

VkDeviceSize ViewRaster::bytes() const
{
    // Count each buffer once: slots and views share them.
    std::map<const void*, VkDeviceSize> held;
    for (const Slot& slot : slots_) {
        held[&slot] = slot.table.bytes();
        for (const View& view : slot.views) {
            if (view.pictures.visibility)
                held[view.pictures.visibility.get()] = view.pictures.visibility->bytes();
            if (view.pictures.tiles)
                held[view.pictures.tiles.get()] = view.pictures.tiles->bytes();
            if (view.pictures.motions)
                held[view.pictures.motions.get()] = view.pictures.motions->bytes();
            if (view.large)
                held[view.large.get()] = view.large->bytes();
        }
    }
    VkDeviceSize sum = shadingCache_ ? shadingCache_->bytes() : 0;
    for (const auto& [holder, bytes] : held)
        sum += bytes;
    return sum;
}

} // namespace sward::render
