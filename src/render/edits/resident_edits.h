#pragma once

#include "field/delta.h"
#include "gpu/context/context.h"
#include "gpu/pipeline/shader_library.h"
#include "gpu/recording/recording.h"
#include "render/edits/field_edits.h"
#include "render/field/baked_blades.h"
#include "render/field/blade_states.h"
#include "render/field/grass_cover.h"
#include "render/field/outgrown.h"
#include "render/frame/frame.h"

#include <vulkan/vulkan.h>

#include <cstdint>
#include <memory>
#include <span>

namespace sward::render {

/// Edits of a resident field. The frames that are being recorded see the former field; the next one
/// that begins sees the edited one, and records what makes it so.
class ResidentEdits {
public:
    /// Members of the field, which must outlive this. `edited` must have filled the buffers.
    struct Field {
        BakedBlades& blades;
        GrassCover& cover;
        FieldShape& shape;
    };

    ResidentEdits(const gpu::DeviceContext& context, const gpu::ShaderLibrary& shaders,
                  std::unique_ptr<EditedField> edited, const Field& field,
                  std::uint32_t framesInFlight);

    std::uint32_t framesInFlight() const { return framesInFlight_; }

    /// The field after all edits.
    const EditedField& field() const { return edits_.field(); }

    /// See Grass::edit().
    void apply(const field::Delta& delta);

    /// Lets the field follow all edits so far. Throws Error{runtime} if there is not enough memory;
    /// the next call goes on.
    void begin();

    /// Records these edits, and moves the states of the field's instances. See FieldEdits.
    void record(const gpu::Recording& commands, std::span<const BladeStates* const> states,
                std::uint32_t settledAt, std::uint32_t slot);

    VkDeviceSize bytes() const { return edits_.bytes(); } ///< of mapped memory

private:
    const gpu::DeviceContext* context_;
    Field field_;
    FieldEdits edits_;
    ReplacedBuffers replaced_;
    std::uint32_t framesInFlight_;
    bool isBehind_ = false; ///< the field has not followed all edits
};

} // namespace sward::render
