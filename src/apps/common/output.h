#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace sward::apps {

/// Writes a result to stdout, control characters of names as \xNN. Throws Error{io} if writing
/// fails (a full disk).
void writeResult(std::string_view text);

/// "3.1 MB": a readable size.
std::string sizeText(std::uint64_t bytes);

/// Checks an output before any work; again after the inputs are loaded, it also knows the files
/// that these name. Throws Error{usage} if its name has another extension than `extension`
/// (".sward"), or if it has been read; Error{io} as requireWritable() does. A name without any
/// extension is taken as it is.
void requireOutput(const std::string& path, std::string_view extension, bool overwrite);

} // namespace sward::apps
