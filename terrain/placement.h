#pragma once

#include "terrain/load.h"

#include <glm/mat4x4.hpp>

namespace sward::terrain {

/// From a file's space into Sward's: turns `upAxis` to Y (a rotation, never a mirror), applies
/// units and scale. Throws Error{usage} naming a setting that is not known or out of range.
glm::dmat4 worldFromFile(const ImportSettings& settings);

/// Sets `bears` from the globs of `settings`. A glob may match a node's path, or the path or name
/// of any of its ancestors, so that a group is named as easily as a leaf. Warns of a glob that
/// matches nothing.
void assignRoles(GroundMesh& mesh, const ImportSettings& settings, const std::string& place,
                 Diagnostics& diagnostics);

} // namespace sward::terrain
