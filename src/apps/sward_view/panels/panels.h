#pragma once

#include "apps/sward_view/interface/controls.h"
#include "apps/sward_view/stage.h"

#include <array>

namespace sward::view {

// Each draws one panel into the window that ImGui has open, and turns what belongs to it.

void drawFieldPanel(Controls& controls, Stage& stage);
void drawMeadowPanel(Controls& controls, Stage& stage);
void drawPhysicsPanel(Controls& controls, Stage& stage);
void drawWindPanel(Controls& controls, Stage& stage);
void drawCullingPanel(Controls& controls, Stage& stage);
void drawCollidersPanel(Controls& controls, Stage& stage);
void drawLookPanel(Controls& controls, Stage& stage);
void drawCameraPanel(Controls& controls, Stage& stage);
void drawProfilePanel(Controls& controls, Stage& stage);
void drawCapturePanel(Controls& controls, Stage& stage);

struct Panel {
    const char* name;
    const char* about;
    void (*draw)(Controls& controls, Stage& stage);
};

/// In the order of the rail.
inline constexpr std::array<Panel, 10> panels{
    {{"Field", "What is shown, opened lately, and where it comes from", drawFieldPanel},
     {"Meadow", "Grow the grass again, in another way", drawMeadowPanel},
     {"Physics", "Gravity, stiffness, and how the time passes", drawPhysicsPanel},
     {"Wind", "What blows, how strongly and where to", drawWindPanel},
     {"Culling", "Which blades are left out, why, and how many", drawCullingPanel},
     {"Colliders", "Balls and capsules that press blades down", drawCollidersPanel},
     {"Look", "Sun, sky, air and exposure", drawLookPanel},
     {"Camera", "Walking, flying, and camera paths", drawCameraPanel},
     {"Profile", "Where the time and the memory go", drawProfilePanel},
     {"Capture", "Pictures, sequences and settings files", drawCapturePanel}}};

} // namespace sward::view
