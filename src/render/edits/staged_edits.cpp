#include "render/edits/staged_edits.h"

#include "gpu/recording/barrier.h"
#include "render/frame/shader_names.h"
#include "shaders/shared/edits.h"
#include "shaders/shared/pose.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <iterator>
#include <span>
#include <utility>

namespace sward::render {
namespace {

/// What shaders read begins at such offsets.
constexpr VkDeviceSize editAlignment = 16;

constexpr VkDeviceSize minStaging = VkDeviceSize(1) << 20;

VkDeviceSize alignedEdit(VkDeviceSize bytes)
{
    return (bytes + editAlignment - 1) / editAlignment * editAlignment;
}

} // namespace

StagedEdits::StagedEdits(const gpu::DeviceContext& context, const gpu::ShaderLibrary& shaders,
                         std::uint32_t framesInFlight)
    : context_(&context)
    , states_(context, shaders,
              {.name = "move states",
               .shader = shader::moveStates,
               .pushConstantBytes = sizeof(shared::EditPush)})
    , slots_(framesInFlight)
{
}

gpu::Buffer StagedEdits::staging(VkDeviceSize bytes)
{
    const auto fits = std::ranges::find_if(
        spare_, [&](const gpu::Buffer& buffer) { return buffer.bytes() >= bytes; });
    if (fits != spare_.end()) {
        gpu::Buffer found = std::move(*fits);
        spare_.erase(fits);
        return found;
    }
    return {*context_,
            {.name = "edit/staging",
             .bytes = std::bit_ceil(std::max(bytes, minStaging)),
             .usage = VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
             .memory = gpu::MemoryUse::upload}};
}

void StagedEdits::add(const Edit& edit, const FieldTables& tables, const Cover& cover)
{
    // Collect the copies, then the bytes: these need mapped memory of their size.
    Staged staged;
    std::vector<std::pair<VkDeviceSize, std::span<const std::byte>>> parts;
    VkDeviceSize size = 0;
    const auto add = [&](std::span<const std::byte> bytes) {
        const VkDeviceSize offset = size;
        parts.emplace_back(offset, bytes);
        size += alignedEdit(bytes.size());
        return offset;
    };
    const auto copy = [&]<typename T>(Table table, std::span<const T> elements,
                                      const std::vector<PlaceRange>& ranges) {
        for (const PlaceRange& range : ranges) {
            const auto bytes = std::as_bytes(elements.subspan(range.first, range.count));
            staged.copies.push_back({table, {add(bytes), range.first * sizeof(T), bytes.size()}});
        }
    };
    for (const Edit::Blades& blades : edit.blades) {
        const auto bytes = std::as_bytes(blades.blades);
        staged.copies.push_back(
            {Table::blades,
             {add(bytes), blades.first * sizeof(shared::PackedBlade), bytes.size()}});
    }
    copy(Table::patches, tables.patches, edit.patches);
    copy(Table::subtrees, tables.subtrees, edit.patches);
    copy(Table::entries, tables.entries, edit.entries);
    copy(Table::firstEntries, tables.firstEntries, edit.firstEntries);
    if (cover.corners.count > 0)
        copy(Table::cover, cover.values, {cover.corners});
    staged.cover = cover.buffer;
    staged.sources = add(std::as_bytes(std::span(edit.sources)));
    staged.sourceCount = static_cast<std::uint32_t>(edit.sources.size());
    staged.patches = add(std::as_bytes(std::span(edit.times)));
    staged.patchCount = static_cast<std::uint32_t>(edit.times.size());
    staged.times = size;
    size += 2 * alignedEdit(edit.times.size() * sizeof(std::uint32_t));

    staged.bytes = staging(size);
    for (const auto& [offset, bytes] : parts)
        if (!bytes.empty())
            std::memcpy(staged.bytes.mapped().data() + offset, bytes.data(), bytes.size());
    waiting_.push_back(std::move(staged));
}

const gpu::Buffer& StagedEdits::bufferOf(const Staged& staged, Table table,
                                         const BakedBlades& baked)
{
    switch (table) {
    case Table::patches:
        return baked.patchTable();
    case Table::subtrees:
        return baked.tree().buffer();
    case Table::entries:
        return baked.entryTable();
    case Table::firstEntries:
        return baked.firstEntryTable();
    case Table::cover:
        return *staged.cover;
    case Table::blades:
        break;
    }
    return baked.blades();
}

void StagedEdits::recordStates(const gpu::Recording& commands, const BladeStates& states,
                               const Staged& staged, std::uint32_t settledAt, bool isSecond) const
{
    const VkDeviceAddress bytes = staged.bytes.address();
    states_.bind(commands);
    states_.push(commands,
                 shared::EditPush{.states = states.states().address(),
                                  .etas = states.etas().address(),
                                  .patchTimes = states.patchTimes(),
                                  .patchCounts = states.patchCounts(),
                                  .blades = bytes + staged.sources,
                                  .patches = bytes + staged.patches,
                                  .times = bytes + staged.times,
                                  .counts = bytes + staged.times +
                                            alignedEdit(staged.patchCount * sizeof(std::uint32_t)),
                                  .bladeCount = staged.sourceCount,
                                  .patchCount = staged.patchCount,
                                  .settledAt = settledAt,
                                  .isSecond = isSecond ? 1u : 0u});
    const std::uint32_t threads =
        isSecond ? staged.patchCount : std::max(staged.sourceCount, staged.patchCount);
    const auto groups =
        std::clamp<std::uint64_t>(gpu::groupsFor(threads, shared::editThreads), 1, 4096);
    commands.vk->CmdDispatch(commands, static_cast<std::uint32_t>(groups), 1, 1);
}

void StagedEdits::record(const gpu::Recording& commands, const BakedBlades& baked,
                         std::span<const BladeStates* const> states, std::uint32_t settledAt,
                         std::uint32_t slot)
{
    std::vector<gpu::Buffer>& inFlight = slots_[slot];
    std::move(inFlight.begin(), inFlight.end(), std::back_inserter(spare_));
    inFlight.clear();
    if (waiting_.empty())
        return;

    const auto everything = [&] { gpu::memoryBarrier(commands, gpu::anyAccess, gpu::anyAccess); };
    everything();
    for (Staged& staged : waiting_) {
        for (const BladeStates* const own : states) {
            recordStates(commands, *own, staged, settledAt, false);
            everything();
            recordStates(commands, *own, staged, settledAt, true);
            everything();
        }
        for (const Copy& copy : staged.copies)
            commands.vk->CmdCopyBuffer(commands, staged.bytes.get(),
                                       bufferOf(staged, copy.table, baked).get(), 1, &copy.region);
        everything();
        inFlight.push_back(std::move(staged.bytes));
    }
    waiting_.clear();
}

VkDeviceSize StagedEdits::bytes() const
{
    VkDeviceSize sum = 0;
    for (const Staged& staged : waiting_)
        sum += staged.bytes.bytes();
    for (const std::vector<gpu::Buffer>& inFlight : slots_)
        for (const gpu::Buffer& buffer : inFlight)
            sum += buffer.bytes();
    for (const gpu::Buffer& buffer : spare_)
        sum += buffer.bytes();
    return sum;
}

} // namespace sward::render
