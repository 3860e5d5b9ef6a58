#pragma once

#include "core/progress.h"
#include "field/field.h"
#include "interchange/export_settings.h"

#include <filesystem>

namespace sward::interchange {

/// Writes a USD layer as text (.usda), metres, Y up: /Field holds the origin as a translation in
/// double precision, one PointInstancer for each group of blades below it, and one prototype for
/// each species (docs/exports.md has the attributes). Blades are streamed group by group. Throws
/// Error{io}, Error{interrupted}.
void writeUsda(const field::FieldView& field, const std::filesystem::path& path,
               const ExportSettings& settings, Progress& progress);

} // namespace sward::interchange
