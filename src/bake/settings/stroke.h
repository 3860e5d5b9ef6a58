#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace sward::bake {

/// What a stroke of paint does; see docs/painting.md for the formulas.
enum class StrokeKind { add, erase, set, smooth, species, height, dryness, trodden, clear };

/// A stroke painted on the ground: a chain of capsules around its points. It paints surfaces that
/// face the way of its normals.
struct Stroke {
    StrokeKind kind = StrokeKind::add;
    std::string name{};     ///< for people; empty: none. Changes nothing
    double radius = 1.0;    ///< [m]
    double hardness = 0.5;  ///< [0, 1] share of the radius that has the full strength
    double strength = 1.0;  ///< [0, 1] share of the way to `value`
    double depth = 0.0;     ///< [m] largest distance along the normal; 0: the radius
    double value = 1.0;     ///< ceiling, density, factor, share, or relative height if trodden
    double lean = 0.8;      ///< [0, 1] of trodden
    std::string species;    ///< name, of kind species
    std::uint32_t slot = 0; ///< of that species in the meadow, by resolveSpecies()

    /// World positions [mm].
    std::vector<std::array<std::int64_t, 3>> points;
    /// Of the surface, in thousandths: one for each point, one for all, or none.
    std::vector<std::array<std::int16_t, 3>> normals;

    bool operator==(const Stroke&) const = default; ///< in all its members
};

/// Largest density that strokes reach, relative to the bake's.
inline constexpr double maxPaintedDensity = 8.0;

/// Range of factors on the height of blades.
inline constexpr double lowestPaint = 0.05;
inline constexpr double highestPaint = 4.0;

/// An ordered list of strokes.
struct Strokes {
    std::string file; ///< for messages
    std::vector<Stroke> list;

    bool empty() const { return list.empty(); }
};

/// The word for a kind in files.
const char* nameOf(StrokeKind kind);

} // namespace sward::bake
