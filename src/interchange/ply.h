#pragma once

#include "core/progress.h"
#include "field/field.h"
#include "interchange/export_settings.h"

#include <filesystem>

namespace sward::interchange {

/// Writes a point cloud, binary little-endian PLY, one vertex per blade in the order of the field:
/// double x y z (world space [m]); float nx ny nz (up-vector), facing [rad], height, width [m],
/// stiffness, exposure; uchar red green blue (colour of the ground, sRGB), species, clump; double
/// id. Throws Error{io}, Error{interrupted}.
void writePly(const field::FieldView& field, const std::filesystem::path& path,
              const ExportSettings& settings, Progress& progress);

} // namespace sward::interchange
