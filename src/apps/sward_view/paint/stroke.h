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
/// Their keywords in a stroke file.
inline constexpr std::array<const char*, paintKinds> paintKindNames{
    "add", "erase", "set", "smooth", "species", "height", "dryness", "trodden", "clear"};
/// What the panel calls them.
inline constexpr std::array<const char*, paintKinds> paintKindWords{
    "Sow",           "Remove grass", "Set density",  "Smooth density", "Sow a species",
    "Change height", "Dry out",      "Tread a path", "Undo paint here"};

/// The panel's word for a keyword; the keyword itself if it is none.
std::string wordOfKind(const std::string& keyword);

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

/// Bytes of a stroke's name, at most.
inline constexpr std::size_t longestStrokeName = 200;

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

/// What a stroke's text says of its kind, name and shape.
struct StrokeSketch {
    std::string kind;    ///< keyword; empty: none
    std::string name;    ///< empty: none
    std::string species; ///< of kind species
    double radius = 1.0; ///< [m]
    std::vector<PaintPoint> points;

    double length() const;     ///< [m] along its points
    glm::dvec3 middle() const; ///< of the box around its points, world [m]
};

/// Reads a stroke's text; what it does not say, or wrongly, is as in an empty sketch.
StrokeSketch sketchOf(std::string_view text);

/// The text with another name, or none.
std::string withName(const std::string& text, const std::string& name);

} // namespace sward::view
