#include "render/resident/placed_field.h"

#include "core/expect.h"
#include "gpu/pipeline/compute_pipeline.h"
#include "render/field/frame_tables.h"
#include "render/frame/frame_time.h"
#include "render/host/host_shadow_maps.h"
#include "render/host/lit_field.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <utility>

namespace sward::render {
namespace {

// Indices of a view's frames.
constexpr std::uint32_t forUpdate = 0;
constexpr std::uint32_t forCulling = 1;
constexpr std::uint32_t forDrawing = 2;
constexpr std::uint32_t forRaster = 3;
constexpr std::uint32_t frameKinds = 4;

/// Offset of the frames in a slot's constants: after the tables.
VkDeviceSize framesOffset()
{
    return gpu::groupsFor(tableBytes(), gpu::uniformAlignment) * gpu::uniformAlignment;
}

gpu::Buffer countsBuffer(const gpu::DeviceContext& context, const char* name, std::uint32_t count,
                         gpu::MemoryUse memory)
{
    return {context,
            {.name = name,
             .bytes = count * sizeof(shared::DrawArguments),
             .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT |
                      VK_BUFFER_USAGE_TRANSFER_DST_BIT,
             .memory = memory}};
}

/// The collider in the field's space, for shaders.
shared::Collider placed(const HostCollider& collider, const Placement& placement, glm::dvec3 origin)
{
    shared::Collider result = {};
    result.from = glm::vec3(placement.placeInField(collider.from) - origin);
    result.to = glm::vec3(placement.placeInField(collider.to) - origin);
    result.radius = static_cast<float>(collider.radius / placement.scale);
    result.velocity =
        placement.directionInField(collider.velocity) / static_cast<float>(placement.scale);
    return result;
}

} // namespace

PlacedField::PlacedField(const gpu::DeviceContext& context, const FieldInstance& instance,
                         const Grass::Settings& settings)
    : context_(&context)
    , instance_(instance)
    , settings_(settings)
    , states_(
          context, Access::of(*instance.field).blades,
          {.before = settings.keepsMotion, .etas = Access::of(*instance.field).blades.isPaged()})
    , moved_(countsBuffer(context, "instance/moved", 1, gpu::MemoryUse::device))
    , replaced_(settings.framesInFlight)
{
    const gpu::UniformSetLayout layout(context, "instance/frame");
    const VkDeviceSize bytes =
        framesOffset() + settings.maxViews * (frameKinds * sizeof(shared::Frame) +
                                              sizeof(shared::Motion) + sizeof(shared::HostLight));
    for (std::uint32_t i = 0; i < settings.framesInFlight; ++i) {
        Slot& slot = slots_.emplace_back();
        slot.constants = gpu::Buffer(context, {.name = "instance/constants",
                                               .bytes = bytes,
                                               .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT |
                                                        VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT,
                                               .memory = gpu::MemoryUse::constants});
        slot.frames = gpu::UniformSets(context, layout,
                                       {.name = "instance/frame",
                                        .buffer = slot.constants.get(),
                                        .offset = framesOffset(),
                                        .bytes = sizeof(shared::Frame),
                                        .count = frameKinds * settings.maxViews});
        slot.counts = countsBuffer(context, "instance/counts", 1 + settings.maxViews,
                                   gpu::MemoryUse::readback);
        std::ranges::fill(slots_.back().counts.mapped(), std::byte{0});
        slot.blades = blades().bladeCount();
    }
}

void PlacedField::write(std::uint32_t slot, const GrassFrame& frame, std::uint32_t number,
                        std::span<const ViewPyramids> pyramids)
{
    const ResidentField::Parts& field = Access::of(*instance_.field);
    const Placement& placement = instance_.placement;
    followEdits();
    while (lists_.size() < frame.views.size())
        lists_.emplace_back(*context_, field.blades, std::numeric_limits<std::uint32_t>::max(),
                            settings_.maxListed);
    histories_.resize(lists_.size());
    if (!frame.colliders.empty() && !states_.hasEtas()) {
        states_.keepEtas(*context_);
        hasNewEtas_ = true;
    }
    std::ranges::fill(slots_[slot].counts.mapped(), std::byte{0});
    slots_[slot].blades = field.blades.bladeCount();

    // Shared by all views.
    FrameSettings settings = inField(placement, frame.settings);
    settings.fogDensity = std::max(settings.fogDensity, 0.0f);
    std::vector<shared::Collider> colliders;
    for (const HostCollider& collider : frame.colliders)
        colliders.push_back(placed(collider, placement, field.shape.origin));
    const gpu::Buffer& constants = slots_[slot].constants;
    shared::Frame tabled = {};
    writeTables({constants.mapped().data(), constants.address()}, field.shape, settings, colliders,
                frame.time, tabled);

    seen_.clear();
    for (std::uint32_t i = 0; i < frame.views.size(); ++i) {
        const HostView& view = frame.views[i];
        const glm::dmat4 toWorld = placement.toWorld(field.shape.origin);
        const glm::dmat4 toClip = view.worldToClip * toWorld;
        const auto seenBy = [&](const glm::dmat4& matrix) {
            return viewMatricesOf(matrix, view.hasReversedZ, view.size, field.shape.content);
        };
        shared::Frame drawn =
            frameOf(field.shape, seenBy(toClip), settings, frame.time, view.samples);
        if (isParallel(toClip))
            drawn.view.cullMask &= ~shared::cullDistance;
        drawn.updateRate.frame = number;
        drawn.environment.wind = tabled.environment.wind;
        drawn.environment.colliderCount = tabled.environment.colliderCount;
        drawn.environment.colliders = tabled.environment.colliders;
        field.blades.describe(drawn);
        states_.describe(drawn);
        lists_[i].describe(drawn);
        field.cover.describe(drawn, settings.thatch);
        environment_ = drawn.environment;
        if (isLitByHost(frame.light, view)) {
            const shared::HostLight light =
                hostLightOf(frame.light, view.shadow,
                            {placement, field.shape.origin, field.shape.content, drawn.skyUp});
            std::memcpy(constants.mapped().data() + lightOffset(i), &light, sizeof light);
            drawn.hostLight = constants.address() + lightOffset(i);
        }

        shared::Frame cullView = drawn;
        if (view.cullViewFrom)
            look(cullView, seenBy(*view.cullViewFrom * toWorld));
        seen_.push_back(cullView.view);
        cullView.pyramid = pyramids[i].culling;
        shared::Frame updated = cullView;
        updated.draw = moved_.address();
        updated.pyramid = {};
        updated.view.cullMask &= ~shared::cullOcclusion;
        drawn.pyramid = pyramids[i].raster;
        put(slot, forRaster, i, drawn);
        project(drawn, glm::mat4(toClip), drawn.view.eye);
        put(slot, forUpdate, i, updated);
        put(slot, forCulling, i, cullView);
        put(slot, forDrawing, i, drawn);
        const shared::Motion since = motionOf(frame, view);
        std::memcpy(constants.mapped().data() + motionOffset(i), &since, sizeof since);
    }
    written_ = number;
    placementBefore_ = placement;
    timeBefore_ = frame.time;
}

void PlacedField::expectHistory(std::uint32_t view)
{
    if (histories_[view].address() == 0 && blades().indexCount() > 0)
        histories_[view] = VisibilityHistory(*context_, blades().indexCount());
}

/// Makes room for what edits have added to its field.
void PlacedField::followEdits()
{
    if (edits() == nullptr)
        return;
    states_.update(*context_, blades(), replaced_.waiting());
    for (VisibleBlades& list : lists_)
        list.update(*context_, blades(), replaced_.waiting());
    for (VisibilityHistory& history : histories_)
        if (!history.hasRoomFor(blades().indexCount()))
            replaced_.waiting().push_back(
                {history.grow(*context_, blades().indexCount()), VK_NULL_HANDLE});
}

void PlacedField::recordReplaced(const gpu::Recording& commands, std::uint32_t slot)
{
    replaced_.record(commands, slot);
}

void PlacedField::thin(std::uint32_t slot, std::span<const shared::Eyepoint> raised) const
{
    for (std::uint32_t view = 0; view < raised.size(); ++view)
        for (std::uint32_t kind = 0; kind < frameKinds; ++kind) {
            std::byte* const frame =
                slots_[slot].constants.mapped().data() + frameOffset(kind, view);
            reinterpret_cast<shared::Frame*>(frame)->view.lodThreshold = raised[view].lodThreshold;
        }
}

shared::Motion PlacedField::motionOf(const GrassFrame& frame, const HostView& view) const
{
    const Placement& before = written_ == 0 ? instance_.placement : placementBefore_;
    shared::Motion motion = {};
    motion.clipBefore = glm::mat4(view.clipBefore.value_or(view.worldToClip) *
                                  before.toWorld(Access::of(*instance_.field).shape.origin));
    motion.statesBefore = states_.before();
    motion.moves = hasMoved_ && tickOf(frame.time) != tickOf(timeBefore_) ? 1 : 0;
    return motion;
}

VkDeviceSize PlacedField::motionOffset(std::uint32_t view) const
{
    return frameOffset(frameKinds, 0) + view * sizeof(shared::Motion);
}

VkDeviceSize PlacedField::lightOffset(std::uint32_t view) const
{
    return motionOffset(settings_.maxViews) + view * sizeof(shared::HostLight);
}

VkDeviceAddress PlacedField::motion(std::uint32_t slot, std::uint32_t view) const
{
    return slots_[slot].constants.address() + motionOffset(view);
}

std::uint32_t PlacedField::frameIndex(std::uint32_t kind, std::uint32_t view) const
{
    expect(view < lists_.size(), "the view is one of the frame's");
    return kind * settings_.maxViews + view;
}

VkDeviceSize PlacedField::frameOffset(std::uint32_t kind, std::uint32_t view) const
{
    return framesOffset() + frameIndex(kind, view) * sizeof(shared::Frame);
}

FramePlace PlacedField::framePlace(std::uint32_t slot, std::uint32_t kind, std::uint32_t view) const
{
    return {slots_[slot].constants.address() + frameOffset(kind, view),
            slots_[slot].frames.get(frameIndex(kind, view))};
}

void PlacedField::put(std::uint32_t slot, std::uint32_t kind, std::uint32_t view,
                      const shared::Frame& frame) const
{
    std::memcpy(slots_[slot].constants.mapped().data() + frameOffset(kind, view), &frame,
                sizeof frame);
}

FramePlace PlacedField::updateFrame(std::uint32_t slot, std::uint32_t view) const
{
    return framePlace(slot, forUpdate, view);
}

FramePlace PlacedField::cullView(std::uint32_t slot, std::uint32_t view) const
{
    return framePlace(slot, forCulling, view);
}

FramePlace PlacedField::drawnFrame(std::uint32_t slot, std::uint32_t view) const
{
    return framePlace(slot, forDrawing, view);
}

FramePlace PlacedField::rasterFrame(std::uint32_t slot, std::uint32_t view) const
{
    return framePlace(slot, forRaster, view);
}

void PlacedField::recordStart(const gpu::Recording& commands, double time)
{
    // Treats every blade as settled: none is still moving from the straight pose of the bake.
    const bool hadMoved = std::exchange(hasMoved_, true);
    if (!hadMoved)
        states_.rest(commands, settledTick(time));
    else if (!movesOn(movedTo_, time))
        states_.settle(commands, settledTick(time));
    if (std::exchange(hasNewEtas_, false) && hadMoved)
        states_.clearEtas(commands);
    movedTo_ = time;
}

void PlacedField::recordMoved(const gpu::Recording& commands, std::uint32_t slot) const
{
    const VkBufferCopy first{0, 0, sizeof(shared::DrawArguments)};
    commands.vk->CmdCopyBuffer(commands, moved_.get(), slots_[slot].counts.get(), 1, &first);
}

void PlacedField::recordCounts(const gpu::Recording& commands, std::uint32_t slot,
                               std::uint32_t view) const
{
    const VkBufferCopy one{0, (1 + view) * sizeof(shared::DrawArguments),
                           sizeof(shared::DrawArguments)};
    commands.vk->CmdCopyBuffer(commands, lists_[view].draw().get(), slots_[slot].counts.get(), 1,
                               &one);
}

void PlacedField::addCounts(std::uint32_t slot, std::uint32_t view, FrameStats& sum) const
{
    const auto counts = slots_[slot].counts.mappedAs<shared::DrawArguments>();
    const auto& cullResults = counts[1 + view].cullResults;
    const std::uint64_t total = slots_[slot].blades;
    std::uint64_t resident = isUploaded() ? total : 0;
    if (streaming() != nullptr)
        resident = streaming()->residentBlades(slot);
    sum.total += total;
    sum.resident += resident;
    sum.streamedOut += total - resident;
    // One of them is 0: the blades of a single view are moved when they are culled.
    sum.simulated += counts[0].simulated + counts[1 + view].simulated;
    sum.drawn += cullResults[shared::cullResultDrawn];
    sum.lod += cullResults[shared::cullResultLod];
    sum.culledPatch += cullResults[shared::cullResultPatch];
    sum.culledOrientation += cullResults[shared::cullResultOrientation];
    sum.culledFrustum += cullResults[shared::cullResultFrustum];
    sum.culledDistance += cullResults[shared::cullResultDistance];
    sum.culledOcclusion += cullResults[shared::cullResultOcclusion];
}

VkDeviceSize PlacedField::bytes() const
{
    VkDeviceSize sum = states_.bytes() + moved_.bytes();
    for (const VisibleBlades& list : lists_)
        sum += list.bytes();
    for (const VisibilityHistory& history : histories_)
        sum += history.bytes();
    for (const Slot& slot : slots_)
        sum += slot.constants.bytes() + slot.counts.bytes();
    return sum;
}

} // namespace sward::render
