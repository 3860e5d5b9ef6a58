#pragma once

#include "core/bounds.h"
#include "interchange/tiles/georeference.h"

#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include <vector>

namespace sward::interchange {

/// Bends the flat world of a map onto the Earth. Places are told relative to the field's origin in
/// the axes of the field, x to the east, y up and z to the south of the map. In its middle the bent
/// field touches the flat one. Interpolates between knots at least 512 m apart, bicubically:
/// moved() is within 0.1 mm of MapToEarth for projections as smooth as those of maps, in fields of
/// up to 1 000 km.
class EarthBend {
public:
    /// `roots` bounds the places that will be asked for. Throws Error{input} naming the map's
    /// system if some of them are nowhere on the Earth, and what `degreesOf` throws.
    EarthBend(const MapToEarth& map, const glm::dvec3& origin, const DAabb& roots);

    /// A bent place.
    glm::dvec3 moved(const glm::dvec3& place) const;

    /// A box that holds all bent places of `box`.
    DAabb moved(const DAabb& box) const;

    /// How something upright is turned at a place.
    glm::dquat turn(const glm::dvec3& place) const;

    /// From bent places to earth-centred ones (EPSG:4978) [m]; a turn and a shift.
    const glm::dmat4& toEarth() const { return toEarth_; }

private:
    struct Knot {
        glm::dvec3 ground{0.0}; ///< bent place of height 0
        glm::dvec3 up{0.0};     ///< bent height of 1 m
        glm::dvec3 turn{0.0};   ///< vector part of turn()
    };
    struct Cell {
        std::size_t first; ///< knot at its corner of least x and z
        double x, z;       ///< place in it, 0 to 1
    };

    Cell cellOf(const glm::dvec3& place) const;
    void turnKnots();

    double step_ = 0.0;       ///< between knots [m]
    double lowX_ = 0.0;       ///< of the first knot [m]
    double lowZ_ = 0.0;       ///< of the first knot [m]
    std::size_t columns_ = 0; ///< along x
    std::size_t rows_ = 0;    ///< along z
    std::vector<Knot> knots_; ///< row by row
    double curvature_ = 0.0;  ///< largest second derivative [1/m]
    glm::dmat4 toEarth_{1.0};
};

} // namespace sward::interchange
