#pragma once

#include "render/frame_settings.h"

#include <filesystem>
#include <string>
#include <string_view>

namespace sward::render {

/// Reads a settings file (docs/settings.md) over `settings`: what it does not name stays. Throws
/// Error{io} if it cannot be read, Error{input} that names the key.
void readSettings(const std::filesystem::path& path, FrameSettings& settings);

/// The same from a text; `place` names it in messages.
void readSettings(std::string_view text, const std::string& place, FrameSettings& settings);

} // namespace sward::render
