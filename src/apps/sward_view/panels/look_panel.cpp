#include "apps/sward_view/panels/panels.h"
#include "render/look_settings.h"

#include <optional>

namespace sward::view {

void drawLookPanel(Controls& controls, ViewerState& state)
{
    render::FrameSettings& settings = state.settings;
    controls.section("Sun");
    render::SunPlace sun = render::sunPlaceOf(settings.sunDirection);
    const bool turned = controls.number("Azimuth", sun.azimuth, {-180.0f, 180.0f, "°", "%.0f"},
                                        "Clockwise from north, which is -z");
    const bool risen = controls.number("Elevation", sun.elevation, {-10.0f, 89.9f, "°", "%.0f"},
                                       "Above the level");
    if (turned || risen)
        settings.sunDirection = render::sunTowards(sun.azimuth, sun.elevation);
    controls.color("Sunlight", settings.sunColor, "What comes straight from the sun");
    if (controls.button("Light of this height",
                        "Sunlight that has come through the air: redder the lower it stands", true))
        settings.sunColor = render::sunColorAt(sun.elevation);

    controls.section("Sky and ground");
    controls.color("Sky", settings.skyColor, "What comes from above");
    controls.color("Ground", settings.groundColor, "What the ground throws back from below");
    controls.number("Clouds", settings.clouds, {0.0f, 1.0f}, "Share of the sky that they cover");
    controls.number("Thatch", settings.thatch, {0.0f, 1.0f},
                    "Litter, moss and young leaves on the ground between the blades");

    controls.section("Air");
    bool chosen = settings.fogDensity < 0.0f;
    if (controls.toggle("By itself", chosen, "Air as thick as suits the field's size"))
        settings.fogDensity = chosen ? -1.0f : 0.002f;
    ImGui::BeginDisabled(chosen);
    float fog = settings.fogDensity < 0.0f ? 0.0f : settings.fogDensity;
    if (controls.number("Fog", fog, {0.0f, 1.0f, "1/m", "%.4f", true},
                        "Share of light that each metre of air takes away"))
        settings.fogDensity = fog;
    ImGui::EndDisabled();

    controls.number("Mist height", settings.fogHeight, {0.0f, 100.0f, "m", "%.1f"},
                    "Above the lowest ground, where a third of the fog is left; 0: it is the same "
                    "at every height");

    controls.section("Film");
    bool isChosen = !settings.exposure;
    if (controls.toggle("By the field", isChosen,
                        "Exposure that shows this field's colours neither dark nor bleached"))
        settings.exposure = isChosen ? std::nullopt : std::optional(1.0f);
    ImGui::BeginDisabled(isChosen);
    float exposure = settings.exposure.value_or(1.0f);
    if (controls.number("Exposure", exposure, {0.05f, 20.0f, "", "%.2f", true},
                        "Scale from light to the picture"))
        settings.exposure = exposure;
    ImGui::EndDisabled();
}

} // namespace sward::view
