#pragma once

#include "gpu/staged_upload.h"
#include "render/field/baked_blades.h"
#include "render/field/grass_cover.h"
#include "render/field/resident_field.h"
#include "render/frame.h"

namespace sward::render {

/// Members of a resident field.
struct ResidentField::Parts {
    Parts(const gpu::DeviceContext& deviceContext, const field::FieldView& field);

    const gpu::DeviceContext& context;
    gpu::StagedUpload upload; ///< declared before its targets
    BakedBlades blades;
    GrassCover cover;
    FieldShape shape;
    field::Defaults defaults;
};

} // namespace sward::render
