#include "bake/whole/whole_plan.h"

#include "bake/filter/plain_masks.h"
#include "bake/plan/plan.h"
#include "bake/plan/root_source.h"
#include "bake/sample/surface_sampler.h"
#include "bake/whole/warnings.h"
#include "terrain/query/surface_query.h"
#include "terrain/topology/topology.h"

#include <algorithm>
#include <optional>

namespace sward::bake {

double extentOf(const terrain::GroundMesh& ground)
{
    const glm::vec3 size = ground.bounds().size();
    return double(std::max({size.x, size.y, size.z}));
}

terrain::SurfaceFeatures featuresOf(const terrain::GroundMesh& ground, const BakeSettings& settings)
{
    checkGround(ground, settings);
    const terrain::FeatureChoice choice = featuresFor(settings);
    terrain::SurfaceFeatures features;
    if (choice.any())
        features = findFeatures(ground, terrain::analyse(ground), choice);
    if (settings.meadow.edges.pathReach > 0.0)
        features.bareEdges = bareEdges(ground);
    if (settings.meadow.edges.creaseBlend > 0.0)
        features.creases = convexCreases(ground, {.front = settings.sides != Sides::back,
                                                  .back = settings.sides != Sides::front});
    return features;
}

BakePlan planWhole(const GroundView& whole, const BakeSettings& settings, Diagnostics& diagnostics,
                   Progress& progress)
{
    const terrain::GroundMesh& ground = whole.ground;
    warnOfPlainMasks(ground, settings, diagnostics);
    if (whole.features.seamVertices + whole.features.seamEdges > 0)
        diagnostics.warn("along seams {} vertices no farther apart than {:.3g} m, the precision of "
                         "the file's coordinates, are taken for one, and {} edges meet at "
                         "T-junctions: they are no border",
                         whole.features.seamVertices, ground.precision, whole.features.seamEdges);
    BakePlan plan;
    plan.plan =
        planBake(bearingArea(ground, settings.sides), extentOf(ground), settings, diagnostics);
    // A count and the area that bears Poisson disks sample the whole ground; some filters then need
    // rays.
    std::optional<terrain::SurfaceQuery> query;
    const bool samplesWhole = settings.count || settings.spread != Spread::uniform;
    const terrain::SurfaceQuery* rays = whole.rays;
    if (rays == nullptr && samplesWhole && filterNeedsRays(ground, settings))
        rays = &query.emplace(ground);
    // Strokes change the density that is planned without them.
    BakeSettings unpainted = settings;
    unpainted.strokes = {};
    const RootFilter filter(ground, unpainted, rays, &whole.features, plan.plan.scale);
    plan.roots = planRoots(ground, unpainted, filter, plan.plan, progress);
    warnOfStrokes(ground, settings, diagnostics);
    return plan;
}

} // namespace sward::bake
