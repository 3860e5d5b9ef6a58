#pragma once

#include "core/diagnostics.h"
#include "terrain/ground_mesh.h"

#include <glm/vec2.hpp>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace sward::terrain {

/// Properties missing in a heightmap file. A default gives a warning. See terrain/README.md.
struct HeightmapSettings {
    std::optional<glm::uvec2> size{};   ///< samples along x and z; required for .r16
    std::optional<glm::dvec2> extent{}; ///< [m] along x and z; default 1 m per sample
    std::optional<glm::dvec2> height{}; ///< [m] of a sample value of 0 and of the full value
    std::string holeMask{};             ///< image of any size; black marks holes
    std::string endian{};               ///< little or big, of .r16 .raw .r32; "": little
    std::string encoding{};             ///< terrarium or terrain-rgb, of a .png; "": none
    bool flipRows = false;              ///< the first row of the file lies at +z
    std::optional<double> noData{};     ///< sample value that stands for no height
    std::string mapSystem{}; ///< a map is brought into this system (WKT); "": into its own
};

/// How to convert a file's ground to Sward's world: metres, Y up.
struct ImportSettings {
    std::string upAxis = "y";                ///< axis of the file that points up: x y z -x -y -z
    std::string units = "m";                 ///< m cm mm ft: unit of the file
    double scale = 1.0;                      ///< (0, 1e9]; multiplies after the units
    std::optional<int> scene{};              ///< glTF scene index; else the file's default scene
    std::vector<std::string> bearingNodes{}; ///< globs; if any, only these nodes bear grass
    std::vector<std::string> bearingMaterials{}; ///< globs; if any, only these materials bear grass
    std::vector<std::string> occluderNodes{};    ///< globs; these block rays and bear nothing
    bool mayMatchNothing = false; ///< globs that match nothing are no error: another file's may
    bool bareNames = true; ///< rock, water, roads … of a mesh file bear nothing: bare_names.h
    HeightmapSettings heightmap{}; ///< for heightmaps only
    MaskInputs masks{};            ///< what masks read, beyond what every ground has
};

/// Loads ground from `input`: an existing file by its extension (.glb .gltf .obj .ply .stl .off, a
/// heightmap .png .r16 .exr, or a recipe .json), else a built-in by name (plane sphere hills dunes
/// torus arch). The result is valid, recentred and has normals. Throws Error{usage} for a setting
/// that is missing or does not fit, Error{io, input, unsupported}.
GroundMesh load(const std::string& input, const ImportSettings& settings, Diagnostics& diagnostics);

/// XXH3 over everything that affects a root (origin, positions, normals, colours, triangles,
/// roles), as 16 hex digits. Equal hashes mean that two bakes used the same ground.
std::string contentHash(const GroundMesh& mesh);

/// XXH3 over the files of a map, as 16 hex digits: `path`, and what may lie beside it (of a
/// Shapefile .shx .dbf .prj .cpg, of a raster .tfw .wld .ovr .msk .aux.xml). Of a file of more than
/// 256 MB: its size and 256 pieces of 1 MB at even steps, with the first and the last byte. So a
/// change in place between them is not noticed. Throws Error{io} if it cannot be read.
std::string mapFileHash(const std::filesystem::path& path);

/// The same over what materials and images contribute to it.
std::uint64_t appearanceHash(const GroundMesh& mesh);

/// Whether `text` matches a glob with * and ?, letters compared exactly.
bool globMatches(const std::string& glob, const std::string& text);

} // namespace sward::terrain
