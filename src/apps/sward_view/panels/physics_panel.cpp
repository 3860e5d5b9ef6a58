#include "apps/sward_view/panels/panels.h"

#include <fmt/core.h>

namespace sward::view {

void drawPhysicsPanel(Controls& controls, ViewerState& state)
{
    field::Defaults& environment = state.settings.environment;
    controls.section("Gravity");
    controls.number("Strength", environment.gravityStrength, {0.0f, 40.0f, "1/s", "%.1f"},
                    "Strength of gravity, in blade heights per second");
    controls.direction("Direction", environment.gravityDirection,
                       "Direction of gravity: angle around the vertical axis");
    controls.number("Towards attractor", environment.attractorBlend, {0.0f, 1.0f},
                    "0: gravity along the direction; 1: towards the attractor, as on a planet; "
                    "between them a mixture");
    ImGui::BeginDisabled(environment.attractorBlend <= 0.0f);
    controls.place("Attractor", environment.attractor,
                   "Position that attracts, for example a planet's centre");
    ImGui::EndDisabled();
    controls.number("Lean", state.settings.forward, {0.0f, 1.0f},
                    "Share of gravity that bends a blade forward; 0.25 in the paper");

    controls.section("Blades");
    controls.number("Recovery", environment.recovery, {0.1f, 60.0f, "1/s", "%.1f", true},
                    "Rate at which a stiff blade recovers its pose");

    controls.section("Time");
    FieldTime& time = state.time;
    controls.toggle("Paused", time.paused, "Pauses wind and blades (Space)");
    controls.number("Speed", time.scale, {0.0f, 4.0f, "", "%.2f x"},
                    "Simulated seconds per second");
    controls.number("Step", time.step, {0.001f, 0.5f, "s", "%.3f", true},
                    "Length of a single step");
    if (controls.button("Single step", "Advances the time by one step and pauses (full stop)",
                        true)) {
        time.paused = true;
        time.stepOnce = true;
    }
    controls.fact("Now", fmt::format("{:.2f} s", time.now), "Simulated time");
}

} // namespace sward::view
