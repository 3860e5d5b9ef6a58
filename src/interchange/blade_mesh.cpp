#include "interchange/blade_mesh.h"

#include "shaders/shared/bezier.h"
#include "shaders/shared/physics.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace sward::interchange {
namespace {

// Long enough for any blade to come to rest [s].
constexpr float untilRest = 1e6f;

// A blade at the origin of level ground that has come to rest.
shared::Pose restPose(const field::Defaults& defaults, float stiffness)
{
    const glm::vec3 up(0.0f, 1.0f, 0.0f);
    const glm::vec3 front(0.0f, 0.0f, 1.0f);
    shared::Blade blade = {};
    blade.up = up;
    blade.stiffness = stiffness;
    shared::Gravity gravity = {};
    gravity.direction = -up;
    gravity.strength = defaults.gravityStrength;
    gravity.forward = shared::forwardShare;
    return shared::poseBlade(up, front,
                             shared::relaxTip(blade, front, gravity, glm::vec3(0.0f),
                                              defaults.recovery, up, 0.0f, untilRest));
}

// Triangle-tip shape of the paper (section 4.2), as the runtime draws it.
float taper(float along, float threshold)
{
    return 1.0f - glm::max(along - threshold, 0.0f) / glm::max(1.0f - threshold, 1e-3f);
}

} // namespace

BladeMesh bladeMesh(const shared::Species& species, const field::Defaults& defaults,
                    float stiffness)
{
    const shared::Pose pose = restPose(defaults, stiffness);
    BladeMesh mesh;
    // A channel that neither end has is black whatever it is multiplied by.
    mesh.baseColor = glm::max(species.rootColor, species.tipColor);
    const glm::vec3 divisor = glm::max(mesh.baseColor, glm::vec3(1e-6f));

    // Two vertices a row, one at the tip.
    const auto add = [&](float x, float along) {
        const glm::vec3 centre = shared::bezierPoint(glm::vec3(0.0f), pose.v1, pose.v2, along);
        // A straight curve ends at its own control point, without a direction there.
        const glm::vec3 speed = shared::bezierTangent(glm::vec3(0.0f), pose.v1, pose.v2, along);
        const glm::vec3 tangent = glm::normalize(glm::dot(speed, speed) > 1e-12f ? speed : pose.v1);
        mesh.positions.push_back(centre +
                                 glm::vec3(x * taper(along, species.tipThreshold), 0.0f, 0.0f));
        mesh.normals.emplace_back(0.0f, 0.0f - tangent.z, tangent.y);
        mesh.uvs.emplace_back(x + 0.5f, along);
        const glm::vec3 color =
            glm::mix(species.rootColor, species.tipColor, glm::smoothstep(-0.15f, 0.8f, along));
        mesh.colors.push_back(glm::clamp(color / divisor, 0.0f, 1.0f));
    };
    for (std::uint32_t row = 0; row < bladeSegments; ++row) {
        const float along = float(row) / float(bladeSegments);
        add(-0.5f, along);
        add(0.5f, along);
        const std::uint32_t left = 2 * row;
        if (row + 1 < bladeSegments)
            mesh.indices.insert(mesh.indices.end(),
                                {left, left + 1, left + 3, left, left + 3, left + 2});
        else
            mesh.indices.insert(mesh.indices.end(), {left, left + 1, left + 2});
    }
    add(0.0f, 1.0f);
    return mesh;
}

} // namespace sward::interchange
