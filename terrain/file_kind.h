#pragma once

#include <filesystem>
#include <string>

namespace sward::terrain {

/// By which a file's kind is told: its extension in lower case, like ".png".
std::string fileKind(const std::filesystem::path& path);

} // namespace sward::terrain
