#pragma once

#include "apps/sward_view/interface/controls.h"
#include "apps/sward_view/viewer_state.h"

#include <optional>
#include <string>

namespace sward::view {

/// Layout of the window: a rail of panels on the left, the open panel beside it, a status line
/// below, messages above, the list of keys in the middle.
class Layout {
public:
    /// Index into `panels`, or none.
    std::optional<std::size_t> open;
    bool shown = true; ///< everything but messages
    bool keySheet = false;

    /// Opens the panel of that name, case-insensitive; returns whether it exists.
    bool openPanel(const std::string& name);

    /// Width that rail and panel cover of a window of this width, in its coordinates.
    float coveredWidth(const Style& style, float width) const;

    void draw(Controls& controls, ViewerState& state);

private:
    void drawRail(Controls& controls);
    void drawPanel(Controls& controls, ViewerState& state);
    void drawStatus(Controls& controls, ViewerState& state);
    void drawMessages(Controls& controls, ViewerState& state);
    void drawPicked(Controls& controls, ViewerState& state);
    void drawWelcome(Controls& controls, ViewerState& state);
    void drawKeySheet(Controls& controls);
};

} // namespace sward::view
