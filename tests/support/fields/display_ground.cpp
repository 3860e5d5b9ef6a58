#include "support/fields/display_ground.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <functional>
#include <numbers>

namespace sward::test {
namespace {

struct Corner {
    glm::vec3 position;
    glm::vec3 normal;
};

/// A grid of `columns` × `rows` quads over the unit square, counter-clockwise seen from its normal.
field::DisplayGround grid(std::uint32_t columns, std::uint32_t rows,
                          const std::function<Corner(float, float)>& corner)
{
    field::DisplayGround ground;
    for (std::uint32_t row = 0; row <= rows; ++row) {
        for (std::uint32_t column = 0; column <= columns; ++column) {
            const float u = static_cast<float>(column) / static_cast<float>(columns);
            const float v = static_cast<float>(row) / static_cast<float>(rows);
            const Corner place = corner(u, v);
            ground.vertices.push_back({place.position, shared::encodeNormal32(place.normal),
                                       glm::vec2(u, v), 0xffffffffu});
        }
    }
    for (std::uint32_t row = 0; row < rows; ++row) {
        for (std::uint32_t column = 0; column < columns; ++column) {
            const std::uint32_t first = row * (columns + 1) + column;
            const std::uint32_t below = first + columns + 1;
            for (const std::uint32_t index : {first, below, below + 1, first, below + 1, first + 1})
                ground.indices.push_back(index);
        }
    }
    ground.ranges = {{0, 0, 0, static_cast<std::uint32_t>(ground.indices.size())}};
    // Dry soil.
    ground.materials = {{glm::vec4(0.085f, 0.062f, 0.035f, 1.0f), 1.0f, 0.0f, shared::noImage, 0}};
    return ground;
}

} // namespace

field::DisplayGround planeGround(float extent)
{
    return grid(16, 16, [extent](float u, float v) {
        return Corner{glm::vec3(extent * (u - 0.5f), 0.0f, extent * (v - 0.5f)),
                      glm::vec3(0.0f, 1.0f, 0.0f)};
    });
}

field::DisplayGround sphereGround(float diameter)
{
    constexpr float pi = std::numbers::pi_v<float>;
    return grid(64, 32, [diameter](float u, float v) {
        const glm::vec3 normal(std::sin(pi * v) * std::cos(2.0f * pi * u), std::cos(pi * v),
                               -std::sin(pi * v) * std::sin(2.0f * pi * u));
        return Corner{0.5f * diameter * normal, glm::normalize(normal)};
    });
}

} // namespace sward::test
