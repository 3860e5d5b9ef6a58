#pragma once

#include <string>
#include <vector>

namespace sward::view {

/// The bake requested by the Meadow panel; other settings are the baker's defaults.
struct MeadowRequests {
    std::string ground;     ///< a mesh, a recipe, or a built-in's name
    int meadow = 0;         ///< index into meadowPresets
    std::string meadowFile; ///< a user's meadow file instead; empty: none
    int amount = 0;         ///< 0: the baker's density, 1: density, 2: spacing, 3: count
    float density = 300.0f; ///< [1/m²]
    float spacing = 0.05f;  ///< [m]
    int count = 100'000;
    float slopeLow = 0.0f;    ///< [degrees]
    float slopeHigh = 180.0f; ///< [degrees]
    float slopeSoft = 0.0f;   ///< [degrees] fade width beyond both ends
    int seed = 0;
    std::string masks;  ///< texts of --mask, separated by blanks
    std::string traits; ///< KEY=VALUE of --set, separated by blanks
};
/// Converts the requests to arguments of `sward bake`.
std::vector<std::string> bakeArguments(const MeadowRequests& requests);

/// Those that a field may not hold: its masks, and a meadow file, which may have some.
std::vector<std::string> unstoredArguments(const MeadowRequests& requests);

/// Reads a field's requests from the text of its provenance; missing values get their defaults. A
/// field does not store mask images, changed traits and its mesh, so they stay empty.
MeadowRequests requestsOf(const std::string& provenance);

} // namespace sward::view
