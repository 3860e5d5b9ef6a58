#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace sward::terrain {

/// Whether the first bytes are those of a JPEG.
bool isJpeg(std::span<const std::byte> file);

/// Checks a JPEG, BMP or TGA before it is decoded, since stb_image believes what a header claims:
/// it would allocate such an image, and take zeros for pixels that are missing. Throws Error{input}
/// naming `place` if the file is too short for its pixels ("truncated"), or if a pixel has an index
/// outside its palette. Says nothing of other formats, or of what is no image.
void requireWholeImage(std::span<const std::byte> file, const std::string& place);

/// The name of a format that is not read, by its first bytes; empty for any other file.
const char* foreignImage(std::span<const std::byte> file);

} // namespace sward::terrain
