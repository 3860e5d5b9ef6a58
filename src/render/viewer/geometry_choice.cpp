#include "render/viewer/geometry_choice.h"

#include "core/error.h"

namespace sward::render {

namespace {

/// Why blades cannot be rasterised by compute shaders into the targets; null if they can.
const char* obstacleToRaster(const gpu::DeviceContext& context,
                             const FieldRenderer::Settings& wanted)
{
    if (!context.features.bufferInt64Atomics)
        return "the device has no 64-bit atomics on buffers (shaderBufferInt64Atomics)";
    if (!wanted.keepsRadiance && wanted.colorFormat != VK_FORMAT_R8G8B8A8_SRGB &&
        wanted.colorFormat != VK_FORMAT_B8G8R8A8_SRGB)
        return "the target is neither R8G8B8A8_SRGB nor B8G8R8A8_SRGB";
    return nullptr;
}

} // namespace

const char* nameOf(Geometry geometry)
{
    switch (geometry) {
    case Geometry::automatic:
        return "auto";
    case Geometry::tessellation:
        return "tessellation";
    case Geometry::raster:
        return "raster";
    }
    return "unknown";
}

Geometry chooseGeometry(const gpu::DeviceContext& context, const FieldRenderer::Settings& wanted)
{
    if (wanted.geometry == Geometry::tessellation)
        return Geometry::tessellation;
    const char* obstacle = obstacleToRaster(context, wanted);
    if (obstacle == nullptr)
        return Geometry::raster;
    if (wanted.geometry == Geometry::raster)
        fail(ErrorKind::unsupported, "{} cannot draw blades by --geometry {}: {}", context.name,
             nameOf(wanted.geometry), obstacle);
    return Geometry::tessellation;
}

const char* reasonForGeometry(const gpu::DeviceContext& context,
                              const FieldRenderer::Settings& wanted)
{
    if (wanted.geometry != Geometry::automatic)
        return "asked for";
    const char* obstacle = obstacleToRaster(context, wanted);
    return obstacle != nullptr ? obstacle
                               : "compute shaders draw blades faster than the tessellator";
}

} // namespace sward::render
