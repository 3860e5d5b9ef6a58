#pragma once

#include "render/frame/frame_settings.h"

#include <string>

namespace sward::presentation {

/// The settings as text for readSettings(), which restores them. Debug colours and a frozen camera
/// are not included.
std::string settingsText(const render::FrameSettings& settings);

} // namespace sward::presentation
