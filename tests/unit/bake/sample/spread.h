#pragma once

#include <glm/vec3.hpp>

#include <vector>

namespace sward::tests {

/// Smallest distance between two points [m], by their cells; all pairs count.
double smallestDistance(const std::vector<glm::dvec3>& points, double cell);

/// ρ = d_min / √(2A / (√3 n)): 1 for a hexagonal packing (Lagae & Dutré 2008).
double relativeRadius(const std::vector<glm::dvec3>& points, double area);

} // namespace sward::tests
