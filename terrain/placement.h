#pragma once

#include "terrain/load.h"

#include <glm/mat4x4.hpp>

namespace sward::terrain {

/// Transform from file space to Sward's: rotates `upAxis` to Y (never mirrors), then applies units
/// and scale. Throws Error{usage} naming an unknown or out-of-range setting.
glm::dmat4 worldFromFile(const ImportSettings& settings);

/// Sets `bears` from the globs of `settings`. A glob may match a node's path, or the path or name
/// of any ancestor, so that it can name a group or a leaf. Warns of a glob that matches nothing.
void assignRoles(GroundMesh& mesh, const ImportSettings& settings, const std::string& place,
                 Diagnostics& diagnostics);

} // namespace sward::terrain
