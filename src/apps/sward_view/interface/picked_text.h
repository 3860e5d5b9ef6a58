#pragma once

#include "apps/sward_view/picking.h"
#include "render/frame_settings.h"

#include <string>
#include <vector>

namespace sward::view {

/// A line about a blade: what it is, its value, and what that means.
struct PickedLine {
    std::string name;
    std::string text;
    std::string about;
};

/// What is known of a blade, and the forces that pull at it at `time` [s].
std::vector<PickedLine> pickedLines(const PickedBlade& picked, const ShownField& shown,
                                    const render::FrameSettings& settings, double time);

} // namespace sward::view
