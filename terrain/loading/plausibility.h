#pragma once

#include "core/diagnostics.h"
#include "terrain/ground_mesh.h"
#include "terrain/load.h"

#include <string>

namespace sward::terrain {

/// Warns of ground from a mesh file that seems to lie on its side, or to use smaller units than
/// metres, and names the option to try. Tests only bearing triangles, and only if the settings are
/// at their defaults. `hasUnits`: the format defines Y up and metres (glTF), so the thresholds are
/// higher.
void warnOfImplausible(const GroundMesh& ground, const ImportSettings& settings, bool hasUnits,
                       const std::string& place, Diagnostics& diagnostics);

} // namespace sward::terrain
