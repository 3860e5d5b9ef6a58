#pragma once

#include "bake/report.h"
#include "bake/settings/settings.h"
#include "bake/whole/all_cells.h"
#include "core/diagnostics.h"
#include "core/progress.h"
#include "field/field.h"
#include "terrain/ground_mesh.h"

#include <functional>

namespace sward::bake {

/// What happens to a bake's cells; called within the threads of the bake.
struct CellTakers {
    std::function<void(bool inTiles)> begin; ///< before the first tile
    TakeTile take;
    /// Lays the patches out in the field, which has everything but patches and blades.
    std::function<void(field::Field&& field)> finish;
    /// The ground itself, if nothing needs it afterwards: its vertices are freed for the field's.
    terrain::GroundMesh* consumed = nullptr;
};

/// The steps of every bake of a whole ground. Fills the report but for what only a file has.
/// Throws as bakeField() does.
Report bakeWhole(const terrain::GroundMesh& ground, const BakeSettings& settings, int threads,
                 const TileLimits& limits, const CellTakers& takers, Diagnostics& diagnostics,
                 Progress& progress);

} // namespace sward::bake
