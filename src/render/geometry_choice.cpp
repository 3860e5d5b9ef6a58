#include "render/geometry_choice.h"

#include "core/error.h"
#include "render/large_blade_pass.h"
#include "render/raster_pass.h"

namespace sward::render {
namespace {

/// Why a device cannot draw a geometry; null if it can.
const char* obstacleTo(Geometry geometry, const gpu::DeviceContext& context,
                       const FieldRenderer::Settings& wanted)
{
    const char* obstacle =
        rasterises(geometry) ? obstacleToRaster(context, wanted.colorFormat) : nullptr;
    if (obstacle == nullptr && geometry == Geometry::hybrid)
        obstacle = obstacleToLargeBlades(context, wanted.samples);
    return obstacle;
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
    case Geometry::hybrid:
        return "hybrid";
    }
    return "unknown";
}

Geometry chooseGeometry(const gpu::DeviceContext& context, const FieldRenderer::Settings& wanted)
{
    const char* obstacle = obstacleTo(wanted.geometry, context, wanted);
    if (obstacle != nullptr)
        fail(ErrorKind::unsupported, "{} cannot draw blades by --geometry {}: {}", context.name,
             nameOf(wanted.geometry), obstacle);
    if (wanted.geometry != Geometry::automatic)
        return wanted.geometry;
    return obstacleTo(Geometry::raster, context, wanted) == nullptr ? Geometry::raster
                                                                    : Geometry::tessellation;
}

bool isTriedOut(const gpu::DeviceContext& context, const FieldRenderer::Settings& wanted)
{
    return wanted.geometry == Geometry::automatic &&
           chooseGeometry(context, wanted) == Geometry::raster &&
           obstacleTo(Geometry::hybrid, context, wanted) == nullptr &&
           context.timestampValidBits > 0 && !wanted.rastersForCpu.value_or(context.isCpu());
}

const char* reasonForGeometry(const gpu::DeviceContext& context,
                              const FieldRenderer::Settings& wanted)
{
    if (wanted.geometry != Geometry::automatic)
        return "asked for";
    const char* obstacle = obstacleToRaster(context, wanted.colorFormat);
    if (obstacle != nullptr)
        return obstacle;
    return context.isCpu()
               ? "compute shaders with a thread for each blade are faster than a CPU's tessellator"
               : "compute shaders draw blades faster than the tessellator";
}

} // namespace sward::render
