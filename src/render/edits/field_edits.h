#pragma once

#include "field/delta.h"
#include "gpu/context/context.h"
#include "gpu/pipeline/shader_library.h"
#include "gpu/recording/recording.h"
#include "render/edits/staged_edits.h"
#include "render/field/baked_blades.h"
#include "render/field/blade_states.h"
#include "render/field/edited_field.h"
#include "render/field/grass_cover.h"
#include "render/frame/frame.h"

#include <vulkan/vulkan.h>

#include <cstdint>
#include <memory>
#include <span>

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

    VkDeviceSize bytes() const { return staged_.bytes(); } ///< of mapped memory

private:
    std::unique_ptr<EditedField> edited_;
    GrassCover* cover_;
    StagedEdits staged_;
};

/// Extends a field's content to the blades of an edit. A field that was bare gets the size of its
/// typical blade.
void followEdit(FieldShape& shape, const EditedField& edited);

} // namespace sward::render
