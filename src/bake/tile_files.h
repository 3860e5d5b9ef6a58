#pragma once

#include "bake/bake_steps.h"
#include "bake/bake_tile.h"
#include "bake/tile_region.h"
#include "terrain/ground_mesh.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace sward::bake {

/// A bake that is spread over machines: what `plan` settles and every tile needs. Its file is JSON;
/// beside it, in its folder, lie the parts of the ground, one for each tile, the ground's images
/// and a field without blades.
struct TilePlan {
    std::string id;                     ///< of ground, settings and tiles; tiles carry it
    std::vector<std::string> arguments; ///< of the bake, to be read again
    std::string folder;                 ///< in which files of the arguments are looked for
    std::uint32_t tiles = 0;
    BakePlan plan;
    Report report; ///< of the whole ground; nothing yet of its roots
};

/// The part of the ground that a tile needs, and its cells.
struct TilePart {
    terrain::GroundMesh ground;
    terrain::SurfaceFeatures features;
    std::vector<CellNumber> cells;
};

/// Reads and writes what lies on the disk between plan, tile and merge. Every file appears whole or
/// not at all. Reading throws Error{io} for what is missing and Error{input} for what is damaged.
void writePlan(const std::filesystem::path& path, const TilePlan& plan, bool overwrite);
TilePlan readPlan(const std::filesystem::path& path);

/// The folder of a plan, and what lies in it: parts, images, the field without blades.
std::filesystem::path partsFolder(const std::filesystem::path& plan);
std::filesystem::path partPath(const std::filesystem::path& folder, std::uint32_t tile);
std::filesystem::path imagePath(const std::filesystem::path& folder, std::size_t image);
std::filesystem::path barePath(const std::filesystem::path& folder);

/// Writes a part but not the pixels of its images, which all parts share.
void writePart(const std::filesystem::path& path, const std::string& id, const TilePart& part);
void writeImages(const std::filesystem::path& folder, const std::string& id,
                 const terrain::GroundMesh& ground);

/// Reads a part, with those images that its triangles show.
TilePart readPart(const std::filesystem::path& folder, std::uint32_t tile, const std::string& id);

/// Where the result of a tile lies in the folder of results.
std::filesystem::path tilePath(const std::filesystem::path& folder, std::uint32_t tile);

void writeTile(const std::filesystem::path& path, const std::string& id, const TileResult& tile);

/// Id of the plan that a tile belongs to; the whole file is verified.
std::string planOfTile(const std::filesystem::path& path);

/// Throws Error{input} too if the tile belongs to another plan.
TileResult readTile(const std::filesystem::path& path, const std::string& id);

} // namespace sward::bake
