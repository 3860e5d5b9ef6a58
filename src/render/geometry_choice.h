#pragma once

#include "gpu/context.h"
#include "render/field_renderer.h"

namespace sward::render {

/// How blades are drawn on a device, never automatic. Throws Error{unsupported} where a geometry is
/// asked for that it cannot draw.
Geometry chooseGeometry(const gpu::DeviceContext& context, const FieldRenderer::Settings& wanted);

/// Whether what is chosen is raster for a start, and may turn out to be hybrid.
bool isTriedOut(const gpu::DeviceContext& context, const FieldRenderer::Settings& wanted);

/// Why, in words.
const char* reasonForGeometry(const gpu::DeviceContext& context,
                              const FieldRenderer::Settings& wanted);

} // namespace sward::render
