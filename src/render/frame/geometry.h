#pragma once

namespace sward::render {

/// How blades are drawn.
enum class Geometry {
    automatic,    ///< raster if the device supports it, else tessellation
    tessellation, ///< by the graphics pipeline
    raster,       ///< by compute shaders
};

/// "auto", "tessellation" or "raster".
const char* nameOf(Geometry geometry);

} // namespace sward::render
