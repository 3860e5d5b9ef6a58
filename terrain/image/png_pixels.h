#pragma once

#include <glm/vec2.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace sward::terrain {

/// A decoded PNG, rows from the top, pixels packed.
struct PngPixels {
    glm::uvec2 size{0U};
    std::size_t depth = 0;     ///< bits of a sample in the file
    std::size_t channels = 0;  ///< 1 grey, 2 grey and alpha, 3 colour, 4 colour and alpha
    bool isWide = false;       ///< samples of 16 bits in the machine's order, else of 8
    bool hasPalette = false;   ///< the file stores indices of colours
    std::vector<unsigned char> bytes;

    bool hasAlpha() const { return channels % 2 == 0; }

    /// Channel `channel` of pixel `pixel` as 16 bits: a byte b is 257·b.
    std::uint16_t at(std::size_t pixel, std::size_t channel) const;
};

enum class PngForm {
    stored, ///< at the file's depth; less than 8 bits become 8, palettes colours, tRNS alpha
    rgba    ///< red, green, blue, alpha of 8 bits
};

bool isPng(std::span<const std::byte> file);

/// Decodes a PNG by libpng. `check` gets the size before memory is allocated, and may throw. Chunks
/// that pixels do not need are skipped unread. No more memory than 32 MB or 32 bytes for each byte
/// of the file is taken before all rows have once been unpacked. Throws Error{input} naming `place`
/// if the file is damaged or truncated, or a pixel is outside its palette.
PngPixels readPng(std::span<const std::byte> file, PngForm form,
                  const std::function<void(const glm::uvec2&)>& check, const std::string& place);

} // namespace sward::terrain
