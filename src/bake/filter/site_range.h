#pragma once

#include "bake/settings/settings.h"
#include "terrain/ground_mesh.h"
#include "terrain/topology/surface_features.h"

#include <cstdint>

namespace sward::bake {

/// A part of a triangle side: the triangle of barycentrics (b, c), (b + size, c) and (b, c + size).
/// The whole side by default.
struct GroundPart {
    std::uint32_t triangle = 0; ///< index in the ground
    bool back = false;          ///< the triangle's back side
    double b = 0.0;
    double c = 0.0;
    double size = 1.0; ///< negative for inverted parts
};

/// Closed range of numbers.
struct Interval {
    double low = 0.0;
    double high = 0.0;
};

/// Ranges that contain the properties of every place of a part (Site), with room for rounding.
struct SiteRange {
    Interval upright{-1.0, 1.0}; ///< cosine of the slope
    Interval altitude;           ///< [m]
    Interval curvature;          ///< [1/m]; 0 without features
};

/// The ranges of a part. `features` may be null.
SiteRange siteRange(const terrain::GroundMesh& ground, const GroundUp& groundUp,
                    const terrain::SurfaceFeatures* features, const GroundPart& part);

} // namespace sward::bake
