#pragma once

namespace sward::render {

/// How blades are drawn.
enum class Geometry {
    automatic,    ///< raster on GPUs that can, into targets that allow it; else tessellation
    tessellation, ///< by the graphics pipeline
    raster,       ///< by compute shaders
};

} // namespace sward::render
