#pragma once

#include "core/diagnostics.h"

#include <filesystem>
#include <string>
#include <string_view>

namespace sward::terrain {

/// The file `name` in `folder`, for names that another system wrote. If there is none, takes the
/// one whose name differs by \ for / or by the case of letters, with a warning that begins with
/// `place`; else `folder`/`name`, which does not exist.
std::filesystem::path fileOrNear(const std::filesystem::path& folder, std::string_view name,
                                 const std::string& place, Diagnostics& diagnostics);

/// "; did you mean NAME?" with the nearest name in the folder of a missing file, or nothing.
std::string nearFileHint(const std::filesystem::path& missing);

} // namespace sward::terrain
