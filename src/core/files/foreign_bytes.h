#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace sward {

/// Text without the UTF-8 byte order mark at its beginning.
std::string_view withoutMark(std::string_view text);

/// Throws if the first bytes of a file show a form that no reader takes: Error{input} with what to
/// do for what is compressed or archived (gzip, zip, 7z, xz, zstd, bzip2), for UTF-16 text and
/// pointers of git-LFS; Error{unsupported} for models and images of other programs (FBX, Blender,
/// USD, TIFF). `place` names the file.
void refuseForeign(std::span<const std::byte> file, const std::string& place);

} // namespace sward
