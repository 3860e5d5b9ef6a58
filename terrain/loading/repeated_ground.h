#pragma once

#include "core/diagnostics.h"
#include "terrain/ground_mesh.h"
#include "terrain/load.h"

#include <string>
#include <vector>

namespace sward::terrain {

/// Removes the triangles marked in `removed`, and vertices that no other uses.
void removeTriangles(GroundMesh& mesh, const std::vector<bool>& removed);

/// Removes coarser levels of detail that lie over the finest, told by names of nodes: NAME_LOD1
/// beside NAME_LOD0, or beside NAME; any case, after _ - . or a space. Keeps all if `settings` name
/// bearing nodes. Warns with number and names. `place` is the file.
void removeCoarseLevels(GroundMesh& mesh, const ImportSettings& settings, const std::string& place,
                        Diagnostics& diagnostics);

/// Removes nodes that are named as colliders, which are never seen: NAME-colonly, NAME-convcolonly,
/// UCX_NAME, UBX_NAME, USP_NAME, UCP_NAME. Keeps all if `settings` name bearing nodes, or if
/// nothing would be left. Warns as removeCoarseLevels().
void removeColliders(GroundMesh& mesh, const ImportSettings& settings, const std::string& place,
                     Diagnostics& diagnostics);

/// Removes bearing triangles whose corners and front equal those of an earlier bearing one: of
/// collision meshes and of files that are given twice, which would bear twice the density. Warns
/// with number, area and two names.
void removeCoincident(GroundMesh& mesh, Diagnostics& diagnostics);

} // namespace sward::terrain
