#pragma once

#include "bake/report.h"
#include "bake/settings/settings.h"
#include "bake/tiles/bake_tile.h"
#include "field/field.h"
#include "terrain/ground_mesh.h"

#include <string>
#include <vector>

namespace sward::bake {

/// What a field says of its making: tool, input, scale and settings, as JSON.
std::string provenanceOf(const BakeSettings& settings, const Report& report);

/// The species of the fields of a meadow.
std::vector<field::Species> fieldSpecies(const Meadow& meadow);

/// Makes a field without patches and blades.
field::Field fieldWithoutBlades(const terrain::GroundMesh& ground, const BakeSettings& settings,
                                const BakePlan& plan, const Report& report);

/// The same of a ground that nothing needs afterwards; its vertices and triangles are freed.
field::Field fieldWithoutBlades(terrain::GroundMesh&& ground, const BakeSettings& settings,
                                const BakePlan& plan, const Report& report);

} // namespace sward::bake
