#pragma once

#include "bake/mask.h"
#include "bake/report.h"
#include "bake/soft_range.h"

#include <vector>

namespace sward::bake {

/// Where something grows, by what is asked of the place alone.
struct Habitat {
    SoftRange slope{0.0, 180.0, 0.0}; ///< [degrees] from ground-up
    SoftRange altitude;               ///< [m] along ground-up (from the centre, if radial)
    SoftRange curvature;              ///< [1/m], mean; convex is positive
    std::vector<Mask> masks;          ///< multiplied

    bool needsSlope() const { return !slope.holds(0.0, 180.0); }
    bool needsAltitude() const { return !altitude.holds(-unbounded, unbounded); }
    bool needsCurvature() const { return !curvature.holds(-unbounded, unbounded); }
    bool needsAnything() const
    {
        return needsSlope() || needsAltitude() || needsCurvature() || !masks.empty();
    }
};

/// What is asked about a root's place, worked out once for everybody who asks.
struct Site {
    double upright = 1.0;   ///< cosine of the slope
    double altitude = 0.0;  ///< [m]
    double curvature = 0.0; ///< [1/m], of the side the root is on
};

/// A habitat made ready for millions of questions.
class HabitatWeight {
public:
    explicit HabitatWeight(const Habitat& habitat);

    const Habitat& habitat() const { return habitat_; }

    /// Share [0, 1] of the density that grows at a root: the product of all factors. Stops as soon
    /// as it is `chance` or less, and sets `reason` to the factor that brought it there; else to
    /// the lowest one below 1.
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
