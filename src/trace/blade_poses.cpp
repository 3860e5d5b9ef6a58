#include "trace/blade_poses.h"

#include "field/organs.h"
#include "shaders/shared/organ.h"
#include "shaders/shared/physics.h"
#include "shaders/shared/update_rate.h"

#include <glm/geometric.hpp>
#include <tbb/parallel_for.h>

#include <algorithm>

namespace sward::trace {
namespace {

glm::vec3 unitOr(glm::vec3 v, glm::vec3 otherwise)
{
    const float size = glm::length(v);
    return size > 0.0f ? v / size : otherwise;
}

// The environment that render::FrameSettings::of() gives a field, without wind.
shared::Environment calmOf(const field::FieldView& field)
{
    const field::Defaults& defaults = *field.defaults;
    shared::Environment environment = {};
    environment.gravity.direction = unitOr(defaults.gravityDirection, glm::vec3(0.0f, -1.0f, 0.0f));
    environment.gravity.strength = defaults.gravityStrength;
    environment.gravity.attractor = glm::vec3(defaults.attractor - field.origin);
    environment.gravity.blend = std::clamp(defaults.attractorBlend, 0.0f, 1.0f);
    environment.gravity.forward = shared::forwardShare;
    environment.recovery = defaults.recovery;
    return environment;
}

} // namespace

std::vector<BladePose> restingPoses(const field::FieldView& field)
{
    const shared::Environment calm = calmOf(field);
    const std::vector<shared::Organ> organs = field::organTable(field.species);
    const shared::OrganTable table = field::viewOf(organs);
    std::vector<BladePose> poses(field.blades.size());
    tbb::parallel_for(std::size_t(0), field.patches.size(), [&](std::size_t patch) {
        const shared::Patch& cell = field.patches[patch];
        for (std::uint32_t i = 0; i < cell.bladeCount; ++i) {
            const std::size_t index = std::size_t(cell.firstBlade) + i;
            const shared::Blade blade = shared::unpackBlade(field.blades[index], cell);
            const shared::Species& look = field.species[blade.species].look;
            const shared::BladeState state =
                shared::advanceBlade(blade, calm, shared::noColliders(),
                                     shared::BladeState{0u, 0.0f}, 0.0f, shared::settlingTime);
            shared::PosedBlade posed = shared::posedBlade(blade, state);
            if (const std::uint32_t number = shared::ribbonNumber(look, blade); number > 0)
                posed = shared::ribbonOf(table, look, posed, number);
            poses[index] = {posed.v0, posed.v1, posed.v2, posed.axis};
        }
    });
    return poses;
}

} // namespace sward::trace
