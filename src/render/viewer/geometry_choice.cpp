#include "render/viewer/geometry_choice.h"

#include "core/error.h"
#include "render/viewer/viewer_raster.h"

namespace sward::render {

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
    const char* obstacle = obstacleToRaster(context, wanted.colorFormat);
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
    const char* obstacle = obstacleToRaster(context, wanted.colorFormat);
    return obstacle != nullptr ? obstacle
                               : "compute shaders draw blades faster than the tessellator";
}

} // namespace sward::render
