#pragma once

#include "field/defaults.h"
#include "field/owned_field.h"
#include "gpu/memory/staged_upload.h"
#include "render/access.h"
#include "render/resident/device_field.h"
#include "render/resident/resident_field.h"

#include <memory>
#include <optional>

namespace sward::render {

/// Members of a resident field.
struct ResidentField::Parts {
    Parts(const gpu::DeviceContext& deviceContext, const field::FieldView& view,
          const FieldBudget& wanted);

    const gpu::DeviceContext& context;
    gpu::StagedUpload upload; ///< declared before its targets
    FieldBudget budget;
    DeviceField field;
    sward::field::Defaults defaults;
    std::optional<sward::field::OwnedField> source; ///< what streaming reads
    mutable std::weak_ptr<const void> grass; ///< what draws a field that is streamed or editable
};

} // namespace sward::render
