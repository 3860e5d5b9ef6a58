#pragma once

#include "field/field.h"
#include "field/file/blade_pieces.h"

#include <cstdint>
#include <filesystem>

namespace sward::field {

/// Writes `field` to `path` under a temporary name, reads it back, verifies and renames it. Returns
/// the number of bytes. The bytes depend on `field` alone. Throws Error{io} if the file exists and
/// `overwrite` is false, or if the disk rejects the bytes. On error an old file stays intact and no
/// new one is left.
std::uint64_t writeField(const Field& field, const std::filesystem::path& path, bool overwrite);

/// The same for a field whose blades and keys come in pieces; those of `field` are ignored. The
/// file has the bytes that it has if they are in memory. Also throws what `pieces` throw.
/// `seeds`: of the frames of its seeds, if they lie elsewhere; else null.
std::uint64_t writeField(const Field& field, const BladePieces& pieces,
                         const std::filesystem::path& path, bool overwrite,
                         const SeedPieces* seeds = nullptr);

/// Bytes that writeField() would write.
std::uint64_t fieldBytes(const Field& field);

} // namespace sward::field
