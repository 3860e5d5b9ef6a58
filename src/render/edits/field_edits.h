#pragma once

#include "field/delta.h"
#include "gpu/context/context.h"
#include "gpu/memory/buffer.h"
#include "gpu/pipeline/compute_pipeline.h"
#include "gpu/pipeline/shader_library.h"
#include "gpu/recording/recording.h"
#include "render/field/baked_blades.h"
#include "render/field/blade_states.h"
#include "render/field/edited_field.h"
#include "render/field/grass_cover.h"
#include "render/frame/frame.h"

#include <vulkan/vulkan.h>

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace sward::render {

/// Edits of a field on the device: kept from a delta's arrival until the next frame records them.
/// A barrier separates them from the frames before, so no place waits for frames in flight; only
/// mapped memory and replaced buffers do.
class FieldEdits {
public:
    /// `edited` must have filled the buffers. Context and cover must outlive it.
    FieldEdits(const gpu::DeviceContext& context, const gpu::ShaderLibrary& shaders,
               std::unique_ptr<EditedField> edited, GrassCover& cover,
               std::uint32_t framesInFlight);

    const EditedField& field() const { return *edited_; }

    /// Copies what the delta changes into mapped memory. Before record() the caller lets buffers
    /// grow to the size of field(). Throws as EditedField::apply().
    void apply(const field::Delta& delta);

    /// Records all edits since the last call, with barriers from and to everything: of the field's
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
        VkDeviceSize sources = 0; ///< offsets of what the shader reads and writes
        VkDeviceSize patches = 0;
        VkDeviceSize times = 0;
        std::uint32_t sourceCount = 0;
        std::uint32_t patchCount = 0;
    };
    gpu::Buffer staging(VkDeviceSize bytes);
    Staged stage(const Edit& edit, PlaceRange coverCorners);
    void recordStates(const gpu::Recording& commands, const BladeStates& states,
                      const Staged& staged, std::uint32_t settledAt, bool isSecond) const;
    const gpu::Buffer& bufferOf(Table table, const BakedBlades& baked) const;

    const gpu::DeviceContext* context_;
    gpu::ComputePipeline states_;
    std::unique_ptr<EditedField> edited_;
    GrassCover* cover_;
    std::vector<Staged> waiting_;
    std::vector<std::vector<gpu::Buffer>> slots_; ///< mapped memory that their frames may read
    std::vector<gpu::Buffer> spare_;              ///< mapped memory that is not in use
};

/// Extends a field's content to the blades of an edit. A field that was bare gets the size of its
/// typical blade.
void followEdit(FieldShape& shape, const EditedField& edited);

} // namespace sward::render
