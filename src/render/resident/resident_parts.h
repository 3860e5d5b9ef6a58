#pragma once

#include "field/field.h"
#include "gpu/memory/staged_upload.h"
#include "render/access.h"
#include "render/field/baked_blades.h"
#include "render/field/field_looks.h"
#include "render/field/grass_cover.h"
#include "render/frame/frame.h"
#include "render/edits/resident_edits.h"
#include "render/resident/resident_field.h"
#include "render/streaming/streaming.h"

#include <memory>
#include <optional>

namespace sward::render {

/// Members of a resident field.
struct ResidentField::Parts {
    Parts(const gpu::DeviceContext& deviceContext, const field::FieldView& field,
          const FieldBudget& wanted);

    const gpu::DeviceContext& context;
    gpu::StagedUpload upload; ///< declared before its targets
    GrassCover cover;
    FieldBudget budget;
    std::unique_ptr<EditedField> edited; ///< until `edits` takes it
    BakedBlades blades;
    FieldShape shape;
    FieldLooks looks;
    field::Defaults defaults;
    std::optional<field::OwnedField> source; ///< what `streaming` reads
    std::unique_ptr<Streaming> streaming;    ///< if not all blades are resident
    std::unique_ptr<ResidentEdits> edits;    ///< if it is editable
    mutable std::weak_ptr<const void> grass; ///< what draws a field that is streamed or editable
};

} // namespace sward::render
