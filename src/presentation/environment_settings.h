#pragma once

#include "render/frame/frame_settings.h"

#include <cstdint>
#include <string_view>

namespace sward {
class SettingsReader;
} // namespace sward

namespace sward::presentation {

/// Reads the keys "wind", "gravity", "recovery" and "colliders" of a settings file. Absent keys
/// keep their values. docs/settings.md. Throws Error{input}.
void readEnvironment(SettingsReader& reader, render::FrameSettings& settings);

/// Name of windNoise … in a settings file.
std::string_view windKindName(std::uint32_t kind);

} // namespace sward::presentation
