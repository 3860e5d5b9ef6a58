#include "terrain/heightmap/height_samples.h"
#include "terrain/heightmap/heightfield.h"
#include "terrain/maps/map_grid.h"

namespace sward::terrain {

HeightSamples readMapHeights(const std::string& path, Diagnostics& diagnostics)
{
    MapGrid grid = readMap(path, {.maxSamples = heightPointLimit}, "heights", diagnostics);
    requireHeightmapSize(grid.size.x, grid.size.y, path);
    HeightSamples samples;
    samples.size = grid.size;
    samples.isMetric = true;
    samples.values = std::move(grid.values);
    if (grid.step.x > 0.0) {
        samples.step = grid.step;
        // North is -z.
        const glm::dvec2 half = 0.5 * grid.step * glm::dvec2(grid.size - 1U);
        samples.middle = {grid.first.x + half.x, half.y - grid.first.y};
        samples.mapSystem = std::move(grid.system);
    }
    dropNoData(samples, path, diagnostics);
    return samples;
}

} // namespace sward::terrain
