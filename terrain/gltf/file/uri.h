#pragma once

#include "core/diagnostics.h"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sward::terrain {

/// Decodes a data URI, base64 or percent-encoded; none if `uri` is no data URI or is damaged.
std::optional<std::vector<std::byte>> decodeDataUri(std::string_view uri);

/// Whether a URI has the scheme data, in letters of any case.
bool isDataUri(std::string_view uri);

/// Whether a URI or the name of an input names a server: http, https, ftp, s3 and the like. Sward
/// fetches nothing.
bool isOnNetwork(std::string_view uri);

/// Resolves a relative reference, %-sequences decoded, against the folder of `gltf`, by
/// fileOrNear(). An absolute path is appended to that folder, too. `place` names who refers to it.
std::filesystem::path fileBeside(const std::filesystem::path& gltf, std::string_view uri,
                                 const std::string& place, Diagnostics& diagnostics);

} // namespace sward::terrain
