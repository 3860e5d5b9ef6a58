#pragma once

#include "bake/report.h"
#include "bake/settings.h"
#include "bake/tiles/bake_tile.h"
#include "field/field.h"
#include "terrain/ground_mesh.h"

namespace sward::bake {

/// Makes a field without patches and blades.
field::Field fieldWithoutBlades(const terrain::GroundMesh& ground, const BakeSettings& settings,
                                const BakePlan& plan, const Report& report);

} // namespace sward::bake
