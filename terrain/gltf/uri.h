#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sward::terrain {

/// Decodes a data URI, base64 or percent-encoded; none if `uri` is no data URI or is damaged.
std::optional<std::vector<std::byte>> decodeDataUri(std::string_view uri);

inline bool isDataUri(std::string_view uri)
{
    return uri.substr(0, 5) == "data:";
}

/// Whether a URI or the name of an input names a server: http, https, ftp, s3 and the like. Sward
/// fetches nothing.
bool isOnNetwork(std::string_view uri);

/// Resolves a relative reference, %-sequences decoded, against the folder of `gltf`. An absolute
/// path is appended to that folder, too.
std::filesystem::path fileBeside(const std::filesystem::path& gltf, std::string_view uri);

} // namespace sward::terrain
