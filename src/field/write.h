#pragma once

#include "field/field.h"

#include <cstdint>
#include <filesystem>

namespace sward::field {

/// Writes `field` to `path`: under a temporary name, read back and verified, then renamed. Returns
/// the number of bytes. The bytes depend on `field` alone. Throws Error{io} if the file exists and
/// `overwrite` is false or the disk does not take it; then nothing is left and an old file is
/// whole.
std::uint64_t writeField(const Field& field, const std::filesystem::path& path, bool overwrite);

/// Bytes that writeField() would write.
std::uint64_t fieldBytes(const Field& field);

} // namespace sward::field
