#pragma once

#include "core/json/settings_json.h"
#include "render/frame/frame_settings.h"

namespace sward::presentation {

/// Reads the keys `culling` and `detail` of a settings file: culling tests, segments and widths,
/// update rates. Throws Error{input}.
std::vector<std::string> readDetail(SettingsReader& reader, render::FrameSettings& settings);

} // namespace sward::presentation
