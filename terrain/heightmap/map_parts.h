#pragma once

#include "core/diagnostics.h"
#include "terrain/ground_mesh.h"
#include "terrain/heightmap/heightfield.h"
#include "terrain/load.h"
#include "terrain/maps/map_grid.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace sward::terrain {

// Ground of a GeoTIFF that is read by windows: heights beyond heightPointLimit fit into no memory.

/// The setting that ground by windows does not know, as an option; empty: all are known.
std::string windowlessOption(const ImportSettings& settings);

/// The heights of a GeoTIFF, window by window.
class MapHeights {
public:
    /// Throws as readMap(), and Error{input} for less than 2 samples on a side and for more than
    /// 2 thousand million in all.
    MapHeights(const std::string& path, const ImportSettings& settings, Diagnostics& diagnostics);

    const std::string& path() const { return path_; }
    const ImportSettings& settings() const { return settings_; }
    const HeightGrid& grid() const { return grid_; }
    const std::string& system() const { return system_; } ///< GroundMesh::mapSystem

    /// Heights [m] of `points` columns and rows from `first` on, as one ground of the file has
    /// them; NaN: none. Throws Error{input} if the file is damaged.
    std::vector<double> read(glm::uvec2 first, glm::uvec2 points);

private:
    std::string path_;
    ImportSettings settings_;
    std::unique_ptr<MapRaster> raster_;
    HeightGrid grid_;
    std::string system_;
};

/// What a plan of tiles knows of the whole ground of a map.
struct MapSurvey {
    /// Sides of the blocks below, in cells and in samples.
    static constexpr std::uint32_t block = 32;

    HeightGrid grid;
    std::string system;            ///< GroundMesh::mapSystem
    glm::dvec3 origin{0.0};        ///< as GroundMesh
    glm::dvec3 low{0.0};           ///< [m] of the ground's box in the world
    glm::dvec3 high{0.0};          ///< [m] the same
    std::uint64_t triangles = 0;   ///< of the whole ground
    std::uint64_t missing = 0;     ///< samples without a height
    double area = 0.0;             ///< [m²] of the surface
    std::uint64_t heightsHash = 0; ///< of all heights

    std::vector<std::uint64_t> firstOfRow;      ///< triangle of each row of cells
    std::vector<std::uint8_t> trianglesOfBlock; ///< of each row's blocks; empty: all are full
    std::vector<std::uint64_t> checks;          ///< hash of each block of samples, by rows

    /// Ground of every `stride`-th sample, for what an estimate suffices: where the whole has more
    /// samples than a ground may have. It lies on no place above the whole ground.
    GroundMesh overview;
    std::uint32_t stride = 1; ///< 1: no overview
    double lowered = 0.0;     ///< [m] the most that it was lowered for that
};

/// Reads all heights once, some rows at a time. Makes an overview of at most `overviewPoints` if
/// there are more than `limit` samples. Throws as MapHeights, and Error{input} if there is no
/// ground.
MapSurvey surveyMap(MapHeights& heights, std::size_t limit, std::size_t overviewPoints);

/// A part of the ground of a map: all that a program needs beside the file.
struct MapWindow {
    HeightGrid grid;                          ///< of the whole map
    std::string system;                       ///< MapSurvey::system
    glm::uvec2 firstCell{0U};                 ///< of the grid
    glm::uvec2 cells{0U};                     ///< along x and z; 0: none
    glm::dvec3 origin{0.0};                   ///< of the whole ground
    std::vector<std::uint32_t> firstTriangle; ///< of each row of cells, in the whole ground
    std::vector<std::uint64_t> checks;        ///< MapSurvey::checks of all blocks that are read
};

/// The window of the cells that a rectangle touches, low and high in x and z of the world [m], and
/// of cells to the west, so that triangles are counted by blocks.
MapWindow windowOf(const MapSurvey& survey, glm::dvec2 low, glm::dvec2 high);

/// The ground of a window, as a part of the whole ground. Throws as MapHeights, and Error{input}
/// that says what differs if the file has another grid or system than in the survey, or another
/// height among those that are read.
GroundMesh readWindow(MapHeights& heights, const MapWindow& window);

} // namespace sward::terrain
