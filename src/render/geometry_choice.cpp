#include "render/geometry_choice.h"

#include "core/error.h"
#include "render/raster_pass.h"

namespace sward::render {

Geometry chooseGeometry(const gpu::DeviceContext& context, const FieldRenderer::Settings& wanted)
{
    const char* obstacle = obstacleToRaster(context, wanted.colorFormat);
    if (wanted.geometry == Geometry::raster && obstacle != nullptr)
        fail(ErrorKind::unsupported, "{} cannot rasterise blades: {}", context.name, obstacle);
    if (wanted.geometry == Geometry::automatic)
        return obstacle == nullptr && !context.isCpu() ? Geometry::raster : Geometry::tessellation;
    return wanted.geometry;
}

const char* reasonForGeometry(const gpu::DeviceContext& context,
                              const FieldRenderer::Settings& wanted)
{
    if (wanted.geometry != Geometry::automatic)
        return "asked for";
    const char* obstacle = obstacleToRaster(context, wanted.colorFormat);
    if (obstacle != nullptr)
        return obstacle;
    return context.isCpu() ? "a CPU's compute shaders leave lanes idle: its tessellator is faster"
                           : "compute shaders draw blades faster than the tessellator";
}

} // namespace sward::render
