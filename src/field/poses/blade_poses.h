#pragma once

#include "field/field.h"

#include <glm/vec3.hpp>

#include <filesystem>
#include <span>
#include <vector>

namespace sward::field {

/// The curve of a blade, a stalk or a ribbon on one.
struct BladePose {
    glm::vec3 v0{0.0f};   ///< control points [m], relative to the field's origin
    glm::vec3 v1{0.0f};   ///< likewise
    glm::vec3 v2{0.0f};   ///< likewise
    glm::vec3 axis{0.0f}; ///< unit, across
};

/// The blades of a field at rest, one pose each in the field's order: under the field's gravity and
/// recovery without wind, as `sward-view render` draws them with no wind. `threads` ≥ 1.
std::vector<BladePose> restingPoses(const FieldView& field, unsigned threads = 1);

/// The poses in a file of `sward-view render --dump-blades` of the same field, culled blades too.
/// Throws Error{io} if it cannot be read; Error{input} with the line if it is not such a file, or
/// is that of another field.
std::vector<BladePose> readPoses(const FieldView& field, const std::filesystem::path& path);

/// Sets the axis of each pose, whose control points are known: a blade's own, or how a ribbon
/// stands on the stalk before it. One pose for each blade.
void setAxes(const FieldView& field, std::span<BladePose> poses);

} // namespace sward::field
