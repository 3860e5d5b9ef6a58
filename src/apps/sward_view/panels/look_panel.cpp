#include "apps/sward_view/panels/panels.h"
#include "apps/sward_view/scene/time_of_day.h"
#include "presentation/look_settings.h"

#include <cmath>
#include <optional>

namespace sward::view {
namespace {

constexpr double sameElevation = 0.5; ///< [degrees] beyond it, the sun was moved by other means

void drawTimeOfDay(Controls& controls, ViewerState& state, double elevation)
{
    double& hour = state.hour;
    if (std::abs(sunAt(hour).elevation - elevation) > sameElevation)
        hour = hourOf(elevation, hour);
    const double before = hour;
    if (controls.number("Time of day", hour, {0.0f, 24.0f, "h", "%.1f"},
                        "Moves the sun over the sky of a summer's day, and sets its colour and the "
                        "light of sky and ground; the azimuth can still be turned"))
        setTimeOfDay(state.settings, before, hour);
}

} // namespace

void drawLookPanel(Controls& controls, ViewerState& state)
{
    render::FrameSettings& settings = state.settings;
    controls.section("Sun");
    presentation::SunPlace sun = presentation::sunPlaceOf(settings.sunDirection);
    drawTimeOfDay(controls, state, sun.elevation);
    sun = presentation::sunPlaceOf(settings.sunDirection);
    const bool turned = controls.number("Azimuth", sun.azimuth, {-180.0f, 180.0f, "°", "%.0f"},
                                        "Azimuth of the sun, clockwise from north, which is -z");
    const bool risen = controls.number("Elevation", sun.elevation, {-10.0f, 89.9f, "°", "%.0f"},
                                       "Elevation of the sun above the horizon");
    if (turned || risen)
        settings.sunDirection = presentation::sunTowards(sun.azimuth, sun.elevation);
    controls.color("Sunlight", settings.sunColor, "Radiance of direct sunlight");
    if (controls.button("Colour by elevation",
                        "Sets the light of sun, sky and ground by the sun's elevation: redder near the "
                        "horizon",
                        true))
        presentation::setLightByElevation(settings);

    controls.section("Sky and ground");
    controls.color("Sky", settings.skyColor, "Ambient light from the sky");
    controls.color("Ground", settings.groundColor, "Ambient light reflected by the ground");
    controls.number("Clouds", settings.clouds, {0.0f, 1.0f}, "Share of the sky covered by clouds");
    controls.number("Thatch", settings.thatch, {0.0f, 1.0f},
                    "Litter, moss and young leaves on the ground between the blades");

    controls.toggle("Blade shadows", settings.bladeShadows,
                    "Blades near the eye cast shadows of their own shape");
    ImGui::BeginDisabled(!settings.bladeShadows);
    controls.number("Shadow distance", settings.bladeShadowDistance,
                    {0.5f, 100.0f, "m", "%.1f", true},
                    "Distance from the eye to which blades cast shadows of their own shape");
    ImGui::EndDisabled();

    controls.section("Air");
    bool chosen = settings.fogDensity < 0.0f;
    if (controls.toggle("Automatic", chosen, "Chooses the fog by the size of the field"))
        settings.fogDensity = chosen ? -1.0f : 0.002f;
    ImGui::BeginDisabled(chosen);
    float fog = settings.fogDensity < 0.0f ? 0.0f : settings.fogDensity;
    if (controls.number("Fog", fog, {0.0f, 1.0f, "1/m", "%.4f", true},
                        "Extinction: share of light lost per metre"))
        settings.fogDensity = fog;
    ImGui::EndDisabled();

    controls.number(
        "Mist height", settings.fogHeight, {0.0f, 100.0f, "m", "%.1f"},
        "Height above the lowest ground at which a third of the fog is left; 0: the same "
        "fog at every height");

    controls.section("Exposure");
    bool isChosen = !settings.exposure;
    if (controls.toggle("Auto exposure", isChosen,
                        "Chooses the exposure by the colours of the field"))
        settings.exposure = isChosen ? std::nullopt : std::optional(1.0f);
    ImGui::BeginDisabled(isChosen);
    float exposure = settings.exposure.value_or(1.0f);
    if (controls.number("Exposure", exposure, {0.05f, 20.0f, "", "%.2f", true},
                        "Factor from radiance to the picture"))
        settings.exposure = exposure;
    ImGui::EndDisabled();
}

} // namespace sward::view
