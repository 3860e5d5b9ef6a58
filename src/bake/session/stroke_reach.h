#pragma once

#include "bake/ground/tile_region.h"
#include "bake/paint/stroke_grid.h"
#include "bake/settings/stroke.h"

#include <set>
#include <span>
#include <vector>

namespace sward::bake {

/// Adds those of the `bearing` cells whose blades a stroke changes, by being added or removed.
/// `later`: strokes after it, which may look at what it changes. `tufts` [m]: largest spacing of
/// tufts; 0: none grow.
void addCellsReached(const Stroke& stroke, std::span<const Stroke> later, double tufts,
                     const std::set<CellNumber>& bearing, std::set<CellNumber>& reached);

/// The capsules of a stroke in the world, as wide as what it changes: `later` strokes may look at
/// it.
std::vector<StrokeSegment> capsulesReached(const Stroke& stroke, std::span<const Stroke> later);

/// Adds those of the `bearing` cells that a stroke's capsules may touch.
void addCellsTouched(const Stroke& stroke, const std::set<CellNumber>& bearing,
                     std::set<CellNumber>& touched);

} // namespace sward::bake
