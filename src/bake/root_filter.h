#pragma once

#include "bake/border_distance.h"
#include "bake/excluded_area.h"
#include "bake/exposure.h"
#include "bake/habitat.h"
#include "bake/occluder_test.h"
#include "bake/report.h"
#include "bake/root_sample.h"
#include "bake/settings.h"
#include "bake/species_mix.h"
#include "terrain/ground_mesh.h"
#include "terrain/surface_features.h"
#include "terrain/surface_query.h"

#include <optional>
#include <vector>

namespace sward::bake {

/// What a root's place offers to those that would grow there.
struct Stand {
    SpeciesShares shares; ///< of each species, by the rules of SpeciesMix
    PerSpecies vigour{};  ///< weight [0, 1] of everybody's filters and of the species' own habitat
};

/// Where grass grows: every mask and every filter, for one root at a time. Thread-safe; the answer
/// depends on the root, the settings and what stands within reachOf() alone.
class RootFilter {
public:
    /// All must outlive the filter. `query`, of the whole scene, may be null unless needsRays();
    /// `features` may be null unless featuresFor() names any. `scale` is that of the blades: what
    /// their exposure looks at shrinks with them.
    RootFilter(const terrain::GroundMesh& ground, const BakeSettings& settings,
               const terrain::SurfaceQuery* query,
               const terrain::SurfaceFeatures* features = nullptr, double scale = 1.0);

    /// False if every root of a bearing triangle passes without being asked.
    bool needsAnything() const { return weighs_ || needsObstacles_; }

    /// Share [0, 1] of the density that is wanted at a root: the product of masks, of filters with
    /// soft edges, and of what the species take. Stops as soon as the product is `chance` or less
    /// and sets `reason` to the factor that brought it there; a root drawn with a uniform `chance`
    /// is kept if the result is above it.
    double weigh(const RootSample& root, double chance, Reject& reason) const;

    /// What stands in the way of a blade by the tests that cast rays; none if it may stand.
    std::optional<Reject> obstacle(const RootSample& root) const;

    /// What a blade at a root may be.
    Stand standAt(const RootSample& root) const;

private:
    Site siteOf(const RootSample& root) const;
    double weighEverybody(const RootSample& root, const Site& site, double chance,
                          Reject& reason) const;
    glm::dvec3 groundUpAt(const RootSample& root) const;

    const terrain::GroundMesh& ground_;
    const BakeSettings& settings_;
    const terrain::SurfaceQuery* query_;
    const terrain::SurfaceFeatures* features_;
    double scale_;
    HabitatWeight everybody_;
    SpeciesMix mix_;
    std::optional<BorderDistance> border_;
    std::vector<Exclusion> excluded_;
    std::optional<OccluderTest> occluders_;
    std::optional<Exposure> sky_;
    bool weighs_ = false;
    bool needsSite_ = false;
    bool needsObstacles_ = false;
};

/// Whether some filter casts rays. Sky exposure of blades and the room over them come on top.
bool filterNeedsRays(const terrain::GroundMesh& ground, const BakeSettings& settings);

/// What the connections of the whole ground must tell: hand findFeatures() this.
terrain::FeatureChoice featuresFor(const BakeSettings& settings);

/// Throws Error{input} if the ground lacks what a setting asks for, as colours or texture
/// coordinates. To be asked of the whole ground.
void checkGround(const terrain::GroundMesh& ground, const BakeSettings& settings);

/// How far from a root what stands there may matter to it or its blade, [m]: rays, borders, clumps,
/// tufts. A part of the ground needs a halo of so much. `clumpSpacing` is the resolved one.
double reachOf(const terrain::GroundMesh& ground, const BakeSettings& settings, double scale,
               double clumpSpacing);

} // namespace sward::bake
