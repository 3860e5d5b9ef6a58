#pragma once

#include "core/diagnostics.h"

#include <glm/vec4.hpp>

#include <span>
#include <string>

namespace sward::terrain {

/// Brings colours, or other numbers of masks, into [0, 1]. Numbers up to 2 are taken as they are
/// and cut off at 0 and 1. If a red, green or blue is larger, all three are divided by 255, or by
/// 65535 if one is above 255; alpha is judged by itself. Both give a warning that names `place`
/// and `what`. Finite numbers only.
void bringToUnit(std::span<glm::vec4> colors, const std::string& place, const std::string& what,
                 Diagnostics& diagnostics);

/// The first half of bringToUnit(): divides, cuts nothing off. Returns the divisors, 1 or more.
glm::vec4 scaleToUnit(std::span<glm::vec4> colors, const std::string& place,
                      const std::string& what, Diagnostics& diagnostics);

/// The second half: cuts off at 0 and 1, with a warning.
void cutToUnit(std::span<glm::vec4> colors, const std::string& place, const std::string& what,
               Diagnostics& diagnostics);

} // namespace sward::terrain
