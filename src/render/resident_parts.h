#pragma once

#include "gpu/staged_upload.h"
#include "render/baked_blades.h"
#include "render/frame.h"
#include "render/grass_cover.h"
#include "render/resident_field.h"

namespace sward::render {

/// What a resident field consists of.
struct ResidentField::Parts {
    Parts(const gpu::DeviceContext& deviceContext, const field::FieldView& field);

    const gpu::DeviceContext& context;
    gpu::StagedUpload upload; ///< before what it uploads to
    BakedBlades blades;
    GrassCover cover;
    FieldShape shape;
    field::Defaults defaults;
};

} // namespace sward::render
