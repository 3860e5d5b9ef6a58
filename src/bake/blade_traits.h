#pragma once

#include "bake/clumps.h"
#include "bake/root_filter.h"
#include "bake/root_sample.h"
#include "bake/settings.h"
#include "shaders/shared/blade.h"
#include "terrain/ground_mesh.h"
#include "terrain/surface_query.h"

#include <optional>
#include <vector>

namespace sward::bake {

/// Gives a root the blade that stands on it: up-vector, facing, size, stiffness, species and tint,
/// each from the root's own random numbers and those of its clump. A blade of a tuft stands up to
/// half the tufts' spacing away from its root. Thread-safe; a function of the root, the settings
/// and what is within reachOf() alone.
class BladeGrower {
public:
    /// What is resolved once for the whole ground, of which the mesh may be a part.
    struct Whole {
        double scale = 1.0; ///< multiplies lengths
        double area = 0.0;  ///< [m²] bearingArea()
    };

    /// All must outlive it. `query` is of the whole scene and may be null unless settings ask for
    /// exposure or clearance (blades are then cut to the room over them) or growsTufts().
    BladeGrower(const terrain::GroundMesh& ground, const BakeSettings& settings, const Whole& whole,
                const RootFilter& filter, const terrain::SurfaceQuery* query);

    shared::Blade grow(const RootSample& root, float exposure) const;

private:
    RootSample gather(const RootSample& root, const SpeciesTraits& species,
                      const Clumps::Clump& tuft) const;
    double roomOver(const RootSample& root, glm::dvec3 up, double height) const;

    const terrain::GroundMesh& ground_;
    const BakeSettings& settings_;
    double scale_;
    const RootFilter& filter_;
    const terrain::SurfaceQuery* query_;
    bool colorsAreMask_;
    bool fitsOverhangs_; ///< by the settings alone: a part may have no need of rays
    Clumps clumps_;
    std::vector<std::optional<Clumps>> tufts_; ///< per species
};

/// Whether some species grows in tufts, which asks for a SurfaceQuery.
bool growsTufts(const Meadow& meadow);

} // namespace sward::bake
