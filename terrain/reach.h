#pragma once

#include "core/bounds.h"

#include <string>

namespace sward::terrain {

/// Largest coordinate of placed ground on each axis [m], more than twice the Earth's diameter. All
/// cells of 32 m then have numbers of 21 bits, and doubles resolve a hundredth of a micrometre.
inline constexpr double farthestCoordinate = 3e7;

/// Whether a coordinate is finite and within ±farthestCoordinate.
bool isWithinReach(const glm::dvec3& position);

/// Throws Error{input} naming `place`, the coordinate and the bound if the box in world space goes
/// beyond ±farthestCoordinate.
void requireReach(const DAabb& worldBounds, const std::string& place);

} // namespace sward::terrain
