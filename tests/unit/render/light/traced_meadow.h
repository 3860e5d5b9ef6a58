#pragma once

#include "field/field.h"
#include "field/measure/leaf_area.h"
#include "terrain/query/surface_query.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace sward::test {

/// A view of a meadow around the origin, by its middle pixel.
struct MeadowView {
    std::string name;
    double eyeHeight; ///< [m] above the ground
    double pitch;     ///< [degrees] below the horizon
    double fov;       ///< [degrees] side of the square picture
};

/// A place of a blade that an eye sees.
struct SeenPlace {
    std::uint32_t pixel; ///< places of one pixel follow each other
    glm::dvec3 position; ///< [m]
    glm::dvec3 normal;   ///< unit, of the seen side of the flat blade
    double along;        ///< [0, 1] of the blade
    double height;       ///< [m] above the ground
    double leafArea;     ///< leaf area index at the blade's root, by leafAreaAt()
    double shareAbove;   ///< share of the meadow's leaf area above `height`
    double shaderShare;  ///< the same by leafShareAbove()
    double translucency; ///< of the species
};

/// A built-in meadow on a level square around the origin, its blades at rest and without wind as
/// triangles, so that rays say what light reaches them.
class TracedMeadow {
public:
    /// `density` [1/m²], `side` [m] of the square.
    TracedMeadow(const std::string& meadow, double density, double side);

    /// The places that `pixels` random pixels of a view show, `samples` of each at most: those that
    /// show the ground are left out. The eye looks along −z.
    std::vector<SeenPlace> seenFrom(const MeadowView& view, double pixelSize, std::size_t pixels,
                                    std::size_t samples) const;

    /// Whether no blade and no ground lies between a place and the sky in a unit direction.
    bool seesSky(const glm::dvec3& place, const glm::dvec3& direction) const;

    /// leafProjectionOf() its cover.
    float shaderProjection() const { return shared::leafProjectionOf(grid_.shape); }

    double leafAreaIndex() const { return leafArea_; }   ///< m² of blade per m² of ground
    double topHeight() const { return heights_.back(); } ///< [m] of the highest place

    /// Mean |normal · direction| over the meadow's leaf area: the projection G of its blades.
    double projection(const glm::dvec3& direction) const;

    /// Share of the meadow's leaf area above a height [m] over the ground.
    double shareAbove(double height) const;

private:
    struct Part {
        std::uint32_t blade;
        float low; ///< along the blade
        float high;
    };

    struct Traced {
        glm::vec3 grass; ///< grassAt() its root
        float translucency;
        glm::vec3 v0, v1, v2;
    };

    void addBlade(const field::Field& field, const std::vector<shared::Organ>& organs,
                  const shared::Blade& blade, glm::vec3 grass, std::vector<glm::vec3>& corners,
                  std::vector<glm::uvec3>& triangles,
                  std::vector<std::pair<double, double>>& areas);

    std::vector<Traced> blades_;
    std::vector<Part> parts_; ///< one for two triangles
    std::vector<glm::vec3> corners_;
    std::vector<double> heights_; ///< [m] ascending …
    std::vector<double> below_;   ///< … and the share of leaf area below each
    double leafArea_ = 0.0;
    field::LeafAreaGrid grid_;
    std::optional<terrain::SurfaceQuery> rays_;
};

} // namespace sward::test
