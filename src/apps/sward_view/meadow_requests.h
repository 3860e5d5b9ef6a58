#pragma once

#include <string>
#include <vector>

namespace sward::view {

/// What shall be baked, as the panel Meadow asks for it; the rest is the baker's own.
struct MeadowRequests {
    std::string ground;     ///< a mesh, a recipe, or a built-in's name
    int meadow = 0;         ///< index into meadowNames
    std::string meadowFile; ///< a meadow of the user's instead; empty: none
    int amount = 0;         ///< 0: the baker's density, 1: density, 2: spacing, 3: count
    float density = 300.0f; ///< [1/m²]
    float spacing = 0.05f;  ///< [m]
    int count = 100'000;
    float slopeLow = 0.0f;    ///< [degrees]
    float slopeHigh = 180.0f; ///< [degrees]
    float slopeSoft = 0.0f;   ///< [degrees] over which grass thins out beyond both
    int seed = 0;
    std::string masks;  ///< texts of --mask, separated by blanks
    std::string traits; ///< KEY=VALUE of --set, separated by blanks
};
inline constexpr const char* meadowNames[] = {"meadow", "lawn", "steppe"};

/// Arguments of `sward bake` that say the same.
std::vector<std::string> bakeArguments(const MeadowRequests& requests);

/// The requests that a field was baked with, as far as the panel knows them, from the text of its
/// provenance; those that say nothing where it says nothing. Images of masks and changed traits are
/// not held by a field, nor is its mesh.
MeadowRequests requestsOf(const std::string& provenance);

} // namespace sward::view
