#pragma once

#include <glm/vec3.hpp>

#include <cstdint>

namespace sward::render {

/// State of one blade in the last frame.
struct BladeRecord {
    std::uint64_t id = 0;         ///< field::bladeId()
    glm::dvec3 root{0.0};         ///< world [m]: where the curve begins
    glm::dvec3 v1{0.0};           ///< world [m]: the middle control point
    glm::dvec3 v2{0.0};           ///< world [m]: the tip
    glm::vec3 up{0.0f};           ///< unit
    float eta = 0.0f;             ///< collision strength, see shared::BladeState
    float lodWidth = 0.0f;        ///< width factor; 0 if not drawn
    std::uint32_t cullResult = 0; ///< shared::cullResultDrawn …
};

} // namespace sward::render
