#pragma once

#include "field/field.h"
#include "shaders/shared/shape.h"

#include <compare>
#include <cstdint>

namespace sward::render {

/// What shaders may leave out for the species of a field: specialisation constants.
struct FieldLooks {
    bool mayFold = true;                          ///< there are folded blades
    bool mayHaveOrgans = true;                    ///< there are compound plants
    std::uint32_t onlyShape = shared::shapeCount; ///< of all blades, if they share one
    auto operator<=>(const FieldLooks&) const = default;
};

FieldLooks looksOf(const field::FieldView& field);

} // namespace sward::render
