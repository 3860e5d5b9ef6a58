#pragma once

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace sward::view {

/// What a stroke does, in the order of the panel.
enum class PaintKind { add, erase, set, smooth, species, height, dryness, trodden, clear };

inline constexpr std::size_t paintKinds = 9;
inline constexpr std::array<const char*, paintKinds> paintKindNames{
    "add", "erase", "set", "smooth", "species", "height", "dryness", "trodden", "clear"};

/// The brush; ranges are those of a stroke file (docs/painting.md).
struct Brush {
    PaintKind kind = PaintKind::add;
    float radius = 1.0f; ///< [m]
    float hardness = 0.5f;
    float strength = 1.0f;
    float ceiling = 1.0f; ///< of add
    float density = 1.0f; ///< of set
    float factor = 1.5f;  ///< of height
    float share = 1.0f;   ///< of dryness
    float height = 0.4f;  ///< of trodden
    float lean = 0.8f;    ///< of trodden
    std::string species;  ///< of species: its name

    bool operator==(const Brush&) const = default;
};

/// Bounds of the brush's radius [m].
inline constexpr float shortestBrush = 0.01f;
inline constexpr float longestBrush = 100.0f;

/// A point of a stroke on the ground.
struct PaintPoint {
    glm::dvec3 place{0.0};            ///< world [m]
    glm::dvec3 normal{0.0, 1.0, 0.0}; ///< unit, of the side that bears grass
};

/// Bytes of a stroke's text that it is simplified to, if its form allows.
inline constexpr std::size_t strokeBytes = 2048;

/// The points without those that the others tell: none is farther than `tolerance` [m] from the
/// line through the rest.
std::vector<PaintPoint> simplified(const std::vector<PaintPoint>& points, double tolerance);

/// A stroke as a line of a stroke file, without a line break. It is simplified until it fits in
/// `strokeBytes`, but never by more than a quarter of the radius.
std::string strokeText(const Brush& brush, const std::vector<PaintPoint>& points);

/// A stroke file of these lines.
std::string strokeFileText(const std::vector<std::string>& strokes);

/// The strokes of a stroke file, each as a line; `sward edit` judges what they say. Throws
/// Error{io} if it cannot be read, Error{input} if it is no stroke file or larger than 64 MiB.
std::vector<std::string> readStrokeFile(const std::filesystem::path& path);

/// The kind that a stroke's text names; empty if it names none.
std::string kindOfStroke(std::string_view text);

} // namespace sward::view
