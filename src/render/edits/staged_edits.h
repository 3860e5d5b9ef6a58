#pragma once

#include "gpu/context/context.h"
#include "gpu/memory/buffer.h"
#include "gpu/pipeline/compute_pipeline.h"
#include "gpu/pipeline/shader_library.h"
#include "gpu/recording/recording.h"
#include "render/field/baked_blades.h"
#include "render/field/blade_states.h"
#include "render/field/edit.h"
#include "render/field/field_tables.h"

#include <vulkan/vulkan.h>

#include <cstdint>
#include <span>
#include <vector>

namespace sward::render {

/// Changes of a field's tables on the device: kept in mapped memory until the next frame records
/// them. A barrier separates them from the frames before, so no place waits for frames in flight;
/// only mapped memory does.
class StagedEdits {
public:
    /// The context must outlive it.
    StagedEdits(const gpu::DeviceContext& context, const gpu::ShaderLibrary& shaders,
                std::uint32_t framesInFlight);

    /// Corners of a cover that change, and where they are on the device.
    struct Cover {
        std::span<const std::uint32_t> values; ///< all of them
        PlaceRange corners;
        const gpu::Buffer* buffer = nullptr;
    };

    /// Copies what an edit changes into mapped memory.
    void add(const Edit& edit, const FieldTables& tables, const Cover& cover);
    void add(const Edit& edit, const FieldTables& tables) { add(edit, tables, Cover()); }

    /// Records all since the last call, with barriers from and to everything: of the field's
    /// tables, and of the states of each of its placements. `settledAt`: tick at which a new
    /// patch counts as settled, see settledTick(). The former commands of `slot` must have
    /// completed.
    void record(const gpu::Recording& commands, const BakedBlades& baked,
                std::span<const BladeStates* const> states, std::uint32_t settledAt,
                std::uint32_t slot);

    VkDeviceSize bytes() const; ///< of mapped memory

private:
    enum class Table { blades, patches, subtrees, entries, firstEntries, cover };
    struct Copy {
        Table table = Table::blades;
        VkBufferCopy region{};
    };
    struct Staged {
        gpu::Buffer bytes;
        std::vector<Copy> copies;
        const gpu::Buffer* cover = nullptr;
        VkDeviceSize sources = 0; ///< offsets of what the shader reads and writes
        VkDeviceSize patches = 0;
        VkDeviceSize times = 0;
        std::uint32_t sourceCount = 0;
        std::uint32_t patchCount = 0;
    };
    gpu::Buffer staging(VkDeviceSize bytes);
    void recordStates(const gpu::Recording& commands, const BladeStates& states,
                      const Staged& staged, std::uint32_t settledAt, bool isSecond) const;
    static const gpu::Buffer& bufferOf(const Staged& staged, Table table, const BakedBlades& baked);

    const gpu::DeviceContext* context_;
    gpu::ComputePipeline states_;
    std::vector<Staged> waiting_;
    std::vector<std::vector<gpu::Buffer>> slots_; ///< mapped memory that their frames may read
    std::vector<gpu::Buffer> spare_;              ///< mapped memory that is not in use
};

} // namespace sward::render
