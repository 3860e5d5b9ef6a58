#pragma once

#include "core/diagnostics.h"
#include "terrain/ground_mesh.h"
#include "terrain/load.h"

#include <string>

namespace sward::terrain {

/// Warns of ground from a mesh file that seems to lie on its side, or to be measured in smaller
/// units than metres, and names the option to try. Only what bears grass is looked at, and only
/// where the settings have not been touched. `hasUnits`: the format says itself that Y is up and
/// lengths are metres (glTF), so that much more is needed for a warning.
void warnOfImplausible(const GroundMesh& ground, const ImportSettings& settings, bool hasUnits,
                       const std::string& place, Diagnostics& diagnostics);

} // namespace sward::terrain
