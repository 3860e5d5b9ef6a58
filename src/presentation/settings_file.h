#pragma once

#include "render/frame/frame_settings.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace sward::presentation {

/// Reads a settings file (docs/settings.md) into `settings`. Absent keys keep their values. Throws
/// Error{io} if it cannot be read, Error{input} that names the key. Returns one warning per key
/// that uses its former name.
std::vector<std::string> readSettings(const std::filesystem::path& path,
                                      render::FrameSettings& settings);

/// The same from a text; messages call it `place`.
std::vector<std::string> readSettings(std::string_view text, const std::string& place,
                                      render::FrameSettings& settings);

} // namespace sward::presentation
