#pragma once

#include "field/field.h"

namespace sward::render {

/// Exposure that shows a field under the usual sun and sky of FrameSettings as a photographer
/// would: the meadow, or the ground of a field without blades, with a mean luminance of about 18 %
/// grey in the picture; lower where that would clip the brightest hundredth of the ground. In
/// [0.25, 4]. Depends on the field's colours alone, so it is the same in every frame, and a sun or
/// sky that is set is as bright as it says.
float chosenExposure(const field::FieldView& field);

} // namespace sward::render
