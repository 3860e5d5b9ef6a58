#pragma once

#include "field/delta.h"
#include "gpu/buffer.h"
#include "gpu/compute_pipeline.h"
#include "gpu/context.h"
#include "gpu/recording.h"
#include "gpu/shader_library.h"
#include "render/cull/field_buffers.h"
#include "render/field/edited_field.h"
#include "render/field/outgrown.h"

#include <vulkan/vulkan.h>

#include <cstdint>
#include <memory>
#include <vector>

namespace sward::render {

/// Edits of a field on the device: kept from a delta's arrival until the next frame records them.
/// A barrier separates them from the frames before, so no place waits for frames in flight; only
/// mapped memory and replaced buffers do.
class FieldEdits {
public:
    /// `edited` must have filled the buffers. The context must outlive it.
    FieldEdits(const gpu::DeviceContext& context, const gpu::ShaderLibrary& shaders,
               std::unique_ptr<EditedField> edited, std::uint32_t framesInFlight);

    const EditedField& field() const { return *edited_; }

    /// Copies what the delta changes, and lets the buffers grow. Throws as EditedField::apply().
    void apply(const field::Delta& delta, FieldBuffers& buffers);

    /// Keeps a buffer that another one replaces until frames in flight are over.
    void keep(OutgrownBuffers outgrown);

    /// Records all edits since the last call, with barriers from and to everything. `settledAt` [s]:
    /// the time at which a new patch counts as settled. The former commands of `slot` must have
    /// completed.
    void record(const gpu::Recording& commands, const FieldBuffers& buffers, float settledAt,
                std::uint32_t slot);

private:
    enum class Table { blades, patches, subtrees, entries, firstEntries };
    struct Copy {
        Table table = Table::blades;
        VkBufferCopy region{};
    };
    struct Staged {
        gpu::Buffer bytes;
        std::vector<Copy> copies;
        VkDeviceSize sources = 0; ///< offsets of what the shader reads and writes
        VkDeviceSize patches = 0;
        VkDeviceSize times = 0;
        std::uint32_t sourceCount = 0;
        std::uint32_t patchCount = 0;
    };
    /// What the frames of a slot may still read.
    struct InFlight {
        std::vector<gpu::Buffer> staging;
        OutgrownBuffers outgrown;
    };

    gpu::Buffer staging(VkDeviceSize bytes);
    Staged stage(const Edit& edit);
    void recordStates(const gpu::Recording& commands, const FieldBuffers& buffers,
                      const Staged& staged, float settledAt, bool isSecond) const;
    static const gpu::Buffer& bufferOf(Table table, const FieldBuffers& buffers);

    const gpu::DeviceContext* context_;
    gpu::ComputePipeline states_;
    std::unique_ptr<EditedField> edited_;
    std::vector<Staged> waiting_;
    OutgrownBuffers outgrown_; ///< of these
    std::vector<InFlight> slots_;
    std::vector<gpu::Buffer> spare_; ///< mapped memory that is not in use
};

} // namespace sward::render
