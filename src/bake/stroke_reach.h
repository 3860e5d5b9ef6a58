#pragma once

#include "bake/paint/stroke.h"
#include "bake/tile_region.h"

#include <set>
#include <span>

namespace sward::bake {

/// Adds those of the `bearing` cells whose blades a stroke changes, by being added or removed.
/// `later`: strokes after it, which may look at what it changes. `tufts` [m]: largest spacing of
/// tufts; 0: none grow.
void addCellsReached(const Stroke& stroke, std::span<const Stroke> later, double tufts,
                     const std::set<CellNumber>& bearing, std::set<CellNumber>& reached);

} // namespace sward::bake
