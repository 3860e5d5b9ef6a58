#pragma once

#include "render/frame_settings.h"

#include <string>

namespace sward::render {

/// The settings as the text of a file that readSettings() reads: the same settings again, but for
/// debug colours and a frozen camera, which no file keeps.
std::string settingsText(const FrameSettings& settings);

} // namespace sward::render
