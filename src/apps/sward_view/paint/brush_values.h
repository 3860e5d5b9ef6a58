#pragma once

#include "apps/sward_view/paint/stroke.h"

#include <array>

namespace sward::view {

/// A value of the brush that strokes of one kind have, and its control.
struct BrushValue {
    PaintKind kind;          ///< of the strokes
    const char* key;         ///< in a stroke file
    float Brush::*value;     ///< of the brush
    float min, max;          ///< as a stroke file bounds it (docs/painting.md)
    const char* name;        ///< of the control
    const char* format;      ///< of the number
    const char* explanation; ///< as a tooltip
};

/// All of them, in the order of the panel.
inline constexpr std::array<BrushValue, 6> brushValues{{
    {PaintKind::add, "ceiling", &Brush::ceiling, 0.0f, 8.0f, "Up to", "%.2f",
     "Density up to which grass is sown; 1 is the bake's"},
    {PaintKind::set, "density", &Brush::density, 0.0f, 8.0f, "Density", "%.2f",
     "Density that the stroke leaves; 1 is the bake's"},
    {PaintKind::height, "factor", &Brush::factor, 0.05f, 4.0f, "Height", "x %.2f",
     "Factor on the heights of blades"},
    {PaintKind::dryness, "share", &Brush::share, 0.0f, 1.0f, "Dry share", "%.2f",
     "Share of the blades that are dry"},
    {PaintKind::trodden, "height", &Brush::height, 0.05f, 1.0f, "Height left", "x %.2f",
     "Factor on the heights of trodden blades"},
    {PaintKind::trodden, "lean", &Brush::lean, 0.0f, 1.0f, "Lean", "%.2f",
     "How far blades lean along the stroke"},
}};

} // namespace sward::view
