#pragma once

#include "bake/report.h"
#include "bake/settings.h"
#include "core/diagnostics.h"
#include "terrain/ground_mesh.h"

namespace sward::bake {

/// Warns of what users take for a defect, each with the option that mends it: no root kept, or next
/// to none; roots on undersides; a border, a mask or an excluded area that rejects nothing.
void warnAboutRoots(const RootCounts& counts, const terrain::GroundMesh& ground,
                    const BakeSettings& settings, Diagnostics& diagnostics);

} // namespace sward::bake
