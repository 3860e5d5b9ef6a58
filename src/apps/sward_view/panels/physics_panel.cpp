#include "apps/sward_view/panels/panels.h"

#include <fmt/core.h>

namespace sward::view {

void drawPhysicsPanel(Controls& controls, ViewerState& state)
{
    field::Defaults& environment = state.settings.environment;
    controls.section("Gravity");
    controls.number("Strength", environment.gravityStrength, {0.0f, 40.0f, "1/s", "%.1f"},
                    "How hard blades are pulled down, in their heights per second");
    controls.direction("Direction", environment.gravityDirection,
                       "Where things fall to: angle around the vertical");
    controls.number("Attractor share", environment.attractorBlend, {0.0f, 1.0f},
                    "0: falls along the direction; 1: falls to the attractor, as on a planet");
    ImGui::BeginDisabled(environment.attractorBlend <= 0.0f);
    controls.place("Attractor", environment.attractor, "A planet's centre");
    ImGui::EndDisabled();
    controls.number("Lean", state.settings.forward, {0.0f, 1.0f},
                    "Share of the pull that leans a blade forward; the paper's is 0.25");

    controls.section("Blades");
    controls.number("Recovery", environment.recovery, {0.1f, 60.0f, "1/s", "%.1f", true},
                    "Stiffness of the meadow: how quickly a stiff blade rises again");

    controls.section("Time");
    FieldTime& time = state.time;
    controls.toggle("Paused", time.paused, "Stops wind and blades (Space)");
    controls.number("Speed", time.scale, {0.0f, 4.0f, "", "%.2f x"},
                    "Field seconds per second of yours");
    controls.number("Step", time.step, {0.001f, 0.5f, "s", "%.3f", true},
                    "Length of a single step");
    if (controls.button("Single step", "One step of time while it is paused (full stop)", true)) {
        time.paused = true;
        time.stepOnce = true;
    }
    controls.fact("Now", fmt::format("{:.2f} s", time.now), "Time of the field");
}

} // namespace sward::view
