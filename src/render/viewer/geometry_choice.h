#pragma once

#include "gpu/context/context.h"
#include "render/viewer/field_renderer.h"

namespace sward::render {

/// The geometry used on a device, never automatic: the requested one, else raster if
/// `obstacleToRaster()` returns null, else tessellation. Throws Error{unsupported} if raster is
/// requested and the device cannot draw it.
Geometry chooseGeometry(const gpu::DeviceContext& context, const FieldRenderer::Settings& wanted);

/// The reason for that choice, in words.
const char* reasonForGeometry(const gpu::DeviceContext& context,
                              const FieldRenderer::Settings& wanted);

} // namespace sward::render
