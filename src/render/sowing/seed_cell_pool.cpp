#include "render/sowing/seed_cell_pool.h"

#include "shaders/shared/sow/sow_pass.h"

#include <algorithm>
#include <cstring>
#include <optional>

namespace sward::render {
namespace {

/// Cells begin at multiples of this [bytes].
constexpr VkDeviceSize seedBlock = 256;

/// What shaders read begins at multiples of this.
constexpr VkDeviceSize seedAlignment = 16;

VkDeviceSize alignedSeeds(VkDeviceSize bytes)
{
    return (bytes + seedAlignment - 1) / seedAlignment * seedAlignment;
}

/// Bytes of a cell in device memory.
VkDeviceSize sizeOf(const field::UnitCell& cell)
{
    const field::SeedCell& seeds = cell.seeds();
    const auto bytes = []<typename T>(const std::vector<T>& list) {
        return alignedSeeds(list.size() * sizeof(T));
    };
    return alignedSeeds(sizeof(shared::SowCell)) + bytes(seeds.vertices) + bytes(seeds.pieces) +
           bytes(seeds.conditions) + bytes(seeds.words) + bytes(cell.around().waves) +
           alignedSeeds(seeds.clumps.size() * sizeof(shared::SowCentre)) +
           alignedSeeds(cell.around().clumps.heads().size_bytes());
}

/// A cell's bytes at a device address.
std::vector<std::byte> bytesOf(const field::UnitCell& cell, VkDeviceAddress address)
{
    const field::SeedCell& seeds = cell.seeds();
    const field::CellSurroundings& around = cell.around();
    const std::vector<shared::SowCentre> centres = around.clumps.centres();
    std::vector<std::byte> result(alignedSeeds(sizeof(shared::SowCell)));
    const auto add = [&]<typename T>(std::span<const T> list) {
        const VkDeviceAddress at = address + result.size();
        const auto bytes = std::as_bytes(list);
        result.insert(result.end(), bytes.begin(), bytes.end());
        result.resize(alignedSeeds(result.size()));
        return at;
    };
    shared::SowCell header = {};
    header.vertices = add(std::span(seeds.vertices));
    header.pieces = add(std::span(seeds.pieces));
    header.conditions = add(std::span(seeds.conditions));
    header.words.address = add(std::span(seeds.words));
    header.waves.address = add(std::span(around.waves));
    header.centres = add(std::span(centres));
    header.heads = add(around.clumps.heads());
    header.headMask = static_cast<std::uint32_t>(around.clumps.heads().size() - 1);
    header.centreCount = static_cast<std::uint32_t>(centres.size());
    header.ground = around.ground;
    header.heightScale = around.heightScale;
    std::memcpy(result.data(), &header, sizeof header);
    return result;
}

std::uint32_t blocksOf(VkDeviceSize bytes)
{
    return static_cast<std::uint32_t>((bytes + seedBlock - 1) / seedBlock);
}

} // namespace

SeedCellPool::SeedCellPool(const gpu::DeviceContext& context, VkDeviceSize bytes)
    : buffer_(context, {.name = "sowing/cells",
                        .bytes = bytes / seedBlock * seedBlock,
                        .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT |
                                 VK_BUFFER_USAGE_TRANSFER_DST_BIT})
    , blocks_(static_cast<std::uint32_t>(bytes / seedBlock))
{
    free_.give({0, blocks_});
}

bool SeedCellPool::fits(const field::UnitCell& cell, VkDeviceSize maxBytes) const
{
    const VkDeviceSize bytes = sizeOf(cell);
    return bytes <= maxBytes && blocksOf(bytes) <= blocks_;
}

SeedCellPool::Use SeedCellPool::use(std::size_t index, const field::UnitCell& cell,
                                    std::uint64_t batch, VkDeviceSize maxBytes)
{
    const auto found = held_.find(index);
    if (found != held_.end()) {
        found->second.lastBatch = batch;
        return {.address = buffer_.address() + found->second.blocks.first * seedBlock};
    }
    const VkDeviceSize bytes = sizeOf(cell);
    if (bytes > maxBytes)
        return {};
    std::optional<PlaceRange> blocks = free_.take(blocksOf(bytes));
    while (!blocks && makeRoom(batch))
        blocks = free_.take(blocksOf(bytes));
    if (!blocks)
        return {};
    held_[index] = {*blocks, batch};
    Use use;
    use.offset = blocks->first * seedBlock;
    use.address = buffer_.address() + use.offset;
    use.bytes = bytesOf(cell, use.address);
    return use;
}

/// Removes the cell that has not been used for the longest time; none of this batch.
bool SeedCellPool::makeRoom(std::uint64_t batch)
{
    const auto oldest = std::ranges::min_element(
        held_, {}, [](const auto& one) { return one.second.lastBatch; });
    if (oldest == held_.end() || oldest->second.lastBatch == batch)
        return false;
    free_.give(oldest->second.blocks);
    held_.erase(oldest);
    return true;
}

void SeedCellPool::forget(std::size_t index)
{
    const auto found = held_.find(index);
    if (found == held_.end())
        return;
    free_.give(found->second.blocks);
    held_.erase(found);
}

} // namespace sward::render
