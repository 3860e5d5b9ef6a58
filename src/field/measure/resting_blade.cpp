#include "field/measure/resting_blade.h"

#include "shaders/shared/collision.h"
#include "shaders/shared/physics.h"
#include "shaders/shared/update_rate.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace sward::field {

shared::Environment calmOf(const FieldView& field)
{
    const Defaults& defaults = *field.defaults;
    const float size = glm::length(defaults.gravityDirection);
    shared::Environment calm = {};
    calm.gravity.direction =
        size > 0.0f ? defaults.gravityDirection / size : glm::vec3(0.0f, -1.0f, 0.0f);
    calm.gravity.strength = defaults.gravityStrength;
    calm.gravity.attractor = glm::vec3(defaults.attractor - field.origin);
    calm.gravity.blend = std::clamp(defaults.attractorBlend, 0.0f, 1.0f);
    calm.gravity.forward = shared::forwardShare;
    calm.recovery = defaults.recovery;
    return calm;
}

shared::PosedBlade restingBlade(const FieldView& field, const shared::OrganTable& organs,
                                const shared::Environment& calm, const shared::Blade& blade)
{
    const shared::Species& look = field.species[blade.species].look;
    const shared::BladeState rest =
        shared::advanceBlade(blade, calm, shared::noColliders(), shared::BladeState{0u, 0.0f}, 0.0f,
                             shared::settlingTime);
    const shared::PosedBlade posed = shared::posedBlade(blade, rest);
    const std::uint32_t number = shared::ribbonNumber(look, blade);
    return number > 0 ? shared::ribbonOf(organs, look, posed, number) : posed;
}

} // namespace sward::field
