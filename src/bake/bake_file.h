#pragma once

#include "bake/report.h"
#include "bake/settings/settings.h"
#include "bake/whole/all_cells.h"
#include "core/diagnostics.h"
#include "core/progress.h"
#include "terrain/ground_mesh.h"

#include <filesystem>

namespace sward::bake {

/// Grows a field on `ground` and writes it to `path`: the bytes of field::writeField() after
/// bakeField(). Of a field in tiles, blades and keys wait in a nameless temporary file beside
/// `path`, 24 bytes a blade; in memory are those of one tile or two. Fills the report but for
/// input.path, load and total times and peak memory. Throws as bakeField() and writeField() do.
Report bakeIntoFile(const terrain::GroundMesh& ground, const BakeSettings& settings, int threads,
                    const std::filesystem::path& path, bool overwrite, Diagnostics& diagnostics,
                    Progress& progress, const TileLimits& limits = {});

/// The same of a ground that nothing needs afterwards: a large one takes less memory.
Report bakeIntoFile(terrain::GroundMesh&& ground, const BakeSettings& settings, int threads,
                    const std::filesystem::path& path, bool overwrite, Diagnostics& diagnostics,
                    Progress& progress, const TileLimits& limits = {});

} // namespace sward::bake
