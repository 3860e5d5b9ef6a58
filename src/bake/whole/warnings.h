#pragma once

#include "bake/plan/plan.h"
#include "bake/report.h"
#include "bake/settings/settings.h"
#include "core/diagnostics.h"
#include "terrain/ground_mesh.h"

namespace sward::bake {

/// Warns of likely mistakes and names the option that fixes each: no or almost no root kept, or so
/// few expected by `plan` that there is none; roots on undersides; a border, a mask or an excluded
/// area (with a loaded mesh) that rejects nothing.
void warnAboutRoots(const RootCounts& counts, const Report::Input& ground,
                    const BakeSettings& settings, const Plan& plan, Diagnostics& diagnostics);

/// Warns of strokes that touch no ground, wholly or in a part, and of strokes that cannot raise the
/// density of Poisson disks.
void warnOfStrokes(const terrain::GroundMesh& ground, const BakeSettings& settings,
                   Diagnostics& diagnostics);

} // namespace sward::bake
