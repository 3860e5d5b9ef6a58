#pragma once

#include <filesystem>
#include <string>

namespace sward::terrain {

/// Extension of a file in lower case, like ".png".
std::string fileKind(const std::filesystem::path& path);

} // namespace sward::terrain
