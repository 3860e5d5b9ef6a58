#pragma once

#include "core/diagnostics.h"
#include "terrain/ground_mesh.h"
#include "terrain/heightmap/height_samples.h"
#include "terrain/load.h"

#include <filesystem>
#include <string>

namespace sward::terrain {

/// Whether a file is read as a heightmap, by its extension.
bool isHeightmap(const std::filesystem::path& path);

/// Whether a heightmap has no header, so that its first bytes tell nothing: .r16 .raw .r32 .hgt.
bool isRawHeightmap(const std::filesystem::path& path);

/// Whether a heightmap is a GeoTIFF, .tif or .tiff, which says where it lies.
bool isMapRaster(const std::filesystem::path& path);

/// Reads a heightmap (.png .r16 .raw .r32 .hgt .asc .exr) as ground around the world's origin, or a
/// GeoTIFF where its map has it: x to the east, z to the south. The
/// image's upper left corner is at −x and −z; texture coordinates go once over the whole. A missing
/// setting gets a default and a warning that names the option. Throws Error{usage} naming an option
/// that is missing or does not match, Error{io, input, unsupported}.
GroundMesh importHeightmap(const std::filesystem::path& path, const HeightmapSettings& settings,
                           Diagnostics& diagnostics);

/// Throws Error{usage} naming `place` and the setting that would move or turn over a map that says
/// where it lies.
void requireUnmoved(const ImportSettings& settings, const std::string& place);

/// The ground of samples that have been read; `place` names them in messages.
GroundMesh groundOf(HeightSamples&& samples, const HeightmapSettings& settings,
                    const std::string& place, Diagnostics& diagnostics);

} // namespace sward::terrain
