#include "terrain/heightmap/height_samples.h"
#include "terrain/heightmap/heightfield.h"
#include "terrain/maps/map_grid.h"

namespace sward::terrain {

HeightGrid placeOf(const MapGrid& map)
{
    HeightGrid grid;
    grid.cells = map.size - 1U;
    const bool hasPlace = map.step.x > 0.0;
    grid.extent = (hasPlace ? map.step : glm::dvec2(1.0)) * glm::dvec2(grid.cells);
    // North is -z.
    const glm::dvec2 half = 0.5 * map.step * glm::dvec2(grid.cells);
    if (hasPlace)
        grid.middle = {map.first.x + half.x, half.y - map.first.y};
    return grid;
}

HeightSamples readMapHeights(const std::string& path, const std::string& system,
                             Diagnostics& diagnostics)
{
    MapRequest request{.maxSamples = heightPointLimit};
    if (!system.empty())
        request.system = system;
    MapGrid grid = readMap(path, request, heightsOption, diagnostics);
    requireHeightmapSize(grid.size.x, grid.size.y, path);
    HeightSamples samples;
    samples.size = grid.size;
    samples.isMetric = true;
    samples.values = std::move(grid.values);
    if (grid.step.x > 0.0) {
        samples.hasPlace = true;
        samples.step = grid.step;
        samples.middle = placeOf(grid).middle;
        samples.mapSystem = std::move(grid.system);
    }
    dropNoData(samples, path, diagnostics);
    return samples;
}

} // namespace sward::terrain
