#pragma once

#include "bake/habitat.h"
#include "shaders/shared/species.h"

#include <glm/vec2.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace sward::bake {

/// Where the blades of a clump look.
enum class Facing {
    outward, ///< away from its middle
    shared,  ///< the way of the whole clump
    free     ///< anywhere
};

/// One kind of grass in a meadow. Ranges are drawn from uniformly; [m] at blade scale 1.
struct SpeciesTraits {
    std::string name = "grass";       ///< of the species
    double share = 1.0;               ///< relative weight among species of its priority, > 0
    int priority = 0;                 ///< a higher one takes its places first
    double cover = 1.0;               ///< (0, 1] of the density that it takes at most
    Habitat habitat;                  ///< where it grows
    glm::dvec2 height{0.25, 0.55};    ///< [m]
    glm::dvec2 width{0.010, 0.018};   ///< [m] full width at the root
    glm::dvec2 stiffness{0.35, 0.75}; ///< [0, 1]
    double clumping = 0.5;            ///< [0, 1]: how alike the blades of one clump are
    Facing facing = Facing::outward;  ///< of a clump's blades
    double tuftSpacing = 0.0;  ///< [m] typical distance of tufts; 0: blades stand for themselves
    double tuftRadius = 0.03;  ///< [m] of the ground that a tuft's blades grow from
    shared::Species look = {}; ///< colours, shape, gloss
};

/// What is sown: one to eight species.
struct Meadow {
    std::string name = "meadow"; ///< of the meadow
    double clumpSize = 0.7;      ///< [m] typical distance of clumps, at blade scale 1; 0: no clumps
    double sparseHeight = 0.6; ///< height, relative to full, where filters let hardly a blade grow
    bool fitsOverhangs = true; ///< blades are cut to the room over them, if rays are asked for
    std::vector<SpeciesTraits> species; ///< 1 to 8
};

/// Reads a meadow from JSON text, strictly; `place` names it in messages. Throws Error{input}.
Meadow parseMeadow(std::string_view text, const std::string& place);

/// The meadow of an existing file, else the built-in of that name. Images of masks are named from
/// the file's folder, and not read yet. Throws Error{io, input}; an unknown name lists the built-in
/// ones.
Meadow loadMeadow(const std::string& fileOrName);

/// The meadow as JSON that parseMeadow() reads back.
std::string toJson(const Meadow& meadow);

/// `meadow` with assignments "key=value" made one after the other. A key is a path as in its JSON:
/// "clump_size_m", "species.bent.share" (by name), "species.0.share" (by number), "species.*.share"
/// (all); the value is JSON, or else text. Throws Error{usage} naming the assignment.
Meadow withAssignments(const Meadow& meadow, const std::vector<std::string>& assignments);

/// Names of the built-in meadows, sorted.
std::vector<std::string> builtInMeadows();

} // namespace sward::bake
