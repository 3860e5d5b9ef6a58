#pragma once

#include "render/frame_settings.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace sward::render {

/// Reads a settings file (docs/settings.md) over `settings`: what it does not name stays. Throws
/// Error{io} if it cannot be read, Error{input} that names the key. Returns one warning for each
/// key that is written by its former name.
std::vector<std::string> readSettings(const std::filesystem::path& path, FrameSettings& settings);

/// The same from a text; `place` names it in messages.
std::vector<std::string> readSettings(std::string_view text, const std::string& place,
                                      FrameSettings& settings);

} // namespace sward::render
