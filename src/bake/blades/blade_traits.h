#pragma once

#include "bake/blades/blade_choice.h"
#include "bake/blades/clumps.h"
#include "bake/blades/path_edges.h"
#include "bake/blades/wide_variation.h"
#include "bake/filter/crease_blend.h"
#include "bake/filter/exposure.h"
#include "bake/filter/root_filter.h"
#include "bake/ground/root_sample.h"
#include "bake/patches/patch_header.h"
#include "bake/settings/settings.h"
#include "shaders/shared/blade.h"
#include "terrain/ground_mesh.h"
#include "terrain/query/surface_query.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace sward::bake {

/// Makes the blade of a root: up-vector, facing, size, stiffness, species and tint. Each uses the
/// random numbers of the root and of its clump. A blade of a tuft stands up to half the tuft
/// spacing away from its root. At the foot of occluders blades are higher, beside paths lower and
/// leaning away; a tuft opens from its middle to its rim, over dead blades. Thread-safe. The blade
/// depends only on the root, the settings and the scene within reachOf().
class BladeGrower {
public:
    /// Values computed once for the whole ground; the mesh may be a part of it.
    struct Whole {
        double scale = 1.0;    ///< multiplies lengths
        double area = 0.0;     ///< [m²] bearingArea()
        double widening = 1.0; ///< factor on widths
    };

    /// All arguments must outlive it. `query` is of the whole scene; null unless settings use
    /// exposure or clearance (which shortens blades to the room above) or growsTufts(). Without
    /// `features`, paths beside bare triangles and creases are not seen.
    BladeGrower(const terrain::GroundMesh& ground, const BakeSettings& settings, const Whole& whole,
                const RootFilter& filter, const terrain::SurfaceQuery* query,
                const terrain::SurfaceFeatures* features = nullptr);

    /// Clump and species of roots, for the functions below. See BladeChooser.
    void choose(std::span<const RootSample> roots, std::span<BladeChoice> choices) const;

    /// Number of blades at a root: 1, or more for a compound plant.
    std::uint32_t bladesOf(const BladeChoice& choice) const;

    /// The blade of a root, or the stalk of its plant.
    shared::Blade grow(const RootSample& root, const Surroundings& around) const;

    /// The same with its ribbons; bladesOf() many.
    void grow(const RootSample& root, const Surroundings& around, const BladeChoice& choice,
              std::span<GrownBlade> blades) const;

private:
    GrownBlade growBlade(const RootSample& root, const Surroundings& around,
                         const BladeChoice& choice) const;
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
    PathEdges paths_;
    CreaseBlend creases_;
    Clumps clumps_;
    WideVariation variation_;
    BladeChooser chooser_;
    std::vector<std::optional<Clumps>> tufts_; ///< per species
};

/// Whether some species grows in tufts; this requires a SurfaceQuery.
bool growsTufts(const Meadow& meadow);

} // namespace sward::bake
