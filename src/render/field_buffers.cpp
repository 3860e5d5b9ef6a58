#include "render/field_buffers.h"

#include "core/error.h"
#include "core/expect.h"
#include "gpu/compute_pipeline.h"
#include "shaders/shared/passes.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <vector>

namespace sward::render {
namespace {

/// Bytes per blade: the blade, its state, its place in the list, its fate.
VkDeviceSize bytesPerBlade(FieldBuffers::Records records)
{
    return sizeof(shared::PackedBlade) + sizeof(shared::BladeState) +
           (records.list ? sizeof(shared::VisibleBlade) : 0) +
           (records.fates ? sizeof(std::uint32_t) : 0);
}

void refuseWhatCannotFit(const gpu::DeviceContext& context, const field::FieldView& field,
                         FieldBuffers::Records records)
{
    const VkDeviceSize needed =
        field.blades.size() * bytesPerBlade(records) + field.patches.size() * sizeof(shared::Patch);
    if (needed > context.deviceLocalBytes())
        fail(ErrorKind::runtime,
             "the field's {} blades need {} MiB of device memory; {} has {} MiB",
             field.blades.size(), needed >> 20, context.name, context.deviceLocalBytes() >> 20);
    if (field.blades.size() > std::numeric_limits<std::uint32_t>::max())
        fail(ErrorKind::unsupported, "the field has {} blades; one view draws at most {}",
             field.blades.size(), std::numeric_limits<std::uint32_t>::max());
}

/// Indices of the patches that own blades, in the order of their blades.
std::vector<std::uint32_t> ownersOf(const field::FieldView& field)
{
    std::vector<std::uint32_t> owners;
    for (std::size_t i = 0; i < field.patches.size(); ++i)
        if (field.patches[i].bladeCount > 0)
            owners.push_back(static_cast<std::uint32_t>(i));
    std::sort(owners.begin(), owners.end(), [&](std::uint32_t a, std::uint32_t b) {
        return field.patches[a].firstBlade < field.patches[b].firstBlade;
    });
    return owners;
}

/// The places among `owners` at which the search for a blade's patch begins.
std::vector<std::uint32_t> firstOwnersOf(const field::FieldView& field,
                                         const std::vector<std::uint32_t>& owners)
{
    std::vector<std::uint32_t> first;
    std::uint32_t place = 0;
    for (std::size_t blade = 0; blade < field.blades.size(); blade += shared::ownerStride) {
        const auto end = [&] {
            const shared::Patch& cell = field.patches[owners[place]];
            return std::size_t(cell.firstBlade) + cell.bladeCount;
        };
        while (end() <= blade)
            ++place;
        first.push_back(place);
    }
    return first;
}

} // namespace

FieldBuffers::FieldBuffers(const gpu::DeviceContext& context, gpu::Uploader& uploader,
                           const field::FieldView& field, Records records)
    : records_(records)
{
    refuseWhatCannotFit(context, field, records);
    const std::vector<std::uint32_t> owners = ownersOf(field);
    bladeCount_ = static_cast<std::uint32_t>(field.blades.size());
    patchCount_ = static_cast<std::uint32_t>(field.patches.size());
    ownerCount_ = static_cast<std::uint32_t>(owners.size());
    bladeSize_ = field::meanBladeSize(field);

    // What the bake has written, as it lies in the file.
    std::vector<shared::Species> species;
    for (const field::Species& kind : field.species)
        species.push_back(kind.look);
    species.resize(shared::maxSpecies, species.empty() ? shared::Species{} : species.front());
    blades_ = allocate(context, "field/blades", field.blades.size_bytes());
    patches_ = allocate(context, "field/patches", field.patches.size_bytes());
    owners_ = allocate(context, "field/owners", owners.size() * sizeof(std::uint32_t));
    const std::vector<std::uint32_t> firstOwners = firstOwnersOf(field, owners);
    firstOwners_ =
        allocate(context, "field/first owners", firstOwners.size() * sizeof(std::uint32_t));
    uploader.toBuffer(firstOwners_, std::span<const std::uint32_t>(firstOwners));
    species_ = allocate(context, "field/species", species.size() * sizeof(shared::Species));
    uploader.toBuffer(blades_, field.blades);
    uploader.toBuffer(patches_, field.patches);
    uploader.toBuffer(owners_, std::span<const std::uint32_t>(owners));
    uploader.toBuffer(species_, std::span<const shared::Species>(species));

    // What changes from frame to frame. The list has room for every blade of a round.
    roundPatches_ = ownerCount_;
    if (!records.list)
        roundPatches_ = std::min(
            ownerCount_,
            std::max(records.roundPatches,
                     static_cast<std::uint32_t>(gpu::groupsFor(ownerCount_, shared::mostRounds))));
    roundPatches_ = std::max(roundPatches_, 1u);
    roundCount_ =
        std::max(1u, static_cast<std::uint32_t>(gpu::groupsFor(ownerCount_, roundPatches_)));
    listLength_ = static_cast<std::uint32_t>(std::min<std::uint64_t>(
        bladeCount_, std::uint64_t(roundPatches_) * shared::maxPatchBlades));
    tree_.emplace(context, uploader, field, records.walkStart);
    bytes_ += tree_->bytes();
    states_ = allocate(context, "field/states", bladeCount_ * sizeof(shared::BladeState));
    patchTimes_ = allocate(context, "field/patch times", patchCount_ * sizeof(float));
    patchCounts_ = allocate(context, "field/patch counts", patchCount_ * sizeof(std::uint32_t));
    visible_ = allocate(context, "field/visible", listLength_ * sizeof(shared::VisibleBlade));
    rounds_ = allocate(context, "field/rounds", roundCount_ * sizeof(shared::WalkLevel));
    draw_ = allocate(context, "field/draw", sizeof(shared::DrawArguments));
    if (records.fates)
        fates_ = allocate(context, "field/fates", bladeCount_ * sizeof(std::uint32_t));
}

gpu::Buffer FieldBuffers::allocate(const gpu::DeviceContext& context, const char* name,
                                   VkDeviceSize bytes)
{
    bytes_ += bytes;
    return {context,
            {.name = name,
             .bytes = bytes,
             .usage = VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT |
                      VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT}};
}

void FieldBuffers::describe(shared::Frame& frame) const
{
    frame.blades = blades_.address();
    frame.states = states_.address();
    frame.patches = patches_.address();
    frame.species = species_.address();
    frame.visible = visible_.address();
    frame.draw = draw_.address();
    frame.patchTimes = patchTimes_.address();
    frame.patchCounts = patchCounts_.address();
    frame.fates = records_.fates ? fates_.address() : 0;
    frame.patchCount = patchCount_;
    frame.bladeCount = bladeCount_;
    frame.visibleCapacity = listLength_;
}

void FieldBuffers::rest(VkCommandBuffer commands, float time) const
{
    // A state of zeros is a blade that stands straight up.
    vkCmdFillBuffer(commands, states_.get(), 0, VK_WHOLE_SIZE, 0);
    vkCmdFillBuffer(commands, patchTimes_.get(), 0, VK_WHOLE_SIZE,
                    std::bit_cast<std::uint32_t>(time));
    vkCmdFillBuffer(commands, patchCounts_.get(), 0, VK_WHOLE_SIZE, shared::maxPatchBlades);
}

void FieldBuffers::clearCounts(VkCommandBuffer commands) const
{
    shared::DrawArguments none = {};
    none.vertexCount = shared::drawChunk;
    vkCmdUpdateBuffer(commands, draw_.get(), 0, sizeof none, &none);
    vkCmdFillBuffer(commands, rounds_.get(), 0, VK_WHOLE_SIZE, 0);
    tree_->clear(commands);
}

void FieldBuffers::clearFates(VkCommandBuffer commands) const
{
    // What the walk does not reach is left out with its patch.
    if (records_.fates)
        vkCmdFillBuffer(commands, fates_.get(), 0, VK_WHOLE_SIZE, shared::fatePatch);
}

} // namespace sward::render
