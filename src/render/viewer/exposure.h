#pragma once

#include "field/field.h"
#include "field/measure/leaf_area.h"

namespace sward::render {

/// Exposure that shows a field under the usual sun and sky of FrameSettings as a photographer
/// would. The meadow, or the ground of a field without blades, has a mean luminance of about 18 %
/// grey in the picture. Ground that is seen between and beside the grass counts by its area: where
/// it is brighter than the leaves, the exposure is lowered by half of the stops that a mean over
/// all that is seen would take. The brightest hundredth of what is seen stays below 85 %. In
/// [0.25, 4]. Depends on the field's colours alone, so it is the same in every frame, and a sun or
/// sky that is set is as bright as it says. `grass`: field::leafAreaOf() the field.
float chosenExposure(const field::FieldView& field, const field::LeafAreaGrid& grass);

} // namespace sward::render
