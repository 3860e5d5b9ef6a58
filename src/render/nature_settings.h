#pragma once

#include "render/frame_settings.h"

namespace sward {
class SettingsReader;
} // namespace sward

namespace sward::render {

/// Reads the keys "wind", "gravity", "recovery" and "colliders" of a settings file; those that are
/// absent stay as they are. docs/settings.md. Throws Error{input}.
void readNature(SettingsReader& reader, FrameSettings& settings);

} // namespace sward::render
