#pragma once

#include "field/field.h"

#include <glm/vec3.hpp>

#include <filesystem>
#include <vector>

namespace sward::trace {

/// The curve of a blade, a stalk or a ribbon on one.
struct BladePose {
    glm::vec3 v0{0.0f};   ///< control points [m], relative to the field's origin
    glm::vec3 v1{0.0f};   ///< likewise
    glm::vec3 v2{0.0f};   ///< likewise
    glm::vec3 axis{0.0f}; ///< unit, across
};

/// The blades of a field at rest, one pose each in the field's order: under the field's gravity and
/// recovery without wind, as `sward-view render` draws them with no wind.
std::vector<BladePose> restingPoses(const field::FieldView& field);

/// The poses in a file of `sward-view render --dump-blades` of the same field, culled blades too.
/// Throws Error{io} if it cannot be read; Error{input} with the line if it is not such a file, or
/// is that of another field.
std::vector<BladePose> readPoses(const field::FieldView& field, const std::filesystem::path& path);

} // namespace sward::trace
