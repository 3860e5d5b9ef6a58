#include "interchange/blade_mesh.h"

#include "shaders/shared/bezier.h"
#include "shaders/shared/organ.h"
#include "shaders/shared/physics.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>

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

std::uint32_t bladeSegments(std::uint32_t shape, BladeDetail detail)
{
    const bool isCoarse = detail == BladeDetail::coarse;
    if (shape == shared::shapeDandelion)
        return static_cast<std::uint32_t>(shared::dandelionLobes *
                                          (isCoarse ? 1 : shared::segmentsPerLobe));
    return isCoarse ? coarseSegments : 4;
}

namespace {

// A ribbon to be meshed: its curve, the direction across and the width.
struct Strip {
    glm::vec3 v0, v1, v2;
    glm::vec3 axis; // unit
    float width;
    float ridge; // width in the unit of heights, for what stands out of the ribbon
    float side;  // the same of normals: what a scale divides them by across, relative to along
};

// Appends a ribbon in the colours of `look`; mesh.baseColor must be set.
void append(BladeMesh& mesh, const Strip& strip, const shared::Species& look, BladeDetail detail)
{
    mesh.largestBend =
        std::max(mesh.largestBend, glm::length(strip.v0 - 2.0f * strip.v1 + strip.v2));
    // A channel that is 0 at both ends stays 0.
    const glm::vec3 divisor = glm::max(mesh.baseColor, glm::vec3(1e-6f));
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());

    // A row has two edges, and between them the ridge of a folded blade.
    const auto add = [&](float x, float ridge, float along) {
        const glm::vec3 centre = shared::bezierPoint(strip.v0, strip.v1, strip.v2, along);
        // A straight curve may have no derivative at its end.
        const glm::vec3 speed = shared::bezierTangent(strip.v0, strip.v1, strip.v2, along);
        const glm::vec3 tangent =
            glm::normalize(glm::dot(speed, speed) > 1e-12f ? speed : strip.v1 - strip.v0);
        const glm::vec3 normal = glm::cross(strip.axis, tangent);
        mesh.positions.push_back(centre + strip.width * x * strip.axis +
                                 strip.ridge * ridge * normal);
        const float side = x > 0.0f ? 1.0f : x < 0.0f ? -1.0f : 0.0f;
        mesh.normals.push_back(glm::normalize(normal + look.fold * side * strip.side * strip.axis));
        mesh.uvs.emplace_back(x + 0.5f, along);
        const glm::vec3 color =
            glm::mix(look.rootColor, look.tipColor, glm::smoothstep(-0.15f, 0.8f, along));
        mesh.colors.push_back(glm::clamp(color / divisor, 0.0f, 1.0f));
    };
    const bool isFolded = look.fold > 0.0f && detail == BladeDetail::full;
    const std::uint32_t columns = isFolded ? 3 : 2;
    const std::uint32_t segments = bladeSegments(look.shape, detail);
    for (std::uint32_t row = 0; row <= segments; ++row) {
        const float along = float(row) / float(segments);
        const glm::vec2 edges = shared::outlineAt(look.shape, look.tipThreshold, along);
        const float wide = edges.y - edges.x;
        const bool isPoint = row == segments && wide < 1e-6f;
        if (isPoint) {
            add(0.5f * (edges.x + edges.y), 0.0f, along);
        } else {
            add(edges.x, 0.0f, along);
            if (isFolded)
                add(0.5f * (edges.x + edges.y), 0.5f * look.fold * wide, along);
            add(edges.y, 0.0f, along);
        }
        for (std::uint32_t column = 0; row > 0 && column + 1 < columns; ++column) {
            const std::uint32_t left = first + (row - 1) * columns + column;
            if (isPoint)
                mesh.indices.insert(mesh.indices.end(), {left, left + 1, first + row * columns});
            else
                mesh.indices.insert(mesh.indices.end(), {left, left + 1, left + columns + 1, left,
                                                         left + columns + 1, left + columns});
        }
    }
}

} // namespace

BladeMesh bladeMesh(const field::Species& species, const field::Defaults& defaults,
                    const MeanBlade& mean, BladeDetail detail)
{
    const shared::Pose pose = restPose(defaults, mean.stiffness);
    BladeMesh mesh;
    mesh.baseColor = glm::max(species.look.rootColor, species.look.tipColor);
    for (const field::Organ& organ : species.organs)
        mesh.baseColor =
            glm::max(mesh.baseColor, glm::max(organ.look.rootColor, organ.look.tipColor));
    // The instances of a blade are scaled by its width across, and by its height otherwise.
    const bool isBlade = species.organs.empty();
    append(mesh,
           {glm::vec3(0.0f), pose.v1, pose.v2, glm::vec3(1.0f, 0.0f, 0.0f),
            isBlade ? 1.0f : mean.slenderness, mean.slenderness, isBlade ? mean.slenderness : 1.0f},
           species.look, detail);

    // The plant's frame is that of field::bladeRotation(): its width axis points to −X.
    shared::PosedBlade stalk = {};
    stalk.blade.up = glm::vec3(0.0f, 1.0f, 0.0f);
    stalk.blade.height = 1.0f;
    stalk.v1 = pose.v1;
    stalk.v2 = pose.v2;
    stalk.axis = glm::vec3(-1.0f, 0.0f, 0.0f);
    std::uint32_t number = 1;
    for (const field::Organ& organ : species.organs) {
        const shared::Organ device = field::deviceOrgan(organ);
        for (std::uint32_t i = 0; i < organ.count; ++i, ++number) {
            const shared::PosedBlade ribbon = shared::posedRibbon(stalk, device, number, i);
            const float width = organ.width * ribbon.blade.height;
            append(mesh, {ribbon.v0, ribbon.v1, ribbon.v2, ribbon.axis, width, width, 1.0f},
                   organ.look, detail);
        }
    }
    return mesh;
}

} // namespace sward::interchange
