#pragma once

#include "bake/settings/habitat.h"
#include "field/organs.h"
#include "shaders/shared/species.h"

#include <glm/vec2.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace sward::bake {

/// Direction that the blades of a clump face.
enum class Facing {
    outward, ///< away from its centre
    shared,  ///< one direction per clump
    free     ///< random
};

/// One species of a meadow. Ranges are sampled uniformly; lengths in [m] at blade scale 1.
struct SpeciesTraits {
    std::string name = "grass";       ///< name of the species
    double share = 1.0;               ///< relative weight among species of its priority, > 0
    int priority = 0;                 ///< higher values take their places first
    double cover = 1.0;               ///< (0, 1] largest share of the density
    Habitat habitat;                  ///< where it grows
    glm::dvec2 height{0.25, 0.55};    ///< [m]
    glm::dvec2 width{0.010, 0.018};   ///< [m] full width at the root
    glm::dvec2 stiffness{0.35, 0.75}; ///< [0, 1]
    double clumping = 0.5;            ///< [0, 1]: similarity of blades of one clump
    Facing facing = Facing::outward;  ///< of blades in a clump
    double tuftSpacing = 0.0;         ///< [m] typical distance of tufts; 0: no tufts
    double tuftRadius = 0.03;         ///< [m] radius of the ground that a tuft covers
    double tuftLean = 0.85;           ///< [0, 1]: how far a tuft opens from its middle to its rim
    double tuftLitter = 0.12;         ///< [0, 1] share of short, dead, lying blades in a tuft
    shared::Species look = {};        ///< colours, shape, gloss
    std::vector<field::Organ> organs; ///< of a compound plant, whose stalk is the blade
};

/// How grass changes where it ends. Lengths in [m] at blade scale 1; a reach of 0 turns it off.
struct EdgeTraits {
    double occluderReach = 0.5;    ///< [m] from the foot of rocks and walls
    double occluderHeight = 1.5;   ///< relative height at their foot, [0.1, 4]
    double occluderDryness = 0.25; ///< [0, 1] share of dried blades there
    double pathReach = 0.4;        ///< [m] from bare ground that goes on level
    double pathHeight = 0.6;       ///< relative height beside it, [0.05, 1]
    double pathLean = 0.6;         ///< [0, 1]: how far blades there lie down, away from it
    double creaseBlend = 1.0;      ///< [0, 1]: how far blades lean over convex creases
};

/// Distance [m] at blade scale 1 at which the ground's form changes grass by Meadow::wideVariation,
/// and the greatest factor of a blade's height.
inline constexpr double wideVariationReach = 9.0;
inline constexpr double wideVariationHeight = 1.2;

/// A mix of one to eight species.
struct Meadow {
    std::string name = "meadow"; ///< name of the meadow
    double clumpSize = 0.7;      ///< [m] typical distance of clumps, at blade scale 1; 0: no clumps
    double sparseHeight = 0.6;   ///< relative height where filter weights are near 0
    double heightWaves = 0.0;    ///< [0, 0.5] relative rise and fall of height over the ground
    double wideVariation = 0.0; ///< [0, 1]: how far grass varies in patches of 5 to 50 m
    double drifts = 0.0;        ///< [0, 1]: how far species keep to places of their own, metres wide
    double closedCover =
        0.88; ///< [0.01, 0.999] of the ground hidden from above, at its own density
    bool fitsOverhangs = true; ///< shortens blades to the room above them, if rays are cast
    EdgeTraits edges;          ///< at rocks, walls and paths
    std::vector<SpeciesTraits> species; ///< 1 to 8
};

/// Parses a meadow from JSON text, strictly; messages name `place`. Throws Error{input}.
Meadow parseMeadow(std::string_view text, const std::string& place);

/// Loads a meadow from an existing file, else the built-in of that name. Mask image paths are
/// relative to the file's folder; the images are not read yet. Throws Error{io, input}; the error
/// for an unknown name lists the built-in ones.
Meadow loadMeadow(const std::string& fileOrName);

/// The meadow as JSON that parseMeadow() reads back.
std::string toJson(const Meadow& meadow);

/// Returns `meadow` after applying the assignments "key=value" in order. A key is a JSON path:
/// "clump_size_m", "species.bent.share" (by name), "species.0.share" (by number), "species.*.share"
/// (all). The value is JSON, or else text. Throws Error{usage} naming the assignment.
Meadow withAssignments(const Meadow& meadow, const std::vector<std::string>& assignments);

/// Names of the built-in meadows, sorted.
std::vector<std::string> builtInMeadows();

} // namespace sward::bake
