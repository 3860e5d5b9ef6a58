#include "apps/sward_view/panels/panels.h"
#include "presentation/environment_settings.h"

#include <fmt/core.h>
#include <glm/geometric.hpp>

#include <array>
#include <optional>

namespace sward::view {
namespace {

constexpr std::array kindWords{"noise", "turning", "wave", "radial", "swirl", "gusts"};
constexpr std::array<const char*, render::windKinds> kindAbout{
    "Noise that travels with the wind",
    "Sine wave over time whose direction may rotate",
    "The paper's directional wave",
    "Rings away from a centre, as below a helicopter",
    "Rings around a centre",
    "Fronts that rise quickly and die away slowly"};

// Only what this kind of wind uses.
void drawSource(Controls& controls, render::WindSource& wind, float ahead)
{
    render::WindPattern& s = wind.source;
    int kind = static_cast<int>(s.kind);
    if (controls.choice("Kind", kind, kindWords, kindAbout[s.kind])) {
        const float strength = s.strength;
        wind = render::windSource(static_cast<std::uint32_t>(kind));
        wind.source.strength = strength;
    }
    controls.number("Strength", s.strength, {0.0f, 40.0f, "1/s", "%.1f"},
                    "Largest pull on a blade across it, in its heights per second");
    const bool isRound = s.kind == render::windRadial || s.kind == render::windSwirl;
    if (isRound) {
        controls.place("Centre", wind.centre, "Centre of the rings");
    } else {
        controls.compass("Heading", s.direction, ahead, "Direction that it blows to");
        controls.direction("Direction", s.direction,
                           "Direction that it blows to: 0 is +x, 90 is +z");
    }
    if (s.kind == render::windTurning) {
        controls.number("Rate", s.rate, {0.0f, 10.0f, "rad/s"},
                        "Angular frequency of the sine wave");
        controls.number("Turn", s.turn, {-5.0f, 5.0f, "rad/s"},
                        "Rotation of the direction around the blades' up-vectors");
    } else {
        controls.number("Speed", s.speed, {-40.0f, 40.0f, "m/s", "%.1f"},
                        "Speed at which the pattern travels");
    }
    controls.number("Size", s.size, {0.05f, 1000.0f, "m", "%.2f", true},
                    "Grain of noise, crest to crest, front to front, or how far rings are felt");
    controls.number("Alignment", s.alignment, {0.0f, 1.0f},
                    "0: pulls at every blade alike; 1: not at a blade that lies along it");
    controls.number("Lift", s.lift, {0.0f, 1.0f}, "Share of the upward component that is kept");
}

} // namespace

void drawWindPanel(Controls& controls, ViewerState& state)
{
    std::vector<render::WindSource>& winds = state.settings.winds;
    float sum = render::windStrength(winds);
    ImGui::BeginDisabled(sum <= 0.0f);
    if (controls.number("Total strength", sum, {0.01f, 60.0f, "1/s", "%.2f"},
                        "Sum of the strengths; changes all sources in proportion"))
        render::scaleWind(winds, sum);
    ImGui::EndDisabled();
    controls.toggle("Arrows", state.showWindArrows,
                    "Draws the direction of each source over the picture");
    bool paints = state.settings.debug == render::DebugMode::wind;
    if (controls.toggle("Paint speed", paints,
                        "Colours ground and blades from calm (blue) to the strongest (white)"))
        state.settings.debug = paints ? render::DebugMode::wind : render::DebugMode::none;

    std::optional<std::size_t> removed;
    for (std::size_t i = 0; i < winds.size(); ++i) {
        ImGui::PushID(static_cast<int>(i));
        controls.section(fmt::format("Source {}", i + 1).c_str());
        controls.beginPanel(fmt::format("Wind/{}", i + 1));
        drawSource(controls, winds[i], state.heading);
        if (controls.button("Remove", "Removes this source"))
            removed = i;
        ImGui::PopID();
    }
    controls.beginPanel("Wind");
    if (removed)
        winds.erase(winds.begin() + static_cast<std::ptrdiff_t>(*removed));

    controls.space(4.0f);
    ImGui::BeginDisabled(winds.size() >= render::maxWindSources);
    if (controls.button("Add source", "Adds a wind source, at most 8", true))
        winds.push_back(render::windSource(render::windGusts));
    ImGui::EndDisabled();
}

} // namespace sward::view
