#pragma once

#include "core/progress.h"
#include "field/field.h"
#include "interchange/export_settings.h"

#include <filesystem>

namespace sward::interchange {

/// Writes a USD layer as text (.usda), metres, Y up. /Field has the origin as a double-precision
/// translation, one PointInstancer per group of blades, and one prototype per species
/// (docs/exports.md has the attributes). Streams the blades group by group. Throws Error{io},
/// Error{interrupted}.
void writeUsda(const field::FieldView& field, const std::filesystem::path& path,
               const ExportSettings& settings, Progress& progress);

} // namespace sward::interchange
