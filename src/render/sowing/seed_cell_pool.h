#pragma once

#include "field/seeds/sow_unit.h"
#include "field/seeds/sower.h"
#include "gpu/context/context.h"
#include "gpu/memory/buffer.h"
#include "render/field/free_ranges.h"

#include <vulkan/vulkan.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

namespace sward::render {

/// Unpacked cells of a field's seeds in device memory, as shaders read them; those used last. A
/// cell's memory is reused by commands that are recorded later, with a barrier between them.
class SeedCellPool {
public:
    /// The context must outlive it.
    SeedCellPool(const gpu::DeviceContext& context, VkDeviceSize bytes);

    /// A cell's place, and its bytes if they have to be copied there.
    struct Use {
        VkDeviceAddress address = 0; ///< of its shared::SowCell; 0: no room in this batch
        VkDeviceSize offset = 0;     ///< of the bytes in buffer()
        std::vector<std::byte> bytes{};
    };

    /// Uses the cell `index` in a batch. Cells that the same batch uses stay. `maxBytes`: that may
    /// be copied.
    Use use(std::size_t index, const field::UnitCell& cell, std::uint64_t batch,
            VkDeviceSize maxBytes);

    /// Whether a cell can ever be there.
    bool fits(const field::UnitCell& cell, VkDeviceSize maxBytes) const;

    /// Forgets a cell, whose content has changed.
    void forget(std::size_t index);

    const gpu::Buffer& buffer() const { return buffer_; }

private:
    struct Held {
        PlaceRange blocks;
        std::uint64_t lastBatch = 0;
    };
    bool makeRoom(std::uint64_t batch);

    gpu::Buffer buffer_;
    FreeRanges free_; ///< blocks
    std::uint32_t blocks_;
    std::map<std::size_t, Held> held_; ///< by number of the cell
};

} // namespace sward::render
