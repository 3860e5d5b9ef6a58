#pragma once

#include "bake/settings/stroke.h"

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace sward::bake {

// Bounds of a stroke file.
inline constexpr std::size_t maxStrokes = 100'000;
inline constexpr std::size_t maxStrokePoints = 1'000'000; ///< of all strokes together
inline constexpr std::size_t longestStrokeName = 200;     ///< [bytes]
inline constexpr double shortestRadius = 0.001;           ///< [m]
inline constexpr double longestRadius = 1000.0;           ///< [m]
inline constexpr double farthestPoint = 1e9;              ///< [m] along each axis

/// Parses a stroke file (docs/painting.md). Throws Error{input} naming `place`, the stroke, the
/// value and its bound, and Error{unsupported} for another version of the format.
Strokes parseStrokes(std::string_view text, const std::string& place);

/// Throws Error{input} naming `place` if there are more strokes or points than a file may have.
void requireStrokeCount(const Strokes& strokes, const std::string& place);

/// Reads a stroke file. Throws as parseStrokes() does, and Error{io}.
Strokes loadStrokes(const std::filesystem::path& path);

/// The text that parseStrokes() reads back: a stroke to a line. Points are rounded to millimetres.
std::string toJson(const Strokes& strokes);

/// A stroke as toJson() writes it, on one line.
std::string textOf(const Stroke& stroke);

/// A hash of the content as 16 digits: lists of strokes that are equal but for their names have the
/// same. Empty without strokes.
std::string hashOf(const Strokes& strokes);

/// Finds the species of strokes among these names. Throws Error{input} naming the file, the stroke
/// and all names.
void resolveSpecies(Strokes& strokes, std::span<const std::string> names);

} // namespace sward::bake
