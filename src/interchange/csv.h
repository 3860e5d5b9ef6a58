#pragma once

#include "core/progress.h"
#include "field/field.h"
#include "interchange/export_settings.h"

#include <filesystem>

namespace sward::interchange {

/// Writes one row per blade, in the order of the field:
/// id,x,y,z,ux,uy,uz,facing,height,width,stiffness,species,exposure,tint_r,tint_g,tint_b,clump,patch.
/// Positions are in world space with nine decimals [m], other numbers have nine digits. Throws
/// Error{io}, Error{interrupted}.
void writeCsv(const field::FieldView& field, const std::filesystem::path& path,
              const ExportSettings& settings, Progress& progress);

} // namespace sward::interchange
