#include "render/preview/floor_plane.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace sward::render {
namespace {

constexpr float lowestShare = 0.02f; ///< of the height: corners that may stand on the floor
constexpr float rimBegin = 0.95f;    ///< of the half sides, from the middle
constexpr float minSpread = 0.6f;    ///< of the footprint's sides
constexpr double oneWay = 0.8;       ///< of a sheet's area; half of a closed body's faces up
constexpr float lightReach = 2.5f;   ///< of the floor, in half diagonals of the footprint

/// Of the height, along which a sheet or a body darkens the floor beside it: borders are lower
/// than summits.
constexpr float wallShare = 0.5f;

/// Smallest and largest coordinate along an axis.
struct FloorExtent {
    float low = std::numeric_limits<float>::max();
    float high = std::numeric_limits<float>::lowest();

    void add(float value)
    {
        low = std::min(low, value);
        high = std::max(high, value);
    }
    float length() const { return std::max(high - low, 0.0f); }
    float middle() const { return 0.5f * (low + high); }
};

/// Coordinates along the footprint's sides and upwards.
struct FloorAxes {
    glm::vec3 along, across, up;
};

/// The level axes that are nearest to two axes of the field.
FloorAxes floorAxes(glm::vec3 up)
{
    const glm::vec3 size = glm::abs(up);
    const glm::vec3 side = size.x <= std::min(size.y, size.z) ? glm::vec3(1.0f, 0.0f, 0.0f)
                                                              : glm::vec3(0.0f, 0.0f, 1.0f);
    const glm::vec3 along = glm::normalize(side - up * glm::dot(side, up));
    return {along, glm::cross(up, along), up};
}

bool isSheet(const field::DisplayGround& ground, glm::vec3 up)
{
    double above = 0.0;
    double below = 0.0;
    for (const field::GroundRange& range : ground.ranges) {
        if (range.level != 0)
            continue;
        for (std::size_t i = range.firstIndex; i + 2 < range.firstIndex + range.indexCount;
             i += 3) {
            const glm::vec3 a = ground.vertices[ground.indices[i]].position;
            const glm::vec3 b = ground.vertices[ground.indices[i + 1]].position;
            const glm::vec3 c = ground.vertices[ground.indices[i + 2]].position;
            const double area = double(glm::dot(glm::cross(b - a, c - a), up));
            (area > 0.0 ? above : below) += std::abs(area);
        }
    }
    return std::max(above, below) >= oneWay * (above + below);
}

} // namespace

shared::FloorPlane floorPlaneOf(const field::DisplayGround& ground, glm::vec3 up)
{
    shared::FloorPlane plane{};
    const FloorAxes axes = floorAxes(up);
    FloorExtent along, across, above;
    for (const shared::GroundVertex& vertex : ground.vertices) {
        along.add(glm::dot(vertex.position, axes.along));
        across.add(glm::dot(vertex.position, axes.across));
        above.add(glm::dot(vertex.position, axes.up));
    }
    const float half = 0.5f * std::hypot(along.length(), across.length());
    if (ground.vertices.empty() || !(half > 0.0f) || !std::isfinite(half))
        return plane;

    // Where it stands, how low its rim is, and how far its corners fill the rectangle's.
    FloorExtent foot, footAcross, rim;
    float farthest = 0.0f;
    const glm::vec2 sides = glm::max(0.5f * glm::vec2(along.length(), across.length()), 1e-6f);
    for (const shared::GroundVertex& vertex : ground.vertices) {
        const float x = glm::dot(vertex.position, axes.along);
        const float z = glm::dot(vertex.position, axes.across);
        const float y = glm::dot(vertex.position, axes.up);
        const glm::vec2 at = glm::abs(glm::vec2(x - along.middle(), z - across.middle()) / sides);
        farthest = std::max(farthest, glm::length(at));
        if (std::max(at.x, at.y) >= rimBegin)
            rim.add(y);
        if (y > above.low + lowestShare * above.length())
            continue;
        foot.add(x);
        footAcross.add(z);
    }
    const bool sheet = isSheet(ground, up);
    const bool stands = foot.length() >= minSpread * along.length() &&
                        footAcross.length() >= minSpread * across.length();
    if (!stands && !sheet)
        return plane;

    const float level = sheet ? rim.low : above.low;
    plane.middle = along.middle() * axes.along + across.middle() * axes.across + level * axes.up;
    plane.reach = lightReach * half;
    plane.along = axes.along;
    plane.height = wallShare * (above.high - level);
    plane.halfSides = sides;
    // 1 for an ellipse, √2 for a rectangle.
    const float root = std::sqrt(2.0f);
    plane.cornerRadius =
        std::min(sides.x, sides.y) * std::clamp((root - farthest) / (root - 1.0f), 0.0f, 1.0f);
    return plane;
}

} // namespace sward::render
