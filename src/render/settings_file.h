#pragma once

#include "render/frame_settings.h"

#include <filesystem>

namespace sward::render {

/// Reads a settings file (docs/settings.md) over `settings`: what it does not name stays. Throws
/// Error{io} if it cannot be read, Error{input} that names the key.
void readSettings(const std::filesystem::path& path, FrameSettings& settings);

} // namespace sward::render
