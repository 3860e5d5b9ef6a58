#pragma once

#include "core/bounds.h"
#include "render/frame/placement.h"
#include "render/host/host_light.h"
#include "shaders/shared/host_light.h"

#include <glm/vec3.hpp>

#include <optional>

namespace sward::render {

/// A field that is lit: its placement, origin and content, and the direction of its sky.
struct LitField {
    const Placement& placement;
    glm::dvec3 origin{0.0};
    const Aabb& content;
    glm::vec3 skyUp{0.0f, 1.0f, 0.0f}; ///< unit, of the field
};

/// Light and shadow for the shaders. Leaves out lamps that do not reach the content.
shared::HostLight hostLightOf(const HostLight& light, const std::optional<HostShadow>& shadow,
                              const LitField& field);

} // namespace sward::render
