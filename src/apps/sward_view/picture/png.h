#pragma once

#include <glm/vec2.hpp>

#include <cstdint>
#include <filesystem>
#include <vector>

namespace sward::view {

/// A picture: 4·width·height bytes RGBA, sRGB, rows from the top.
struct Picture {
    glm::uvec2 size{0};
    std::vector<std::uint8_t> rgba;
};

/// Writes the picture as an opaque PNG, whole or not at all. Throws Error{io}.
void writePng(const Picture& picture, const std::filesystem::path& path, bool overwrite);

} // namespace sward::view
