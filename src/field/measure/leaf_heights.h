#pragma once

#include "field/field.h"
#include "shaders/shared/cover.h"

#include <array>

namespace sward::field {

/// Where the leaves of a field are: their area by height above the ground, with blades at rest.
struct LeafHeights {
    float mean = 0.0f; ///< [m] height of the blades or plants that the leaves belong to
    float top = 0.0f;  ///< [m] above which a thousandth of the area is; 0: there are no leaves
    float projection = 0.3f; ///< shared::leafProjectionOf()
    std::array<float, shared::heightSteps>
        above{}; ///< share of the area above i/heightSteps of top
};

/// Of some 20 000 blades that are spread evenly over the field.
LeafHeights leafHeightsOf(const FieldView& field);

/// Of a field that was bare and gets blades of this mean height: uprights that taper.
LeafHeights leafHeightsOf(float meanHeight);

/// Sets Cover::stepsPerMetre and leaves.
void describeHeights(const LeafHeights& heights, shared::Cover& cover);

} // namespace sward::field
