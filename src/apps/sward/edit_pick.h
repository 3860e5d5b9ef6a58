#pragma once

#include "bake/session/session.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <optional>

namespace sward::apps {

/// A line of sight in the world.
struct EditSight {
    glm::dvec3 eye{0.0};       ///< [m]
    glm::dvec3 direction{0.0}; ///< unit
    double farthest = 0.0;     ///< [m] along it
    double spread = 0.0;       ///< tolerance beside a blade, in metres for each metre of distance
};

/// Species, as a slot of the meadow, of the blade that a line of sight meets first, as blades stand
/// in still air. Empty: it meets none.
std::optional<std::uint32_t> speciesAlong(const bake::Session& session, const EditSight& sight);

} // namespace sward::apps
