#pragma once

#include "bake/filter/border_distance.h"
#include "bake/filter/exposure.h"
#include "bake/filter/occluder_test.h"
#include "bake/filter/species_mix.h"
#include "bake/filter/weight_bound.h"
#include "bake/ground/root_sample.h"
#include "bake/mask/cutout.h"
#include "bake/mask/excluded_area.h"
#include "bake/mask/ground_green.h"
#include "bake/paint/painting.h"
#include "bake/report.h"
#include "bake/settings/habitat.h"
#include "bake/settings/settings.h"
#include "terrain/ground_mesh.h"
#include "terrain/query/surface_query.h"
#include "terrain/topology/surface_features.h"

#include <optional>
#include <vector>

namespace sward::bake {

/// Growing conditions at a root.
struct Stand {
    SpeciesShares shares; ///< of each species, by the rules of SpeciesMix
    PerSpecies vigour{};  ///< weight [0, 1] of common filters times the species' habitat
    double weight = 1.0;  ///< share [0, 1] of the density, as from RootFilter::weigh()
    double raised = 0.0;  ///< share [0, 1] of what that lacks which strokes give back
};

/// All masks and filters, evaluated for one root at a time. Thread-safe. The result depends only on
/// the root, the settings and the scene within reachOf().
class RootFilter {
public:
    /// All arguments must outlive the filter. `query` covers the whole scene and may be null unless
    /// needsRays(). `features` may be null unless featuresFor() names any. `scale` is the blade
    /// scale; it scales the exposure rays.
    RootFilter(const terrain::GroundMesh& ground, const BakeSettings& settings,
               const terrain::SurfaceQuery* query,
               const terrain::SurfaceFeatures* features = nullptr, double scale = 1.0);

    /// False if every root of a bearing triangle passes without a test.
    bool needsAnything() const { return weighs_ || needsObstacles_; }

    /// Share [0, 1] of the density at a root: the product of masks, soft filters and species
    /// shares. Stops when the product is `chance` or less and sets `reason` to the factor that
    /// caused it. A root with a uniform random `chance` is kept if the result is above `chance`.
    double weigh(const RootSample& root, double chance, Reject& reason) const;

    /// The strokes near the ground; null without any. Only the next two functions and standAt()
    /// know of them.
    const Painting* painting() const { return painting_ ? &*painting_ : nullptr; }

    /// Density at a root relative to the bake's, strokes included; may be above 1. As weigh() if
    /// no stroke reaches the root. If the result is `chance` or less, sets `reason`.
    double paintedDensity(const RootSample& root, double chance, Reject& reason) const;

    /// How strokes change a blade.
    PaintedLook lookAt(const RootSample& root) const
    {
        return painting_ ? painting_->lookAt(root.position, root.normal) : PaintedLook();
    }

    /// Bounds of weigh() on parts of the ground.
    const WeightBounds& bounds() const { return bounds_; }

    /// Runs the tests that cast rays. Returns the reason for a rejection, or none.
    std::optional<Reject> obstacle(const RootSample& root) const;

    /// Growing conditions for a blade at a root; without strokes unless `paints`.
    Stand standAt(const RootSample& root, bool paints = true) const;

    /// Replaces all strokes; they must outlive the filter. Not thread-safe.
    void repaint(const Strokes& strokes);

private:
    Site siteOf(const RootSample& root) const;
    double weighEverybody(const RootSample& root, const Site& site, double chance,
                          Reject& reason) const;
    glm::dvec3 groundUpAt(const RootSample& root) const;
    void paintStand(const RootSample& root, Stand& stand) const;

    const terrain::GroundMesh& ground_;
    const BakeSettings& settings_;
    const terrain::SurfaceQuery* query_;
    const terrain::SurfaceFeatures* features_;
    double scale_;
    HabitatWeight everybody_;
    SpeciesMix mix_;
    WeightBounds bounds_;
    Cutout cutout_;
    std::optional<GroundGreen> green_;
    std::optional<BorderDistance> border_;
    std::vector<Exclusion> excluded_;
    std::optional<OccluderTest> occluders_;
    std::optional<Exposure> sky_;
    std::optional<Painting> painting_;
    bool weighs_ = false;
    bool needsSite_ = false;
    bool needsObstacles_ = false;
};

/// Whether some filter casts rays. Ignores blade exposure and the room above blades.
bool filterNeedsRays(const terrain::GroundMesh& ground, const BakeSettings& settings);

/// Features of the whole ground that the filters use; pass this to findFeatures().
terrain::FeatureChoice featuresFor(const BakeSettings& settings);

/// Throws Error{input} if the ground lacks what a setting needs, such as colours or texture
/// coordinates. Call it with the whole ground.
void checkGround(const terrain::GroundMesh& ground, const BakeSettings& settings);

/// Largest distance [m] at which the scene affects a root or its blade: rays, borders, clumps,
/// tufts. A part of the ground needs a halo of this width. `clumpSpacing` is the resolved one.
double reachOf(const terrain::GroundMesh& ground, const BakeSettings& settings, double scale,
               double clumpSpacing);

} // namespace sward::bake
