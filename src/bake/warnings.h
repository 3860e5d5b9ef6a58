#pragma once

#include "bake/report.h"
#include "bake/settings.h"
#include "core/diagnostics.h"

namespace sward::bake {

/// Warns of what users take for a defect, each with the option that mends it: no root kept, or next
/// to none; roots on undersides; a border, a mask or an excluded area (whose mesh is there) that
/// rejects nothing.
void warnAboutRoots(const RootCounts& counts, const Report::Input& ground,
                    const BakeSettings& settings, Diagnostics& diagnostics);

} // namespace sward::bake
