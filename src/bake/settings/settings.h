#pragma once

#include "bake/mask/excluded_area.h"
#include "bake/mask/mask.h"
#include "bake/mask/soft_range.h"
#include "bake/settings/meadow.h"
#include "bake/settings/stroke.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace sward::bake {

/// Which side of a triangle bears grass. Corners turn anti-clockwise seen from the front.
enum class Sides { front, back, both };

/// Distribution of roots: independent and stratified; Poisson disks with a minimum spacing; or
/// Poisson disks packed as densely as dart throwing allows.
enum class Spread { uniform, poisson, poissonDense };

/// Most blades and ribbons of a bake whose density the meadow decides.
constexpr std::uint64_t usualBudget = 50'000'000;

/// Whether a field holds seeds, what bears, and but the first of its blades (decision 0044):
/// automatic where no density is set, and the closed sward exceeds the budget and usualBudget.
enum class SeedUse { never, automatic, always };

/// Growth direction: 0 along the surface normal, 1 against gravity (ground-up), or between.
struct Alignment {
    double vertical = 0.0; ///< [0, 1]
};

/// Direction against gravity; slope is measured from it.
struct GroundUp {
    glm::dvec3 direction{0.0, 1.0, 0.0}; ///< unit; used unless radial
    bool radial = false;                 ///< up points away from `centre`
    glm::dvec3 centre{0.0};              ///< world [m]

    /// Unit up vector at a world position.
    glm::dvec3 at(glm::dvec3 place) const;

    /// Height of a position [m]: along ground-up, or from the centre.
    double altitude(glm::dvec3 place) const;
};

/// All settings that determine where blades grow and how they look.
struct BakeSettings {
    std::optional<double>
        density; ///< [1/m²]; without density, spacing and count: closedDensity() of the meadow
    std::optional<std::uint64_t> count;    ///< blades kept, exactly
    std::optional<double> spacing;         ///< [m] between roots of Poisson disks; sets the density
    Spread spread = Spread::uniform;       ///< distribution of roots
    std::uint64_t budget = usualBudget;    ///< most blades and ribbons where the meadow decides
    std::uint64_t maxBlades = 200'000'000; ///< with ribbons; larger bakes fail before sampling
    SeedUse seeds = SeedUse::never;        ///< whether the field holds seeds
    std::optional<double> bladeScale;      ///< none: automatic, smaller on small ground
    std::uint64_t seed = 0;                ///< seed of all random numbers

    Sides sides = Sides::front; ///< triangle sides that bear grass
    Alignment align;            ///< growth between normal and vertical
    GroundUp groundUp;          ///< reference of slope and altitude

    // Filters for all species; each species also has its own Habitat.
    SoftRange slope{0.0, 180.0, 0.0};   ///< [degrees] from ground-up
    SoftRange altitude;                 ///< [m] along ground-up (from the centre, if radial)
    SoftRange curvature;                ///< [1/m] mean curvature, convex is positive
    SoftRange border;                   ///< [m] from the nearest border of the ground
    SoftRange water;                    ///< [m] altitude above the water level
    SoftRange sky{0.0, 1.0, 0.0};       ///< share of the sky visible from a root
    double minIsland = 0.0;             ///< [m²] smaller connected pieces stay bare
    double clearance = 0.0;             ///< [m] free height that a root needs; 0: not tested
    int exposureRays = 8;               ///< rays to the sky; 0: all roots are fully exposed
    double rayLength = 8.0;             ///< [m] length of those rays, at blade scale 1
    std::vector<Mask> masks;            ///< multiplied
    std::vector<ExcludedArea> excluded; ///< areas without grass, with their meshes
    Strokes strokes;                    ///< painted on the ground, after resolveSpecies()
    Meadow meadow;                      ///< the species
};

/// Throws Error{usage} naming the setting, its value and its bounds.
void validate(const BakeSettings& settings);

/// The settings that affect roots or blades, as JSON for the field's provenance.
std::string toJson(const BakeSettings& settings);

/// "normal", "vertical", "blend:0.3". Throws Error{usage}.
Alignment parseAlignment(const std::string& text);

/// "y", "-z", "radial", "radial:x,y,z". Throws Error{usage}.
GroundUp parseGroundUp(const std::string& text);

/// "uniform", "poisson", "poisson-dense". Throws Error{usage}.
Spread parseSpread(const std::string& text);

/// "never", "auto", "always". Throws Error{usage}.
SeedUse parseSeedUse(const std::string& text);

/// "front", "back", "both". Throws Error{usage}.
Sides parseSides(const std::string& text);

/// What importers have to keep for all masks, including the species' masks.
terrain::MaskInputs maskInputs(const BakeSettings& settings);

/// Reads the images of all masks, including the species' masks. Throws Error{io, input}.
void loadMaskImages(BakeSettings& settings);

/// Whether a mask, also of a species, reads the ground's own colour.
bool needsGreen(const BakeSettings& settings);

/// Whether vertex colours are used as masks instead of for display.
bool masksByVertexColor(const BakeSettings& settings);

} // namespace sward::bake
