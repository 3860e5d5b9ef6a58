#pragma once

#include "apps/sward_view/interface/controls.h"
#include "apps/sward_view/viewer_state.h"

#include <array>

namespace sward::view {

// Each function draws one panel into the open ImGui window and edits its settings.

void drawFieldPanel(Controls& controls, ViewerState& state);
void drawMeadowPanel(Controls& controls, ViewerState& state);
void drawPaintPanel(Controls& controls, ViewerState& state);
void drawPhysicsPanel(Controls& controls, ViewerState& state);
void drawWindPanel(Controls& controls, ViewerState& state);
void drawCullingPanel(Controls& controls, ViewerState& state);
void drawCollidersPanel(Controls& controls, ViewerState& state);
void drawLookPanel(Controls& controls, ViewerState& state);
void drawCameraPanel(Controls& controls, ViewerState& state);
void drawProfilePanel(Controls& controls, ViewerState& state);
void drawCapturePanel(Controls& controls, ViewerState& state);

// Parts of the panel Meadow: the choice of a meadow, and the editor of its species.
void drawMeadowChoice(Controls& controls, ViewerState& state);
void drawSpeciesEditor(Controls& controls, ViewerState& state);

/// The choice of a file, if it is open, above all but questions.
void drawFileDialog(Controls& controls, ViewerState& state);

/// The question that waits for an answer, if there is one, above everything.
void drawQuestion(Controls& controls, ViewerState& state);

struct Panel {
    const char* name;
    const char* about;
    void (*draw)(Controls& controls, ViewerState& state);
};

/// In the order of the rail.
inline constexpr std::array<Panel, 11> panels{
    {{"Field", "Fields shown, recent files, and provenance", drawFieldPanel},
     {"Meadow", "Settings of the bake", drawMeadowPanel},
     {"Paint", "Strokes of a brush on the field: more grass or less, other species, paths",
      drawPaintPanel},
     {"Physics", "Gravity, stiffness and time", drawPhysicsPanel},
     {"Wind", "Wind sources: kind, strength and direction", drawWindPanel},
     {"Culling", "Culling tests and their counts", drawCullingPanel},
     {"Colliders", "Balls and capsules that press blades down", drawCollidersPanel},
     {"Look", "Sun, sky, air and exposure", drawLookPanel},
     {"Camera", "Walking, flying, and camera paths", drawCameraPanel},
     {"Profile", "Times of passes, memory and resolution", drawProfilePanel},
     {"Capture", "Pictures, sequences and settings files", drawCapturePanel}}};

} // namespace sward::view
