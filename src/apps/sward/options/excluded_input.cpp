#include "apps/sward/options/excluded_input.h"

#include "apps/common/interrupt.h"

#include <utility>

namespace sward::apps {

void loadExcluded(BakeRequest& request, Diagnostics& diagnostics)
{
    // Ignore globs of bearing parts for these meshes.
    terrain::ImportSettings placing = request.import;
    placing.bearingNodes.clear();
    placing.bearingMaterials.clear();
    placing.bareNames = false;
    placing.occluderNodes.clear();
    for (bake::ExcludedArea& area : request.settings.excluded) {
        throwIfInterrupted("load");
        if (bake::takeMapArea(area))
            continue;
        terrain::GroundMesh mesh = terrain::load(area.file, placing, diagnostics);
        area.mesh = std::make_shared<const terrain::GroundMesh>(std::move(mesh));
    }
}

} // namespace sward::apps
