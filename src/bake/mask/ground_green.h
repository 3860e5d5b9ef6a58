#pragma once

#include "bake/ground/root_sample.h"
#include "terrain/ground_mesh.h"

#include <optional>

namespace sward::bake {

/// Share [0, 1] of grass that ground of a colour bears. `color`: as stored in images (sRGB),
/// [0, 1]. With hue H [degrees], saturation S and value V of HSV:
/// * 1 for H 62 to 160, falling to 0 at 50 and 175, if S ≥ 0.25, falling to 0 at S = 0.12;
/// * 0.2 (brown earth) for H 20 to 50, falling to 0 at 10 and 60, if S ≥ 0.45, falling to 0 at
///   0.3, and V ≤ 0.55, falling to 0 at 0.7.
/// The greater of both counts, so that grey, white, sand, rust and blue bear nothing.
double greenWeight(glm::dvec3 color);

/// greenWeight() of the ground's own colour: its material's image times the base colour, and vertex
/// colours where there is no image. The image is averaged over a square of 0.5 m times the blade
/// scale around a root, by 16 samples, so that no blade follows a single texel.
/// Thread-safe.
class GroundGreen {
public:
    /// The ground must outlive it. `scale`: of blades. `colorsAreMask`: vertex colours are no
    /// colours.
    GroundGreen(const terrain::GroundMesh& ground, double scale, bool colorsAreMask);

    double at(const RootSample& root) const;

private:
    glm::dvec3 imageAround(const RootSample& root, const terrain::GroundMaterial& material) const;

    const terrain::GroundMesh& ground_;
    double halfWidth_; ///< [m] of the square
    bool colorsAreMask_;
};

/// Whether some bearing ground has an image, shown vertex colours or a material whose base colour
/// somebody chose: neither Sward's own earth nor a neutral light grey or white.
bool hasOwnColors(const terrain::GroundMesh& ground, bool colorsAreMask);

/// Shares [0, 1] of the area of bearing ground.
struct GreenShares {
    double green = 0.0; ///< greenWeight() ≥ 0.5
    double bare = 0.0;  ///< greenWeight() < 0.25

    /// Whether colours tell grass from bare ground: at least 0.1 of each, and 0.75 of both. Shades
    /// from green to brown that run into each other do not.
    bool matter() const { return green >= 0.1 && bare >= 0.1 && green + bare >= 0.75; }
};

/// Estimates the shares from 16384 places, within 0.01 (standard error below 0.004). None without
/// hasOwnColors().
std::optional<GreenShares> greenShares(const terrain::GroundMesh& ground, double scale,
                                       bool colorsAreMask);

} // namespace sward::bake
