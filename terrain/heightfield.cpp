#include "terrain/heightfield.h"

#include "core/expect.h"
#include "terrain/soup.h"

#include <glm/geometric.hpp>

#include <cmath>

namespace sward::terrain {

GroundMesh heightfield(const HeightGrid& grid,
                       const std::function<double(double x, double z)>& height)
{
    expect(grid.cells.x > 0 && grid.cells.y > 0, "a heightfield needs cells");
    const std::size_t columns = grid.cells.x + 1;
    const std::size_t rows = grid.cells.y + 1;
    const glm::dvec2 cells(grid.cells);
    const glm::dvec2 step = grid.extent / cells;

    // Heights first: normals look at their neighbours. Grid line i lies at extent·(i/cells − 1/2).
    const auto x = [&](std::size_t i) {
        return grid.extent.x * (static_cast<double>(i) / cells.x - 0.5);
    };
    const auto z = [&](std::size_t j) {
        return grid.extent.y * (static_cast<double>(j) / cells.y - 0.5);
    };
    std::vector<double> heights(columns * rows);
    for (std::size_t j = 0; j < rows; ++j)
        for (std::size_t i = 0; i < columns; ++i)
            heights[j * columns + i] = height(x(i), z(j));

    Soup soup;
    for (std::size_t j = 0; j < rows; ++j)
        for (std::size_t i = 0; i < columns; ++i) {
            soup.positions.emplace_back(x(i), heights[j * columns + i], z(j));
            soup.uvs.emplace_back(glm::dvec2(i, j) / cells);

            // Slopes over the two cells beside the point, or the one there is.
            const std::size_t left = i == 0 ? 0 : i - 1;
            const std::size_t right = std::min(i + 1, columns - 1);
            const std::size_t near = j == 0 ? 0 : j - 1;
            const std::size_t far = std::min(j + 1, rows - 1);
            const double slopeX = (heights[j * columns + right] - heights[j * columns + left]) /
                                  (static_cast<double>(right - left) * step.x);
            const double slopeZ = (heights[far * columns + i] - heights[near * columns + i]) /
                                  (static_cast<double>(far - near) * step.y);
            const glm::dvec3 normal(-slopeX, 1.0, -slopeZ);
            soup.normals.emplace_back(normal / std::sqrt(glm::dot(normal, normal)));
        }

    for (std::uint32_t j = 0; j < grid.cells.y; ++j)
        for (std::uint32_t i = 0; i < grid.cells.x; ++i) {
            const std::uint32_t a = j * (grid.cells.x + 1) + i;
            const std::uint32_t b = a + 1;
            const std::uint32_t c = a + grid.cells.x + 1;
            const std::uint32_t d = c + 1;
            // Seen from above, anti-clockwise.
            soup.triangles.emplace_back(a, c, b);
            soup.triangles.emplace_back(b, c, d);
        }
    return settle(std::move(soup), "heightfield");
}

} // namespace sward::terrain
