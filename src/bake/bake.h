#pragma once

#include "bake/report.h"
#include "bake/settings/settings.h"
#include "core/diagnostics.h"
#include "core/progress.h"
#include "field/field.h"
#include "terrain/ground_mesh.h"

#include <string>
#include <vector>

namespace sward::bake {

/// Result of a bake.
struct BakeResult {
    field::Field field; ///< the baked field
    Report report;      ///< the caller fills input.path, output, load and write times and
                        ///< peak memory
};

/// The masks for settings that name none, neither for all species nor for one: ground:green where
/// the colours of the bearing ground tell grass from bare ground (GreenShares::matter()), otherwise
/// none. Empty for other settings. `sward bake` applies it, and bakeField() does not.
std::vector<Mask> defaultMasks(const terrain::GroundMesh& ground, const BakeSettings& settings);

/// Grows a field on `ground`. `threads` 0: all threads of the machine. The result has the same
/// bytes for any number of threads. Throws Error{usage} for settings out of range, Error{input}
/// when more than maxBlades would grow, Error{interrupted} when cancelled. Warns when no root is
/// kept.
BakeResult bakeField(const terrain::GroundMesh& ground, const BakeSettings& settings, int threads,
                     Diagnostics& diagnostics, Progress& progress);

/// Estimates the report of bakeField() from at most 400 000 candidates. Counts and bytes are within
/// 5 %.
Report estimateBake(const terrain::GroundMesh& ground, const BakeSettings& settings, int threads,
                    Diagnostics& diagnostics, Progress& progress);

} // namespace sward::bake
