#pragma once

#include "bake/report.h"
#include "bake/settings.h"
#include "core/diagnostics.h"
#include "core/progress.h"
#include "field/field.h"
#include "terrain/ground_mesh.h"

#include <string>

namespace sward::bake {

/// What grew, and how.
struct BakeResult {
    field::Field field; ///< what grew
    Report report; ///< input.path, output, load and write times and peak memory are the caller's to
                   ///< fill
};

/// Grows a field on `ground`. `threads` 0: as many as the machine has; the result is the same bytes
/// for any number. Throws Error{usage} for settings out of range, Error{input} when more than
/// maxBlades would grow, Error{interrupted} when cancelled. No root kept is a warning, not an
/// error.
BakeResult bakeField(const terrain::GroundMesh& ground, const BakeSettings& settings, int threads,
                     Diagnostics& diagnostics, Progress& progress);

/// What bakeField() would report, from a sample of at most 400 000 candidates: counts and bytes
/// within 5 %.
Report estimateBake(const terrain::GroundMesh& ground, const BakeSettings& settings, int threads,
                    Diagnostics& diagnostics, Progress& progress);

} // namespace sward::bake
