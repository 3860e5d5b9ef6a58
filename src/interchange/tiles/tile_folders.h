#pragma once

#include <filesystem>

namespace sward::interchange {

/// Makes the folder that `file` is to lie in, and those above it. Throws Error{io}.
void makeFolderFor(const std::filesystem::path& file);

} // namespace sward::interchange
