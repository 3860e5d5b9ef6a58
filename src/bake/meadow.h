#pragma once

#include "shaders/shared/species.h"

#include <glm/vec2.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace sward::bake {

/// One kind of grass in a meadow. Ranges are drawn from uniformly; [m] at blade scale 1.
struct SpeciesTraits {
    std::string name = "grass";
    double share = 1.0;               ///< relative weight among the species, > 0
    glm::dvec2 height{0.25, 0.55};    ///< [m]
    glm::dvec2 width{0.010, 0.018};   ///< [m] full width at the root
    glm::dvec2 stiffness{0.35, 0.75}; ///< [0, 1]
    double clumping = 0.5;            ///< [0, 1]: how alike the blades of one clump are
    shared::Species look = {};
};

/// What is sown: one to eight species.
struct Meadow {
    std::string name = "meadow";
    double clumpSize = 0.7; ///< [m] typical distance of clumps, at blade scale 1; 0: no clumps
    std::vector<SpeciesTraits> species;
};

/// Reads a meadow from JSON text, strictly; `place` names it in messages. Throws Error{input}.
Meadow parseMeadow(std::string_view text, const std::string& place);

/// The meadow of an existing file, else the built-in of that name. Throws Error{io, input}; an
/// unknown name lists the built-in ones.
Meadow loadMeadow(const std::string& fileOrName);

/// The meadow as JSON that parseMeadow() reads back.
std::string toJson(const Meadow& meadow);

/// Names of the built-in meadows, sorted.
std::vector<std::string> builtInMeadows();

} // namespace sward::bake
