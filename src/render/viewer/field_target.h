#pragma once

#include "field/field.h"
#include "gpu/context/context.h"
#include "render/resolve/target_settings.h"
#include "render/viewer/field_renderer_settings.h"

namespace sward::render {

/// What the rasteriser's pipelines are made for: the settings, the device, and the shapes, folds
/// and plants that the field's species have.
TargetSettings targetFor(const gpu::DeviceContext& context, const field::FieldView& field,
                         const FieldRendererSettings& wanted);

} // namespace sward::render
