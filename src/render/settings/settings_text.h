#pragma once

#include "render/frame_settings.h"

#include <string>

namespace sward::render {

/// The settings as text for readSettings(), which restores them. Debug colours and a frozen camera
/// are not included.
std::string settingsText(const FrameSettings& settings);

} // namespace sward::render
