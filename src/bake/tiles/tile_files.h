#pragma once

#include "bake/ground/tile_region.h"
#include "bake/report.h"
#include "bake/tiles/bake_tile.h"
#include "bake/tiles/plan_files.h"
#include "bake/tiles/stored_cells.h"
#include "terrain/ground_mesh.h"
#include "terrain/heightmap/map_parts.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace sward::bake {

// First bytes of the files beside a plan: eight letters each; the last two are the version.
inline constexpr const char* partKind = "SWPART06";   ///< a tile's part of the ground
inline constexpr const char* windowKind = "SWWIND02"; ///< a tile's window of a map
inline constexpr const char* imageKind = "SWIMAG02";  ///< an image of the ground
inline constexpr const char* tileKind = "SWTILE05";   ///< the blades and seeds of a tile

/// A bake distributed over machines: the result of `plan`, needed by every tile. Its file is JSON.
/// The folder beside it holds the parts of the ground, one for each tile, the ground's images and a
/// field without blades.
struct TilePlan {
    std::string id;                     ///< hash of ground, settings and tiles; stored in tiles
    std::vector<std::string> arguments; ///< command line of the bake
    std::string folder;                 ///< base folder of files in the arguments
    std::string paint;                  ///< hash of the strokes; empty without any
    std::vector<PlanFile> files;        ///< what tiles read beside their parts
    std::uint32_t tiles = 0;
    bool hasWindows = false; ///< its parts are windows of the map that the arguments name
    BakePlan plan;
    Report report; ///< of the whole ground, without root counts
};

/// The part of the ground for one tile, and its cells.
struct TilePart {
    terrain::GroundMesh ground;
    terrain::SurfaceFeatures features;
    std::vector<CellNumber> cells;
};

/// Reads and writes the files between plan, tile and merge. Every file appears whole or not at all.
/// Reading throws Error{io} for a missing file and Error{input} for a damaged one.
void writePlan(const std::filesystem::path& path, const TilePlan& plan, bool overwrite);
TilePlan readPlan(const std::filesystem::path& path);

/// The folder of a plan; it holds parts, images and the field without blades.
std::filesystem::path partsFolder(const std::filesystem::path& plan);
std::filesystem::path partPath(const std::filesystem::path& folder, std::uint32_t tile);
std::filesystem::path imagePath(const std::filesystem::path& folder, std::size_t image);
std::filesystem::path barePath(const std::filesystem::path& folder);

/// Writes a part without the pixels of its images, which all parts share.
void writePart(const std::filesystem::path& path, const std::string& id, const TilePart& part);
void writeImages(const std::filesystem::path& folder, const std::string& id,
                 const terrain::GroundMesh& ground);

/// Reads a part with the images that its triangles use.
TilePart readPart(const std::filesystem::path& folder, std::uint32_t tile, const std::string& id);

/// A tile's part of a ground that is a map: what the tile reads of the file.
struct TileWindow {
    terrain::MapWindow window;
    std::array<std::int64_t, 4> columns{}; ///< of 32 m cells: first x and z, last x and z
};

/// Divides the cells of a surveyed map into rectangles of about the same area, and finds the window
/// of each: what lies within `margin` [m] of it. Tiles beyond the number of cells are empty.
std::vector<TileWindow> dealWindows(const terrain::MapSurvey& survey, std::size_t count,
                                    double margin);

void writeWindow(const std::filesystem::path& path, const std::string& id,
                 const TileWindow& window);

/// Reads a window and its ground from the map. Throws as readPart() and terrain::readWindow().
TilePart readWindowPart(const std::filesystem::path& folder, std::uint32_t tile,
                        const std::string& id, terrain::MapHeights& map);

/// Path of a tile's result in the folder of results.
std::filesystem::path tilePath(const std::filesystem::path& folder, std::uint32_t tile);

/// What the file of a tile names: its plan and its number, so that none stands for another.
std::string tileId(const TilePlan& plan, std::uint32_t tile);

void writeTile(const std::filesystem::path& path, const std::string& id, const TileResult& tile);

/// Id of a tile; verifies the whole file.
std::string idOfTile(const std::filesystem::path& path);

/// A tile whose blades and keys stay in its file.
struct StoredTile {
    TileResult tile; ///< with cells that have patches alone, and seeds that have no bytes
    TileStretch stretch;
    std::uint64_t seedBytes = 0; ///< [bytes] where those of the seeds begin
};

/// Verifies the whole file. Also throws Error{input} if the tile has another id, or a blade whose
/// species is not below `species`.
StoredTile readTile(const std::filesystem::path& path, const std::string& id,
                    std::size_t species = shared::maxSpecies);

} // namespace sward::bake
