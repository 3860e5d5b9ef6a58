#include "interchange/blade_mesh.h"

#include "shaders/shared/bezier.h"
#include "shaders/shared/physics.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace sward::interchange {
namespace {

// Time after which any blade is at rest [s].
constexpr float untilRest = 1e6f;

// Rest pose of a blade at the origin on level ground.
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

} // namespace

std::uint32_t bladeSegments(std::uint32_t shape)
{
    return shape == shared::shapeDandelion
               ? static_cast<std::uint32_t>(shared::dandelionLobes * shared::segmentsPerLobe)
               : 4;
}

BladeMesh bladeMesh(const shared::Species& species, const field::Defaults& defaults,
                    float stiffness)
{
    const shared::Pose pose = restPose(defaults, stiffness);
    BladeMesh mesh;
    // A channel that is 0 at both ends stays 0.
    mesh.baseColor = glm::max(species.rootColor, species.tipColor);
    const glm::vec3 divisor = glm::max(mesh.baseColor, glm::vec3(1e-6f));

    // A row has two edges, and between them the ridge of a folded blade.
    const auto add = [&](float x, float ridge, float along) {
        const glm::vec3 centre = shared::bezierPoint(glm::vec3(0.0f), pose.v1, pose.v2, along);
        // Avoid the end: a straight curve may have no derivative there.
        const glm::vec3 speed = shared::bezierTangent(glm::vec3(0.0f), pose.v1, pose.v2, along);
        const glm::vec3 tangent = glm::normalize(glm::dot(speed, speed) > 1e-12f ? speed : pose.v1);
        const glm::vec3 normal(0.0f, 0.0f - tangent.z, tangent.y);
        mesh.positions.push_back(centre + glm::vec3(x, 0.0f, 0.0f) + ridge * normal);
        mesh.normals.push_back(glm::normalize(normal + glm::vec3(species.fold * (x > 0.0f   ? 1.0f
                                                                                 : x < 0.0f ? -1.0f
                                                                                            : 0.0f),
                                                                 0.0f, 0.0f)));
        mesh.uvs.emplace_back(x + 0.5f, along);
        const glm::vec3 color =
            glm::mix(species.rootColor, species.tipColor, glm::smoothstep(-0.15f, 0.8f, along));
        mesh.colors.push_back(glm::clamp(color / divisor, 0.0f, 1.0f));
    };
    const bool isFolded = species.fold > 0.0f;
    const std::uint32_t columns = isFolded ? 3 : 2;
    const std::uint32_t segments = bladeSegments(species.shape);
    for (std::uint32_t row = 0; row <= segments; ++row) {
        const float along = float(row) / float(segments);
        const glm::vec2 edges = shared::outlineAt(species.shape, species.tipThreshold, along);
        const float wide = edges.y - edges.x;
        const bool isPoint = row == segments && wide < 1e-6f;
        if (isPoint) {
            add(0.5f * (edges.x + edges.y), 0.0f, along);
        } else {
            add(edges.x, 0.0f, along);
            if (isFolded)
                add(0.5f * (edges.x + edges.y), 0.5f * species.fold * wide, along);
            add(edges.y, 0.0f, along);
        }
        for (std::uint32_t column = 0; row > 0 && column + 1 < columns; ++column) {
            const std::uint32_t left = (row - 1) * columns + column;
            if (isPoint)
                mesh.indices.insert(mesh.indices.end(), {left, left + 1, row * columns});
            else
                mesh.indices.insert(mesh.indices.end(), {left, left + 1, left + columns + 1, left,
                                                         left + columns + 1, left + columns});
        }
    }
    return mesh;
}

} // namespace sward::interchange
