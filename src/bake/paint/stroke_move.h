#pragma once

#include "bake/settings/settings.h"
#include "bake/settings/stroke.h"
#include "terrain/ground_mesh.h"

#include <cstddef>
#include <span>
#include <vector>

namespace sward::bake {

/// Strokes after they were moved onto a ground.
struct MovedStrokes {
    std::vector<Stroke> list;       ///< all, in their order
    std::vector<std::size_t> moved; ///< numbers of the strokes that differ from before
    std::size_t points = 0;         ///< that were moved
    double farthest = 0.0;          ///< [m] that one of them was moved
};

/// Moves each point that is not on the ground (2 mm) onto it: along the stroke's normal there,
/// forwards or backwards, to the nearest surface that faces its way; else, and without normals, to
/// the nearest point of the ground. Points that are farther than `distance` [m] from it stay.
/// Points are added between two of a stroke where these are moved or the stroke has touched no
/// ground, if the ground there is farther than half the radius from the line between them. Normals
/// stay. Only triangles that bear grass count. Depends on nothing but its arguments.
MovedStrokes moveOnto(const terrain::GroundMesh& ground, Sides sides,
                      std::span<const Stroke> strokes, double distance);

} // namespace sward::bake
