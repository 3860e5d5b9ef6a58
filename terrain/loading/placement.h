#pragma once

#include "terrain/load.h"

#include <glm/mat4x4.hpp>

#include <string>

namespace sward::terrain {

/// Transform from file space to Sward's: rotates `upAxis` to Y (never mirrors), then applies units
/// and scale. Throws Error{usage} naming an unknown or out-of-range setting.
glm::dmat4 worldFromFile(const ImportSettings& settings);

/// Ground that was made in metres with Y up, as if it came from a file of these settings. Roles are
/// not kept unless `worldFromFile` changes nothing.
GroundMesh placed(GroundMesh mesh, const glm::dmat4& worldFromFile, const std::string& name);

/// Sets `bears` from the globs of `settings`. A glob may match a node's path, or the path or name
/// of any ancestor, so that it can name a group or a leaf. Warns of a glob that matches nothing;
/// throws Error{input} if no node or no material is left to bear grass for that, unless `settings`
/// allow it.
void assignRoles(GroundMesh& mesh, const ImportSettings& settings, const std::string& place,
                 Diagnostics& diagnostics);

/// Why no part of the mesh is among those that `settings` let bear grass: the option, its globs,
/// and the mesh's own names. Empty if some part is.
std::string unmatchedGlobs(const GroundMesh& mesh, const ImportSettings& settings);

} // namespace sward::terrain
