#pragma once

#include "bake/meadow.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace sward::bake {

/// A range with soft edges: 1 inside [low, high], falling to 0 over `soft` outside.
struct SoftRange {
    double low = 0.0;
    double high = 0.0;
    double soft = 0.0;

    /// Probability of keeping what has `value`.
    double weight(double value) const;
};

/// Which side of a triangle bears grass. The front is where its corners turn anti-clockwise.
enum class Sides { front, back, both };

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
};

/// Density multiplied by a channel of the vertices' colours.
struct VertexColorMask {
    int channel = 0; ///< 0 red, 1 green, 2 blue, 3 alpha
    bool invert = false;
};

/// Everything that decides where blades grow and how they look.
struct BakeSettings {
    std::optional<double>
        density; ///< [1/m²]; neither density nor count: 300, fewer if over 20 million
    std::optional<std::uint64_t> count;    ///< blades kept, exactly
    std::uint64_t maxBlades = 200'000'000; ///< more are refused before sampling
    std::optional<double> bladeScale;      ///< size of blades; none: smaller on small ground
    std::uint64_t seed = 0;

    Sides sides = Sides::front;
    Alignment align;
    GroundUp groundUp;
    SoftRange slope{0.0, 180.0, 0.0};       ///< [degrees] from ground-up
    SoftRange altitude{-1e300, 1e300, 0.0}; ///< [m] along ground-up (from the centre, if radial)
    double clearance = 0.0;                 ///< [m] free height that a root needs; 0: not asked
    int exposureRays = 8;   ///< rays to the sky for each root; 0: all roots are fully exposed
    double rayLength = 8.0; ///< [m] how far those rays look
    std::vector<VertexColorMask> masks;
    Meadow meadow;
};

/// Throws Error{usage} naming the setting, its value and its bounds.
void validate(const BakeSettings& settings);

/// What of the settings changes roots or blades, as JSON for the field's provenance.
std::string toJson(const BakeSettings& settings);

/// "normal", "vertical", "blend:0.3". Throws Error{usage}.
Alignment parseAlignment(const std::string& text);

/// "y", "-z", "radial", "radial:x,y,z". Throws Error{usage}.
GroundUp parseGroundUp(const std::string& text);

/// "MIN:MAX" or "MIN:MAX~SOFT"; either end may be left out. Throws Error{usage} naming `option`.
SoftRange parseSoftRange(const std::string& option, const std::string& text, SoftRange full);

/// "front", "back", "both". Throws Error{usage}.
Sides parseSides(const std::string& text);

/// "vertex-color:R" or "vertex-color:R:invert" with R G B or A. Throws Error{usage, unsupported}.
VertexColorMask parseMask(const std::string& text);

} // namespace sward::bake
