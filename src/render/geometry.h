#pragma once

namespace sward::render {

/// How blades are drawn.
enum class Geometry {
    automatic,    ///< raster or hybrid on GPUs that can, by their measured times; else tessellation
    tessellation, ///< by the graphics pipeline
    raster,       ///< by compute shaders
    hybrid,       ///< by compute shaders, but for large blades: those by the graphics pipeline
};

/// "auto", "tessellation", "raster" or "hybrid".
const char* nameOf(Geometry geometry);

/// Whether compute shaders draw, with or without the graphics pipeline beside them.
constexpr bool rasterises(Geometry geometry)
{
    return geometry == Geometry::raster || geometry == Geometry::hybrid;
}

} // namespace sward::render
