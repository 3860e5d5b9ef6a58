#pragma once

#include "bake/blades/clumps.h"
#include "bake/filter/root_filter.h"
#include "bake/root_sample.h"
#include "bake/settings.h"
#include "shaders/shared/blade.h"
#include "terrain/ground_mesh.h"
#include "terrain/query/surface_query.h"

#include <optional>
#include <vector>

namespace sward::bake {

/// Makes the blade of a root: up-vector, facing, size, stiffness, species and tint. Each uses the
/// random numbers of the root and of its clump. A blade of a tuft stands up to half the tuft
/// spacing away from its root. Thread-safe. The blade depends only on the root, the settings and
/// the scene within reachOf().
class BladeGrower {
public:
    /// Values computed once for the whole ground; the mesh may be a part of it.
    struct Whole {
        double scale = 1.0;    ///< multiplies lengths
        double area = 0.0;     ///< [m²] bearingArea()
        double widening = 1.0; ///< factor on widths
    };

    /// All arguments must outlive it. `query` is of the whole scene; null unless settings use
    /// exposure or clearance (which shortens blades to the room above) or growsTufts().
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
    double widthScale_;
    const RootFilter& filter_;
    const terrain::SurfaceQuery* query_;
    bool colorsAreMask_;
    std::vector<glm::vec3> baseColors_; ///< per material, as drawn
    bool fitsOverhangs_; ///< from the settings; a part of the ground may need no rays
    Clumps clumps_;
    std::vector<std::optional<Clumps>> tufts_; ///< per species
};

/// Whether some species grows in tufts; this requires a SurfaceQuery.
bool growsTufts(const Meadow& meadow);

} // namespace sward::bake
