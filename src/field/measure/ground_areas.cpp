// The ground under the leaves of a field, and its convex edges.
#include "field/measure/cover_corners.h"
#include "field/measure/distributions.h"
#include "field/measure/leaf_area.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cstddef>

namespace sward::field {
namespace {

/// Minimum ground per corner, as a share of a cube's face: such values have little weight, and the
/// minimum keeps the division bounded.
constexpr float minGround = 0.02f;

/// Maximum size of pieces of ground, as a share of a cell.
constexpr float pieceSize = 0.5f;

/// Ground around a corner of the grid.
struct GroundPart {
    float area = 0.0f;      ///< [m²]
    glm::vec3 facing{0.0f}; ///< sum of normals, by area
    glm::vec3 places{0.0f}; ///< sum of places relative to the corner, by area, in cells
    float lift = 0.0f;      ///< sum of normal · place, by area
};

class GroundParts {
public:
    explicit GroundParts(const shared::Cover& shape)
        : shape_(shape)
        , parts_(std::size_t(shape.countX) * shape.countY * shape.countZ)
    {
    }

    void deal(glm::vec3 place, glm::vec3 doubleArea)
    {
        const float twice = glm::length(doubleArea);
        if (!(twice > 0.0f))
            return;
        const glm::vec3 normal = doubleArea / twice;
        const glm::vec3 at = (place - shape_.low) * shape_.cellsPerMetre;
        dealToCorners(shape_, place, 0.5f * twice, [&](std::size_t i, float area) {
            const std::size_t row = i / shape_.countX;
            const glm::vec3 corner(float(i % shape_.countX), float(row % shape_.countY),
                                   float(row / shape_.countY));
            GroundPart& part = parts_[i];
            part.area += area;
            part.facing += area * normal;
            part.places += area * (at - corner);
            part.lift += area * glm::dot(normal, at - corner);
        });
    }

    const std::vector<GroundPart>& parts() const { return parts_; }

private:
    shared::Cover shape_;
    std::vector<GroundPart> parts_;
};

/// Distributes a triangle in pieces no longer than `longest`, by halving its longest side.
void dealTriangle(std::array<glm::vec3, 3> corners, float longest, GroundParts& ground)
{
    const auto squared = [&](std::size_t i) {
        const glm::vec3 side = corners[(i + 1) % 3] - corners[i];
        return glm::dot(side, side);
    };
    std::size_t side = 0;
    for (const std::size_t i : {1u, 2u})
        if (squared(i) > squared(side))
            side = i;
    if (!(squared(side) > longest * longest)) {
        ground.deal((corners[0] + corners[1] + corners[2]) / 3.0f,
                    glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
        return;
    }
    const std::size_t next = (side + 1) % 3;
    const glm::vec3 middle = 0.5f * (corners[side] + corners[next]);
    std::array<glm::vec3, 3> half = corners;
    half[next] = middle;
    dealTriangle(half, longest, ground);
    half = corners;
    half[side] = middle;
    dealTriangle(half, longest, ground);
}

void dealGround(const DisplayGround& drawn, float longest, GroundParts& ground)
{
    for (const GroundRange& range : drawn.ranges) {
        if (range.level != 0)
            continue;
        for (std::uint32_t i = 0; i + 2 < range.indexCount; i += 3) {
            const std::uint32_t* const index = &drawn.indices[range.firstIndex + i];
            dealTriangle({drawn.vertices[index[0]].position, drawn.vertices[index[1]].position,
                          drawn.vertices[index[2]].position},
                         longest, ground);
        }
    }
}

/// Angle [rad] by which the ground around a corner falls off over a convex edge; 0 on smooth ground.
float fallOf(const GroundPart& part)
{
    if (!(part.area > 0.0f))
        return 0.0f;
    // The sine of the angle, if the edge runs through the corner. On a ball it is two cells over
    // the radius.
    const float sine =
        6.0f * (part.lift - glm::dot(part.facing, part.places) / part.area) / part.area;
    constexpr float smooth = 0.25f;
    constexpr float sharp = 0.6f;
    return 1.57f * std::min(sine, 1.0f) * glm::smoothstep(smooth, sharp, sine);
}

} // namespace

std::vector<float> groundAreasOf(const FieldView& field, const shared::Cover& shape)
{
    const float edge = 1.0f / shape.cellsPerMetre;
    GroundParts ground(shape);
    dealGround(*field.ground, pieceSize * edge, ground);
    // Over a convex edge leaves fan out: half a blade above it they have that much more room
    // (Steiner's formula for the surface at a distance).
    const float roomPerAngle = 0.5f * meanBladeSize(field).height / edge;
    std::vector<float> areas;
    areas.reserve(ground.parts().size());
    for (const GroundPart& part : ground.parts())
        areas.push_back(std::max(part.area * (1.0f + roomPerAngle * fallOf(part)),
                                 minGround * edge * edge));
    return areas;
}

} // namespace sward::field
