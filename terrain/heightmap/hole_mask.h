#pragma once

#include "core/diagnostics.h"

#include <glm/vec2.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace sward::terrain {

/// Cells of a heightmap that have no ground, 1 each, row by row: where an image over the whole is
/// darker at the cell's centre than half its brightest value, or transparent. An image without
/// colours counts by its alpha. Empty for an empty name. Throws Error{io, input} naming `file`.
std::vector<std::uint8_t> holesOf(const std::string& file, const glm::uvec2& cells,
                                  Diagnostics& diagnostics);

} // namespace sward::terrain
