#include "render/frame/placement.h"

#include "render/frame/frame_settings.h"
#include "render/frame/wind_phase.h"

namespace sward::render {

glm::dmat4 Placement::toWorld(glm::dvec3 origin) const
{
    const glm::dmat3 turn = scale * glm::mat3_cast(rotation);
    glm::dmat4 matrix(turn);
    matrix[3] = glm::dvec4(position + turn * origin, 1.0);
    return matrix;
}

glm::dvec3 Placement::placeInField(glm::dvec3 world) const
{
    return glm::conjugate(rotation) * (world - position) / scale;
}

glm::vec3 Placement::directionInField(glm::vec3 direction) const
{
    return glm::vec3(glm::conjugate(rotation) * glm::dvec3(direction));
}

FrameSettings inField(const Placement& placement, FrameSettings world)
{
    const auto shrink = static_cast<float>(1.0 / placement.scale);

    // Gravity and wind.
    field::Defaults& environment = world.environment;
    environment.gravityDirection = placement.directionInField(environment.gravityDirection);
    environment.attractor = placement.placeInField(environment.attractor);
    environment.drawDistance *= shrink;
    world.windFrame = {placement.position, placement.rotation, placement.scale};
    for (WindSource& wind : world.winds) {
        wind.pace = wind.pace.value_or(paceOf(wind.source));
        wind.source.direction = placement.directionInField(wind.source.direction);
        wind.source.size *= shrink;
        wind.source.speed *= shrink;
        wind.centre = placement.placeInField(wind.centre);
    }
    for (Collider& collider : world.colliders) {
        const glm::dvec3 turned = placement.placeInField(glm::dvec3(0.0));
        collider.from = placement.placeInField(collider.from);
        collider.to = placement.placeInField(collider.to);
        collider.radius /= placement.scale;
        for (Collider::Waypoint& point : collider.path)
            point.move = placement.placeInField(point.move) - turned;
    }

    // Distances from the eye.
    world.buckets.distance *= shrink;
    for (LevelStep& step : world.levelSteps)
        step.distance *= shrink;
    if (world.updateRate.everyFrame)
        *world.updateRate.everyFrame *= shrink;
    if (world.updateRate.everyThird)
        *world.updateRate.everyThird *= shrink;

    // Light and air.
    world.sunDirection = placement.directionInField(world.sunDirection);
    if (world.skyUp)
        *world.skyUp = placement.directionInField(*world.skyUp);
    world.fogDensity /= shrink;
    world.fogHeight *= shrink;
    return world;
}

} // namespace sward::render
