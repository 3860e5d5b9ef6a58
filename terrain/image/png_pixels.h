#pragma once

#include <glm/vec2.hpp>

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace sward::terrain {

/// A decoded PNG, rows from the top, pixels packed.
struct PngPixels {
    glm::uvec2 size{0U};
    std::size_t depth = 0;    ///< bits of a sample in the file
    std::size_t channels = 0; ///< 1 or 3 as stored, 4 as RGBA
    bool isWide = false;      ///< samples of 16 bits in the machine's order, else of 8
    std::vector<unsigned char> bytes;
};

enum class PngForm {
    stored, ///< at the file's depth (less than 8 bits become 8), without transparency
    rgba    ///< red, green, blue, alpha of 8 bits
};

bool isPng(std::span<const std::byte> file);

/// Decodes a PNG by libpng, which never allocates more than the header declares. `check` gets the
/// size before memory is allocated, and may throw. Throws Error{input} naming `place`.
PngPixels readPng(std::span<const std::byte> file, PngForm form,
                  const std::function<void(const glm::uvec2&)>& check, const std::string& place);

} // namespace sward::terrain
