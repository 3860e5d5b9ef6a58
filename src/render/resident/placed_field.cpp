#include "render/resident/placed_field.h"

#include "core/expect.h"
#include "gpu/pipeline/compute_pipeline.h"
#include "render/field/frame_tables.h"
#include "render/frame/frame.h"
#include "render/frame/frame_time.h"
#include "render/frame/shadow_box.h"

#include <algorithm>
#include <cstring>
#include <optional>
#include <utility>

namespace sward::render {
namespace {

using Kind = InstanceConstants::Kind;

/// Patches of a list of the sun's view: all.
constexpr std::uint32_t shadowPatches = 0xffffffffu;

InstanceConstants::Settings constantsOf(const PlacedField::Settings& settings)
{
    return {.slots = settings.framesInFlight,
            .views = settings.maxViews,
            .listsAll = settings.keepsCullResults};
}

gpu::Buffer cullResultsOf(const gpu::DeviceContext& context, const BakedBlades& blades)
{
    return {context,
            {.name = "instance/cull results",
             .bytes = blades.placeCount() * sizeof(std::uint32_t),
             .usage = VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT |
                      VK_BUFFER_USAGE_STORAGE_BUFFER_BIT}};
}

} // namespace

PlacedField::PlacedField(const gpu::DeviceContext& context, const DeviceField& field,
                         const Settings& settings, std::shared_ptr<const ResidentField> resident)
    : context_(&context)
    , field_(&field)
    , settings_(settings)
    , resident_(std::move(resident))
    , states_(context, field.blades,
              {.before = settings.keepsMotion, .etas = field.blades.isPaged()})
    , moved_(context,
             {.name = "instance/moved",
              .bytes = sizeof(shared::DrawArguments),
              .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT |
                       VK_BUFFER_USAGE_TRANSFER_DST_BIT})
    , replaced_(settings.framesInFlight)
    , constants_(context, constantsOf(settings))
    , bladesOfSlot_(settings.framesInFlight, field.blades.bladeCount())
    , residentOfSlot_(settings.framesInFlight, 0)
{
    if (settings.keepsCullResults)
        cullResults_ = cullResultsOf(context, field.blades);
}

void PlacedField::expectViews(std::uint32_t views)
{
    while (lists_.size() < views)
        lists_.emplace_back(*context_, blades(), settings_.roundPatches, settings_.maxListed);
    histories_.resize(lists_.size());
    shadows_.resize(lists_.size());
}

void PlacedField::write(std::uint32_t slot, const InstanceFrame& frame, std::uint32_t number)
{
    followEdits();
    expectViews(static_cast<std::uint32_t>(frame.views.size()));
    if (!frame.colliders.empty() && !states_.hasEtas()) {
        states_.keepEtas(*context_);
        hasNewEtas_ = true;
    }
    std::ranges::fill(constants_.counts(slot).mapped(), std::byte{0});
    bladesOfSlot_[slot] = sowing() != nullptr ? sowing()->allBlades() : blades().bladeCount();

    // Shared by all views.
    const FrameSettings& settings = frame.settings;
    shared::Frame tabled = {};
    writeTables(constants_.tables(slot), field_->shape, settings, frame.colliders, frame.time,
                tabled);

    seen_.clear();
    for (std::uint32_t i = 0; i < frame.views.size(); ++i) {
        const InstanceView& view = frame.views[i];
        shared::Frame drawn = frameOf(field_->shape, view.seen, settings, frame.time, view.samples);
        if (view.isParallel)
            drawn.view.cullMask &= ~shared::cullDistance;
        drawn.updateRate.frame = frame.number;
        drawn.environment.wind = tabled.environment.wind;
        drawn.environment.colliderCount = tabled.environment.colliderCount;
        drawn.environment.colliders = tabled.environment.colliders;
        blades().describe(drawn);
        states_.describe(drawn);
        lists_[i].describe(drawn);
        drawn.cullResults = cullResults_.address();
        field_->cover.describe(drawn, settings.thatch);
        environment_ = drawn.environment;
        std::optional<shared::HostLight> light;
        if (frame.complete)
            light = frame.complete(i, drawn);
        if (light)
            drawn.hostLight = constants_.putLight(slot, i, *light);

        if (view.shadowBox) {
            drawn.bladeShadow = bladeShadowOf(*view.shadowBox, view.shadowMap);
            shared::Frame seen = seenBySun(drawn, *view.shadowBox);
            shadows_[i]->describe(seen);
            constants_.put(slot, Kind::shadow, i, seen);
        }
        shared::Frame cullView = drawn;
        if (view.culled)
            look(cullView, *view.culled);
        seen_.push_back(cullView.view);
        cullView.pyramid = view.cullPyramid;
        constants_.put(slot, Kind::culling, i, cullView);
        shared::Frame updated = cullView;
        updated.draw = moved_.address();
        updated.pyramid = {};
        updated.view.cullMask &= ~shared::cullOcclusion;
        constants_.put(slot, Kind::update, i, updated);
        drawn.pyramid = view.rasterPyramid;
        constants_.put(slot, Kind::raster, i, drawn);
        if (settings_.keepsCullResults)
            constants_.put(slot, Kind::listing, i, listingAll(drawn));
        if (view.tessellated)
            project(drawn, *view.tessellated, drawn.view.eye);
        constants_.put(slot, Kind::drawing, i, drawn);
        constants_.putMotion(slot, i, motionOf(frame, view));
    }
    written_ = number;
    timeBefore_ = frame.time;
}

void PlacedField::expectHistory(std::uint32_t view)
{
    if (histories_[view].address() == 0 && blades().indexCount() > 0)
        histories_[view] = VisibilityHistory(*context_, blades().indexCount());
}

void PlacedField::expectShadow(std::uint32_t view)
{
    if (!shadows_[view])
        shadows_[view].emplace(*context_, blades(), shadowPatches, 1);
}

void PlacedField::followEdits()
{
    if (edits() == nullptr)
        return;
    states_.update(*context_, blades(), replaced_.waiting());
    for (VisibleBlades& list : lists_)
        list.update(*context_, blades(), replaced_.waiting());
    for (std::optional<VisibleBlades>& list : shadows_)
        if (list)
            list->update(*context_, blades(), replaced_.waiting());
    if (settings_.keepsCullResults &&
        blades().placeCount() * sizeof(std::uint32_t) > cullResults_.bytes())
        replaced_.waiting().push_back(
            {std::exchange(cullResults_, cullResultsOf(*context_, blades())), VK_NULL_HANDLE});
    for (VisibilityHistory& history : histories_)
        if (!history.hasRoomFor(blades().indexCount()))
            replaced_.waiting().push_back(
                {history.grow(*context_, blades().indexCount()), VK_NULL_HANDLE});
}

void PlacedField::recordReplaced(const gpu::Recording& commands, std::uint32_t slot)
{
    replaced_.record(commands, slot);
}

void PlacedField::clearCullResults(const gpu::Recording& commands) const
{
    if (settings_.keepsCullResults)
        commands.vk->CmdFillBuffer(commands, cullResults_.get(), 0, VK_WHOLE_SIZE,
                                   shared::cullResultPatch);
}

std::uint32_t PlacedField::roundCount(std::uint32_t view) const
{
    const VisibleBlades& list = lists_[view];
    if (list.roundCount() == 1)
        return 1;
    expect(field_->bound || sowing() != nullptr, "lists of several rounds have a bound");
    const std::uint64_t resident =
        streaming() != nullptr ? streaming()->residentPatches() : blades().nonEmptyPatchCount();
    const std::uint64_t seen = sowing() != nullptr
                                   ? sowing()->visiblePatches(seen_[view])
                                   : field_->bound->of(seen_[view], settings_.keepsCullResults);
    const std::uint64_t visible = std::min(seen, resident);
    const auto rounds = static_cast<std::uint32_t>(gpu::groupsFor(visible, list.roundPatches()));
    return std::clamp(rounds, 1u, list.roundCount());
}

void PlacedField::thin(std::uint32_t slot, std::span<const shared::Eyepoint> raised)
{
    if (sowing() != nullptr)
        residentOfSlot_[slot] = sowing()->residentBlades();
    for (std::uint32_t view = 0; view < raised.size(); ++view) {
        seen_[view].lodThreshold = raised[view].lodThreshold;
        constants_.thin(slot, view, raised[view].lodThreshold);
    }
}

shared::Motion PlacedField::motionOf(const InstanceFrame& frame, const InstanceView& view) const
{
    shared::Motion motion = {};
    motion.clipBefore = view.clipBefore;
    motion.statesBefore = states_.before();
    motion.moves = hasMoved_ && tickOf(frame.time) != tickOf(timeBefore_) ? 1 : 0;
    return motion;
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
    commands.vk->CmdCopyBuffer(commands, moved_.get(), constants_.counts(slot).get(), 1, &first);
}

void PlacedField::recordCounts(const gpu::Recording& commands, std::uint32_t slot,
                               std::uint32_t view) const
{
    const VkBufferCopy one{0, (1 + view) * sizeof(shared::DrawArguments),
                           sizeof(shared::DrawArguments)};
    commands.vk->CmdCopyBuffer(commands, lists_[view].draw().get(), constants_.counts(slot).get(),
                               1, &one);
}

void PlacedField::addCounts(std::uint32_t slot, std::uint32_t view, FrameStats& sum) const
{
    const auto counts = constants_.counts(slot).mappedAs<shared::DrawArguments>();
    const auto& cullResults = counts[1 + view].cullResults;
    const std::uint64_t total = bladesOfSlot_[slot];
    std::uint64_t resident = isUploaded() ? total : 0;
    if (streaming() != nullptr)
        resident = streaming()->residentBlades(slot);
    if (sowing() != nullptr)
        resident = std::min(residentOfSlot_[slot], total);
    const std::uint64_t stored = blades().bladeCount();
    if (sowing() != nullptr)
        sum.sown += resident - std::min(stored, resident);
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
    VkDeviceSize sum = states_.bytes() + cullResults_.bytes() + constantBytes(settings_);
    for (const VisibleBlades& list : lists_)
        sum += list.bytes();
    for (const VisibilityHistory& history : histories_)
        sum += history.bytes();
    for (const std::optional<VisibleBlades>& list : shadows_)
        sum += list ? list->bytes() : 0;
    return sum;
}

VkDeviceSize PlacedField::constantBytes(const Settings& settings)
{
    return sizeof(shared::DrawArguments) + InstanceConstants::bytesOf(constantsOf(settings));
}

} // namespace sward::render
