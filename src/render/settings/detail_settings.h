#pragma once

#include "core/settings_json.h"
#include "render/frame_settings.h"

namespace sward::render {

/// Reads the keys `culling` and `detail` of a settings file: culling tests, segments and widths,
/// update rates. Throws Error{input}.
std::vector<std::string> readDetail(SettingsReader& reader, FrameSettings& settings);

} // namespace sward::render
