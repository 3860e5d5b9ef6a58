#pragma once

#include "gpu/context.h"
#include "render/field_renderer.h"

namespace sward::render {

/// The geometry that a device draws, never automatic: what the settings ask for, else raster where
/// `obstacleToRaster()` has none, else tessellation. Throws Error{unsupported} if the settings ask
/// for raster and the device cannot draw it.
Geometry chooseGeometry(const gpu::DeviceContext& context, const FieldRenderer::Settings& wanted);

/// The reason for that choice, in words.
const char* reasonForGeometry(const gpu::DeviceContext& context,
                              const FieldRenderer::Settings& wanted);

} // namespace sward::render
