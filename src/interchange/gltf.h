#pragma once

#include "core/progress.h"
#include "field/field.h"
#include "interchange/export_settings.h"

#include <cstdint>
#include <filesystem>

namespace sward::interchange {

/// Bytes of the binary part that one blade takes in a .glb.
inline constexpr std::uint64_t glbBytesPerBlade = 76;

/// Writes a glTF 2.0 binary with EXT_mesh_gpu_instancing: the scene's node holds the field's origin
/// as its translation, below it one node for each group of blades and species, whose mesh is that
/// species' blade (docs/exports.md has the attributes). Blades are streamed; two passes over them.
/// Throws Error{unsupported}, naming the bytes, before anything is written if the file would be
/// larger than 4 GiB, which its 32-bit length cannot say; Error{io}; Error{interrupted}.
void writeGlb(const field::FieldView& field, const std::filesystem::path& path,
              const ExportSettings& settings, Progress& progress);

/// The check of writeGlb: throws unless a file of `bytes` with `blades` can be a .glb.
void refuseLargeGlb(const std::filesystem::path& path, std::uint64_t blades, std::uint64_t bytes);

} // namespace sward::interchange
