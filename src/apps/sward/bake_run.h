#pragma once

#include "apps/sward/options/bake_options.h"
#include "bake/report.h"
#include "core/diagnostics.h"
#include "core/progress.h"
#include "field/field.h"

namespace sward::apps {

/// What a bake does with its report and files, whoever asks for it.
struct BakeRun {
    bool tellsTopology = false;   ///< a debug message of the ground's topology, which takes time
    field::Field* kept = nullptr; ///< where the field goes if the request names no output
};

/// Loads the request's ground, bakes, and writes what the request names: field, report, image of
/// the strokes. A dry run only estimates. Checks the outputs before and after loading. Throws
/// Error as loadGround(), bake::bakeField() and field::writeField() do.
bake::Report runBake(BakeRequest& request, const BakeRun& run, Diagnostics& diagnostics,
                     Progress& progress);

} // namespace sward::apps
