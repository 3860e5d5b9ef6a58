#pragma once

#include "core/bounds.h"
#include "field/cells.h"
#include "shaders/shared/blade.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

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

/// A patch of blades that are sown and in memory (decision 0045).
struct SownPatch {
    field::SowUnit unit;     ///< that it belongs to
    std::uint32_t patch = 0; ///< of its unit
    Aabb bounds;             ///< of its blades, relative to the field's origin [m]
};

/// The blades of a SownPatch, and their state in the last frame.
struct SownDump {
    std::vector<shared::Blade> blades; ///< relative to the field's origin
    std::vector<BladeRecord> records;  ///< without ids and `lodWidth`
};

} // namespace sward::render
