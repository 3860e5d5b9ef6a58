#pragma once

#include "apps/sward_view/fields/picking.h"
#include "render/frame/frame_settings.h"

#include <string>
#include <vector>

namespace sward::view {

/// A line about a blade: name, value and explanation.
struct PickedLine {
    std::string name;
    std::string text;
    std::string about;
};

/// Properties of a blade, and the forces on it at `time` [s].
std::vector<PickedLine> pickedLines(const PickedBlade& picked, const ShownField& shown,
                                    const render::FrameSettings& settings, double time);

} // namespace sward::view
