#include "render/cull/field_buffers.h"

#include "core/error.h"
#include "gpu/pipeline/compute_pipeline.h"
#include "render/field/edited_field.h"
#include "shaders/shared/pages.h"
#include "shaders/shared/passes.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace sward::render {
namespace {

const field::FieldView& refusingWhatCannotFit(const gpu::DeviceContext& context,
                                              const field::FieldView& field,
                                              FieldBuffers::Records records)
{
    const VkDeviceSize blades =
        records.pages > 0 ? VkDeviceSize(records.pages) * shared::pageBlades : field.blades.size();
    const VkDeviceSize needed =
        blades * records.bytesPerBlade(records.etas) + field.patches.size() * sizeof(shared::Patch);
    if (needed > context.deviceLocalBytes())
        fail(ErrorKind::runtime,
             "the field's {} blades need {} MiB of device memory; {} has {} MiB (with a budget, "
             "--gpu-memory, it is shown in part)",
             field.blades.size(), needed >> 20, context.name, context.deviceLocalBytes() >> 20);
    return field;
}

/// Nodes of the patch tree that bound the number of rounds of a frame: about 20 µs.
constexpr std::size_t nodesOfBound = 2048;

/// Blades of which one list holds all.
constexpr std::uint64_t wholeLists = std::uint64_t(1) << 24;

BakedBlades bakedOf(const gpu::DeviceContext& context, gpu::BufferUpload& upload,
                    const field::FieldView& field, const FieldBuffers::Records& records,
                    const EditedField* edited)
{
    if (edited != nullptr)
        return {context, upload, field, *edited};
    return {context, upload, field, records.walkStart, records.pages};
}

/// Visible patches of a round.
std::uint32_t roundOf(const BakedBlades& baked, FieldBuffers::Records records)
{
    if (records.list)
        return std::numeric_limits<std::uint32_t>::max();
    if (baked.isEditable() && records.roundPatches == 0 && baked.placeCount() <= wholeLists)
        return std::numeric_limits<std::uint32_t>::max();
    return FieldBuffers::roundPatchesOf(baked.patchSizes(), records, baked.placeCount(),
                                        baked.isPaged());
}

gpu::Buffer cullResultsOf(const gpu::DeviceContext& context, const BakedBlades& baked)
{
    return {context,
            {.name = "field/cullResults",
             .bytes = baked.placeCount() * sizeof(std::uint32_t),
             .usage = VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT |
                      VK_BUFFER_USAGE_STORAGE_BUFFER_BIT}};
}

} // namespace

VkDeviceSize FieldBuffers::Records::bytesPerBlade(bool withEtas) const
{
    return sizeof(shared::PackedBlade) + sizeof(shared::BladeState::turn) +
           (withEtas ? sizeof(shared::BladeState::eta) : 0) +
           (list ? sizeof(shared::VisibleBlade) : 0) + (cullResults ? sizeof(std::uint32_t) : 0);
}

std::uint32_t FieldBuffers::roundPatchesOf(const PatchSizes& sizes, const Records& records,
                                           std::uint64_t places, bool isPaged)
{
    if (records.roundPatches > 0)
        return records.roundPatches;
    constexpr std::uint64_t minPatches = 64;
    const std::uint64_t least =
        isPaged ? minPatches * shared::maxPatchBlades : std::min(places, wholeLists);
    return std::max(sizes.patchesWithin(std::max(places / 8, least)), 1u);
}

FieldBuffers::FieldBuffers(const gpu::DeviceContext& context, gpu::BufferUpload& upload,
                           const field::FieldView& field, Records records,
                           const EditedField* edited)
    : baked_(
          bakedOf(context, upload, refusingWhatCannotFit(context, field, records), records, edited))
    , states_(context, baked_, {.before = false, .etas = records.etas || records.pages > 0})
    , list_(context, baked_, roundOf(baked_, records), std::numeric_limits<std::uint32_t>::max())
    , visiblePatchBound_(field, nodesOfBound)
{
    if (records.cullResults)
        cullResults_ = cullResultsOf(context, baked_);
}

void FieldBuffers::update(const gpu::DeviceContext& context, const EditedField& edited,
                          const field::Delta& delta, OutgrownBuffers& outgrown)
{
    baked_.update(context, edited, outgrown);
    states_.update(context, baked_, outgrown);
    list_.update(context, baked_, outgrown);
    for (const field::CellChange& change : delta.cells)
        visiblePatchBound_.replace(change.cell, change.patches);
    if (cullResults_.address() != 0 &&
        baked_.placeCount() * sizeof(std::uint32_t) > cullResults_.bytes())
        outgrown.push_back(
            {std::exchange(cullResults_, cullResultsOf(context, baked_)), VK_NULL_HANDLE});
}

void FieldBuffers::describe(shared::Frame& frame) const
{
    baked_.describe(frame);
    states_.describe(frame);
    list_.describe(frame);
    frame.cullResults = cullResults_.address();
}

void FieldBuffers::clearCullResults(const gpu::Recording& commands) const
{
    // Blades that the walk does not reach are culled with their patch.
    if (cullResults_.address() != 0)
        commands.vk->CmdFillBuffer(commands, cullResults_.get(), 0, VK_WHOLE_SIZE,
                                   shared::cullResultPatch);
}

std::uint32_t FieldBuffers::roundCount(const shared::Frame& cullView, std::uint64_t resident) const
{
    if (list_.roundCount() == 1)
        return 1;
    const std::uint64_t live =
        std::min(visiblePatchBound_.of(cullView.view, cullView.cullResults != 0), resident);
    const auto rounds = static_cast<std::uint32_t>(gpu::groupsFor(live, list_.roundPatches()));
    return std::clamp(rounds, 1u, list_.roundCount());
}

VkDeviceSize FieldBuffers::bytes() const
{
    return baked_.bytes() + states_.bytes() + list_.bytes() + cullResults_.bytes();
}

} // namespace sward::render
