#pragma once

#include "bake/blades/path_edges.h"
#include "bake/filter/crease_blend.h"
#include "bake/filter/exposure.h"
#include "bake/filter/root_filter.h"
#include "bake/ground/root_sample.h"
#include "bake/paint/box_tree.h"
#include "bake/paint/painted_parts.h"
#include "bake/settings/settings.h"
#include "field/seeds/seeds.h"
#include "shaders/shared/sow/seeds.h"
#include "terrain/ground_mesh.h"
#include "terrain/query/surface_query.h"
#include "terrain/topology/surface_features.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <optional>
#include <vector>

namespace sward::bake {

/// What rays find at a place.
struct SeedRays {
    Surroundings around;
    double room = 1.0;      ///< [0, 1] free height, in largest heights of a blade
    bool isBlocked = false; ///< an obstacle: nothing grows
};

/// What seeds say of places: the results of masks, filters and rays, as BladeGrower uses them.
/// Thread-safe.
class SeedSites {
public:
    /// All arguments must outlive it. `rays` may be null unless needsRays().
    SeedSites(const terrain::GroundMesh& ground, const BakeSettings& settings, double scale,
              const field::SeedMeadow& meadow, RootFilter& filter,
              const terrain::SurfaceQuery* rays, const terrain::SurfaceFeatures& features);

    /// Replaces the strokes, which must outlive it. Not thread-safe.
    void repaint(const Strokes& strokes);

    /// What strokes may change in a box.
    PaintedPart paintedIn(const DAabb& box) const { return painted_.in(box); }

    SeedRays raysAt(const RootSample& root) const;

    /// Conditions at a root of a part. Their density is that of the ground, without strokes: where
    /// these change it, bits say what grows.
    shared::SeedConditions at(const RootSample& root, const SeedRays& rays,
                              const PaintedPart& painted) const;

    /// Whether a root grows in a plain bake: masks, filters and strokes against its chance, then
    /// obstacles.
    bool grows(const RootSample& root) const;

    /// Whether a root grows for which only strokes ask that make the density at least `asks`,
    /// relative to the bake's.
    bool growsMore(const RootSample& root, double asks) const;

    /// Whether conditions may vary inside of a part of this triangle, in this box, in a way that
    /// samples of a few metres do not tell.
    bool varies(std::uint32_t triangle, const DAabb& part) const;

    /// Distance from bare ground within which it changes blades [m].
    static double bareReach(const BakeSettings& settings, double scale);

    /// The up-vector at a root far from creases, packed.
    std::uint32_t upAt(const RootSample& root) const;

    /// Packs a unit vector as shared::SeedVertex::up.
    static std::uint32_t pack(glm::dvec3 unit);

    /// The creases that may turn blades which grow both in the box `ground` and in the box `cell`,
    /// cut off where they cannot.
    std::vector<terrain::ConvexCrease> creasesNear(const DAabb& ground, DAabb cell) const;

    /// Moisture of the ground at a clump's centre, as shared::SeedClump.
    std::int32_t moistureOf(std::uint32_t triangle, glm::dvec3 place) const;

private:
    bool isCutOut(std::uint32_t triangle) const;

    const terrain::GroundMesh& ground_;
    const BakeSettings& settings_;
    const field::SeedMeadow& meadow_;
    RootFilter& filter_;
    const terrain::SurfaceQuery* rays_;
    double scale_;
    bool colorsAreMask_;
    bool fitsOverhangs_;
    bool filtersVary_;
    std::vector<glm::vec3> baseColors_;
    PathEdges paths_;
    CreaseBlend creases_;
    std::optional<Exposure> sky_;
    PaintedParts painted_;
    BoxTree bare_; ///< of bare triangles, with the ground that they change
};

} // namespace sward::bake
