#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

/// Entry points of fuzzers and of corpus replays: one function per kind of external input. For any
/// bytes it returns, either with a valid object or after an sward::Error; a bad file may not end in
/// any other way.
namespace sward::fuzz {

using Bytes = std::span<const std::uint8_t>;

void fieldDelta(Bytes bytes);      ///< a delta of a field; its hash is repaired first
void fieldReader(Bytes bytes);     ///< a field file; its hashes are repaired first
void gltfImport(Bytes bytes);      ///< a .glb or .gltf
void heightmapImport(Bytes bytes); ///< the first bytes choose format, size and a mask
void mask(Bytes bytes);            ///< the first bytes choose: an image and a channel, or words
void meadow(Bytes bytes);          ///< a meadow file
void meshImport(Bytes bytes);      ///< the first byte chooses among OBJ, PLY, STL and OFF
void poses(Bytes bytes);           ///< a dump of the blades of a field of posesBlades
void recipe(Bytes bytes);          ///< a terrain recipe
void settings(Bytes bytes);        ///< a settings file of the viewer
void strokes(Bytes bytes);         ///< a file of painted strokes
void tileFiles(Bytes bytes);       ///< the first byte chooses: part, tile, image, plan

/// Id of the plan that the files of tileFiles() belong to.
inline constexpr const char* tileFilesId = "fuzz";

/// Number of blades of the field that poses() reads dumps of.
inline constexpr std::size_t posesBlades = 24;

/// A corpus in tests/fuzz/corpus and the function for it.
struct Entry {
    const char* name;
    void (*call)(Bytes bytes);
    bool followsData; ///< memory is bounded by the bytes of the input (memory_law.h): nothing
                      ///< unpacks
};

inline constexpr Entry entries[] = {
    {"field_delta", fieldDelta, true},
    {"field_reader", fieldReader, false},
    {"gltf_import", gltfImport, true},
    {"heightmap_import", heightmapImport, false},
    {"mask", mask, false},
    {"meadow", meadow, true},
    {"mesh_import", meshImport, true},
    {"poses", poses, true},
    {"recipe", recipe, false},
    {"settings", settings, true},
    {"strokes", strokes, true},
    {"tile_files", tileFiles, false},
};

} // namespace sward::fuzz
