#pragma once

#include "interchange/blade_mesh.h"

#include <string>

namespace sward::interchange {

/// The prim /Field/Blades/`name`: an Xform with mesh (displayColor from root to tip) and material,
/// a UsdPreviewSurface of the mean colour. `name` must be an identifier.
std::string usdBlade(const std::string& name, const BladeMesh& mesh,
                     const shared::Species& species);

} // namespace sward::interchange
