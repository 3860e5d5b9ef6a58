#pragma once

#include "core/progress.h"
#include "field/field.h"
#include "interchange/export_settings.h"

#include <cstdint>
#include <filesystem>

namespace sward::interchange {

/// Bytes of one blade in the binary part of a .glb.
inline constexpr std::uint64_t glbBytesPerBlade = 76;

/// The same of a file for engines, see ExportSettings::forEngines.
inline constexpr std::uint64_t glbBytesPerEngineBlade = 92;

/// Writes a glTF 2.0 binary with EXT_mesh_gpu_instancing. The scene's node has the field's origin
/// as translation; below it is one node per group and species, with that species' blade mesh
/// (docs/exports.md has the attributes). Streams the blades in two passes. Throws
/// Error{unsupported} naming the size, before anything is written, if the file would exceed the 4
/// GiB of its 32-bit length; Error{io}; Error{interrupted}.
void writeGlb(const field::FieldView& field, const std::filesystem::path& path,
              const ExportSettings& settings, Progress& progress);

/// Size check of writeGlb(): throws if `bytes` with `blades` are too large for a .glb.
/// `perBlade`: bytes of each blade.
void refuseLargeGlb(const std::filesystem::path& path, std::uint64_t blades, std::uint64_t bytes,
                    std::uint64_t perBlade = glbBytesPerBlade);

} // namespace sward::interchange
