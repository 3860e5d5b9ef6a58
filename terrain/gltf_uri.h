#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sward::terrain {

/// The bytes of a data URI, in base64 or as they are; nothing if `uri` is none or is damaged.
std::optional<std::vector<std::byte>> decodeDataUri(std::string_view uri);

inline bool isDataUri(std::string_view uri)
{
    return uri.substr(0, 5) == "data:";
}

/// The file that a relative reference names, %-sequences decoded, seen from the glTF file `gltf`.
/// It lies beside or below it as far as the text says: never elsewhere for being absolute.
std::filesystem::path fileBeside(const std::filesystem::path& gltf, std::string_view uri);

} // namespace sward::terrain
