#pragma once

#include "bake/excluded_area.h"
#include "bake/mask.h"
#include "bake/meadow.h"
#include "bake/soft_range.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace sward::bake {

/// Which side of a triangle bears grass. The front is where its corners turn anti-clockwise.
enum class Sides { front, back, both };

/// How roots are spread: independently but for stratification; or as Poisson disks, no two nearer
/// than a spacing; or as Poisson disks packed as densely as chance allows.
enum class Spread { uniform, poisson, poissonDense };

/// Where blades grow to: 0 along the surface's normal, 1 against gravity (ground-up), or between.
struct Alignment {
    double vertical = 0.0; ///< [0, 1]
};

/// What slope is measured from, and what gravity pulls against.
struct GroundUp {
    glm::dvec3 direction{0.0, 1.0, 0.0}; ///< unit; used unless radial
    bool radial = false;                 ///< away from `centre`
    glm::dvec3 centre{0.0};              ///< world [m]

    /// Unit up at a place in world space.
    glm::dvec3 at(glm::dvec3 place) const;

    /// Height of a place [m]: along ground-up, or from the centre.
    double altitude(glm::dvec3 place) const;
};

/// Everything that decides where blades grow and how they look.
struct BakeSettings {
    std::optional<double>
        density; ///< [1/m²]; neither density nor count: 300, fewer if over 20 million
    std::optional<std::uint64_t> count; ///< blades kept, exactly
    std::optional<double> spacing;   ///< [m] between roots, if Poisson disks; decides the density
    Spread spread = Spread::uniform; ///< how roots lie to one another
    std::uint64_t maxBlades = 200'000'000; ///< more are refused before sampling
    std::optional<double> bladeScale;      ///< size of blades; none: smaller on small ground
    std::uint64_t seed = 0;                ///< another one, another meadow

    Sides sides = Sides::front; ///< of triangles, that bear grass
    Alignment align;            ///< of blades, between normal and vertical
    GroundUp groundUp;          ///< what slope and altitude refer to

    // Where it grows, whatever the species; each species has a Habitat of its own besides.
    SoftRange slope{0.0, 180.0, 0.0};   ///< [degrees] from ground-up
    SoftRange altitude;                 ///< [m] along ground-up (from the centre, if radial)
    SoftRange curvature;                ///< [1/m] mean curvature, convex is positive
    SoftRange border;                   ///< [m] from the nearest border of the ground
    SoftRange water;                    ///< [m] as altitude: above the level of water
    SoftRange sky{0.0, 1.0, 0.0};       ///< share of the sky that a root sees
    double minIsland = 0.0;             ///< [m²] smaller connected pieces bear nothing
    double clearance = 0.0;             ///< [m] free height that a root needs; 0: not asked
    int exposureRays = 8;               ///< rays to the sky; 0: all roots are fully exposed
    double rayLength = 8.0;             ///< [m] how far those rays look, at blade scale 1
    std::vector<Mask> masks;            ///< multiplied
    std::vector<ExcludedArea> excluded; ///< with their meshes
    Meadow meadow;                      ///< what is sown
};

/// Throws Error{usage} naming the setting, its value and its bounds.
void validate(const BakeSettings& settings);

/// What of the settings changes roots or blades, as JSON for the field's provenance.
std::string toJson(const BakeSettings& settings);

/// "normal", "vertical", "blend:0.3". Throws Error{usage}.
Alignment parseAlignment(const std::string& text);

/// "y", "-z", "radial", "radial:x,y,z". Throws Error{usage}.
GroundUp parseGroundUp(const std::string& text);

/// "uniform", "poisson", "poisson-dense". Throws Error{usage}.
Spread parseSpread(const std::string& text);

/// "front", "back", "both". Throws Error{usage}.
Sides parseSides(const std::string& text);

/// Reads the images of all masks, the species' too. Throws Error{io, input}.
void loadMaskImages(BakeSettings& settings);

/// Whether vertex colours are masks and not for show.
bool masksByVertexColor(const BakeSettings& settings);

} // namespace sward::bake
