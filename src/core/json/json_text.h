#pragma once

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <string_view>

namespace sward {

/// JSON as text, on one line, or with `indent` spaces for each level. File names are bytes and need
/// not be UTF-8: each byte that is not is written as U+FFFD, as JSON has no other form for it.
/// No control
/// character is written as it is. All JSON is written by this. Include from .cpp files only.
std::string jsonText(const nlohmann::json& value, int indent = -1);
std::string jsonText(const nlohmann::ordered_json& value, int indent = -1);

/// `bytes` with U+FFFD for each that is not UTF-8, for formats that hold UTF-8 only.
std::string toUtf8(std::string_view bytes);

/// Whether `bytes` are UTF-8.
bool isUtf8(std::string_view bytes);

/// A text whose bytes must be found again, such as a file name: a string if it is UTF-8, else
/// {"percent": TEXT}, in which "%" and each byte that is not printable ASCII are %XX.
nlohmann::json bytesToJson(std::string_view bytes);

/// The inverse of bytesToJson(). Throws Error{input} naming `place` for any other value.
std::string bytesFromJson(const nlohmann::json& value, const std::string& place);

} // namespace sward
