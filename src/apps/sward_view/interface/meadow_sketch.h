#pragma once

#include "apps/sward_view/fields/meadow_species.h"
#include "apps/sward_view/interface/style.h"

#include <span>

namespace sward::view {

/// Draws a small picture of a meadow: blades of its species in their colours, as many as their
/// shares and as high as their heights say, and its flowers.
void drawMeadowSketch(ImDrawList& list, const Style& style, const ImVec2& low, const ImVec2& high,
                      std::span<const MeadowSpecies> species);

} // namespace sward::view
