#pragma once

#include "apps/sward_view/interface/controls.h"
#include "apps/sward_view/interface/covered.h"
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

    static constexpr float usualPanel = 340.0f; ///< [pixels of an unscaled interface]

    /// Opens the panel of that name, case-insensitive; returns whether it exists.
    bool openPanel(const std::string& name);

    /// What the shown parts cover of a window of this width, in its coordinates.
    Covered covered(const Style& style, float width) const;

    /// Whether Tab goes through controls: there are some beside the tabs of panels.
    bool takesTab(const ViewerState& state) const;

    void draw(Controls& controls, ViewerState& state);

private:
    void drawRail(Controls& controls);
    void drawPanel(Controls& controls, ViewerState& state);
    void drawPanelEdge(Controls& controls);
    float panelWidth(const Style& style, float width) const;
    void drawStatus(Controls& controls, ViewerState& state);
    void drawMessages(Controls& controls, ViewerState& state);
    void drawPicked(Controls& controls, ViewerState& state);
    void drawWelcome(Controls& controls, ViewerState& state);
    void drawKeySheet(Controls& controls);

    float wanted_ = usualPanel; ///< [pixels of an unscaled interface] width of the panel
};

} // namespace sward::view
