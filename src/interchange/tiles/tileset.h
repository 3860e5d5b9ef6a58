#pragma once

#include "core/progress.h"
#include "field/field.h"
#include "interchange/export_settings.h"

#include <cstdint>
#include <filesystem>

namespace sward::interchange {

/// A tile with more blades than this has children, and shows a part of them itself. The meshes of
/// plants, of which each tile has its own, then take about a sixth of a tile.
inline constexpr std::uint64_t largestTile = 65536;

/// Blades that a tile with children shows, about.
inline constexpr std::uint64_t tileRepresentatives = 32768;

/// Largest factor by which the blades of a tile with children are widened. Beyond it they cover
/// less than all blades would, instead of looking like boards.
inline constexpr float largestWidening = 8.0f;

/// Pixels that an error of a tile may have, as viewers default to (maximumScreenSpaceError). Where
/// a tile is refined, its blades are about a pixel wide.
inline constexpr double viewerErrorPixels = 16.0;

/// What writeTiles() has written.
struct TilesetSummary {
    std::uint64_t tiles = 0;  ///< with content
    std::uint64_t blades = 0; ///< in all tiles, those of inner ones included
    std::uint64_t bytes = 0;  ///< of contents
};

/// Writes a tileset of 3D Tiles 1.1 into the empty folder `folder`: tileset.json with implicit
/// tiling (OCTREE), subtrees/ and content/, compact .glb files (compact/compact_glb.h). Tiles are
/// replaced by their children. A leaf holds all blades of its cube; any other tile holds those of
/// the lowest ranks, widened so that they cover as much, in coarse meshes. With ExportSettings::map
/// the field is bent onto the Earth (EarthBend). Holds one tile at a time. Throws Error{io},
/// Error{interrupted}, and as bladeOf() and EarthBend() do.
TilesetSummary writeTiles(const field::FieldView& field, const std::filesystem::path& folder,
                          const ExportSettings& settings, Progress& progress);

} // namespace sward::interchange
