#include "field/poses/blade_rows.h"

#include "shaders/shared/bezier.h"
#include "shaders/shared/ribbon.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace sward::field {
namespace {

// Segments in which the chords of a parabola that falls by `fall` widths are within an error: n of
// them stray by fall/(4 n²).
std::uint32_t parabolaSegments(float fall, float error)
{
    return static_cast<std::uint32_t>(std::max(std::ceil(std::sqrt(fall / (4.0f * error))), 1.0f));
}

// Segments that the outline needs in each of its parts.
std::uint32_t outlineSegments(std::uint32_t shape, float error)
{
    switch (shape) {
    case shared::shapeQuadratic:
        return parabolaSegments(1.0f, error);
    case shared::shapeLeaf:
        return parabolaSegments(0.5f, error);
    case shared::shapeStalkLeaf:
        return parabolaSegments(0.75f, error);
    case shared::shapeDandelion:
        return maxSegments;
    default:
        return 1;
    }
}

} // namespace

std::vector<float> rowsOf(const shared::Species& look, const BladePose& pose, float width,
                          const RowErrors& errors)
{
    // L chords of a quadratic Bézier deviate from it by at most |v0 − 2 v1 + v2| / (4 L²).
    const float stray = glm::length(pose.v0 - 2.0f * pose.v1 + pose.v2);
    const float chords =
        std::clamp(std::ceil(std::sqrt(stray / (4.0f * errors.curve * std::max(width, 1e-9f)))),
                   1.0f, float(maxSegments));

    // The outline has a part on either side of its kink, which is a row.
    std::vector<float> ends{0.0f, 1.0f};
    const bool hasKink = look.shape == shared::shapeTriangleTip ||
                         look.shape == shared::shapeLeaf || look.shape == shared::shapeStalkLeaf;
    if (hasKink && look.tipThreshold > 1e-3f && look.tipThreshold < 1.0f - 1e-3f)
        ends = {0.0f, look.tipThreshold, 1.0f};
    if (look.shape == shared::shapeStalkLeaf &&
        std::fabs(look.tipThreshold - shared::baseLength) > 1e-3f) {
        ends.push_back(shared::baseLength);
        std::sort(ends.begin(), ends.end());
    }
    std::vector<float> rows{0.0f};
    for (std::size_t part = 0; part + 1 < ends.size(); ++part) {
        const float length = ends[part + 1] - ends[part];
        const std::uint32_t segments =
            std::max(outlineSegments(look.shape, errors.outline),
                     static_cast<std::uint32_t>(std::ceil(chords * length)));
        for (std::uint32_t i = 1; i <= segments; ++i)
            rows.push_back(i < segments ? ends[part] + length * float(i) / float(segments)
                                        : ends[part + 1]);
    }
    return rows;
}

BladeRow rowAt(const shared::Species& look, const BladePose& pose, float width, float along)
{
    const glm::vec3 centre = shared::bezierPoint(pose.v0, pose.v1, pose.v2, along);
    const glm::vec2 edges = width * shared::outlineAt(look.shape, look.tipThreshold, along);
    BladeRow row;
    row.left = centre + edges.x * pose.axis;
    row.right = centre + edges.y * pose.axis;
    row.ridge = 0.5f * (row.left + row.right);
    if (look.fold > 0.0f) {
        shared::Ribbon ribbon = {};
        ribbon.v0 = pose.v0;
        ribbon.v1 = pose.v1;
        ribbon.v2 = pose.v2;
        const glm::vec3 normal = glm::cross(shared::directionAt(ribbon, along), pose.axis);
        const float size = glm::length(normal);
        if (size > 0.0f)
            row.ridge += (0.5f * look.fold * (edges.y - edges.x) / size) * normal;
    }
    return row;
}

} // namespace sward::field
