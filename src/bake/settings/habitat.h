#pragma once

#include "bake/mask/mask.h"
#include "bake/mask/soft_range.h"
#include "bake/report.h"

#include <vector>

namespace sward::bake {

/// Filters that depend only on the position.
struct Habitat {
    SoftRange slope{0.0, 180.0, 0.0}; ///< [degrees] from ground-up
    SoftRange altitude;               ///< [m] along ground-up (from the centre, if radial)
    SoftRange curvature;              ///< [1/m], mean; convex is positive
    std::vector<Mask> masks;          ///< multiplied

    bool needsSlope() const { return !slope.holds(0.0, 180.0); }
    bool needsAltitude() const { return !altitude.holds(-unbounded, unbounded); }
    bool needsCurvature() const { return !curvature.holds(-unbounded, unbounded); }
    bool needsGreen() const;
    bool needsAnything() const
    {
        return needsSlope() || needsAltitude() || needsCurvature() || !masks.empty();
    }
};

/// Properties of a root's position, computed once for all habitats.
struct Site {
    double upright = 1.0;   ///< cosine of the slope
    double altitude = 0.0;  ///< [m]
    double curvature = 0.0; ///< [1/m], of the root's triangle side
    double green = 1.0;     ///< GroundGreen::at(), if a mask needs it
};

/// A habitat prepared for millions of queries.
class HabitatWeight {
public:
    explicit HabitatWeight(const Habitat& habitat);

    const Habitat& habitat() const { return habitat_; }

    /// Share [0, 1] of the density at a root: the product of all factors. Stops when the product is
    /// `chance` or less and sets `reason` to the factor that caused it; else to the lowest factor
    /// below 1.
    double at(const terrain::GroundMesh& ground, const RootSample& root, const Site& site,
              double chance, Reject& reason) const;

private:
    double slopeWeight(double upright) const;

    Habitat habitat_;
    bool needsSlope_;
    bool needsAltitude_;
    bool needsCurvature_;
    double uprightLow_;  ///< cosines between which the slope has weight 1 …
    double uprightHigh_; ///< … without an arc cosine
};

} // namespace sward::bake
