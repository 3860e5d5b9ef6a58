// Controls of directions and colours.
#include "apps/sward_view/interface/controls.h"

#include <fmt/core.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec2.hpp>
#include <imgui.h>

#include <algorithm>
#include <cmath>

namespace sward::view {
namespace {

constexpr float dialPixels = 64.0f;    ///< of a compass
constexpr float dialStep = 5.0f;       ///< [degrees] of an arrow key
constexpr float pickerPixels = 220.0f; ///< width of a picker of colours

} // namespace

bool Controls::color(const char* name, glm::vec3& value, const char* about)
{
    // A swatch cannot show more than white: it has the hue, and a number the intensity.
    float intensity = std::max({value.x, value.y, value.z});
    glm::vec3 hue = intensity > 0.0f ? value / intensity : glm::vec3(1.0f);
    label(name);
    glm::vec3 encoded = encodedColor(hue);
    bool turned = pickColor(name, encoded);
    if (turned)
        hue = linearColor(encoded);
    finish(name, fmt::format("{:.3f} {:.3f} {:.3f}", value.x, value.y, value.z),
           std::string(about) + "\nhue; the intensity below multiplies it", "color");
    const std::string row = std::string(name) + " intensity";
    turned |= number(row.c_str(), intensity, {0.0f, 100.0f, "", "x %.2f", true},
                     "Largest channel of the linear radiance");
    if (turned)
        value = glm::clamp(hue, glm::vec3(0.0f), glm::vec3(1.0f)) * intensity;
    return turned;
}

bool Controls::reflectance(const char* name, glm::vec3& value, const char* about)
{
    glm::vec3 encoded = encodedColor(value);
    label(name);
    if (focus_.startsTyping(path(name)))
        ImGui::SetKeyboardFocusHere();
    const bool turned = ImGui::ColorEdit3(hidden(name).c_str(), &encoded.x,
                                          ImGuiColorEditFlags_Uint8 | ImGuiColorEditFlags_NoLabel |
                                              ImGuiColorEditFlags_NoTooltip);
    if (turned)
        value = linearColor(encoded);
    finish(name, fmt::format("{:.3f} {:.3f} {:.3f}", value.x, value.y, value.z),
           std::string(about) + "\n0 to 255, sRGB; click the swatch to pick", "color");
    return turned;
}

// A button of an sRGB colour that opens a picker.
bool Controls::pickColor(const char* name, glm::vec3& encoded)
{
    const std::string picker = std::string("picker of ") + name;
    if (ImGui::ColorButton(hidden(name).c_str(), {encoded.x, encoded.y, encoded.z, 1.0f},
                           ImGuiColorEditFlags_NoTooltip))
        ImGui::OpenPopup(picker.c_str());
    if (!ImGui::BeginPopup(picker.c_str()))
        return false;
    ImGui::SetNextItemWidth(style_.scaled(pickerPixels));
    const bool turned =
        ImGui::ColorPicker3(hidden(name).c_str(), &encoded.x,
                            ImGuiColorEditFlags_Uint8 | ImGuiColorEditFlags_NoSidePreview |
                                ImGuiColorEditFlags_NoLabel);
    ImGui::EndPopup();
    return turned;
}

bool Controls::direction(const char* name, glm::vec3& value, const char* about)
{
    const float length = glm::length(value);
    const glm::vec3 unit = length > 1e-6f ? value / length : glm::vec3(1.0f, 0.0f, 0.0f);
    float heading = glm::degrees(std::atan2(unit.z, unit.x));
    float rise = glm::degrees(std::asin(std::clamp(unit.y, -1.0f, 1.0f)));
    const std::string risen = std::string(name) + " rise";
    const bool turned = number(name, heading, {-180.0f, 180.0f, "°", "%.0f"}, about) |
                        number(risen.c_str(), rise, {-90.0f, 90.0f, "°", "%.0f"},
                               "How much of it points up (above 0) or down");
    if (!turned)
        return false;
    // Keep a small horizontal part, so that a vertical direction keeps its heading.
    const float flat = std::max(std::cos(glm::radians(rise)), 1e-4f);
    value = {flat * std::cos(glm::radians(heading)), std::sin(glm::radians(rise)),
             flat * std::sin(glm::radians(heading))};
    return true;
}

bool Controls::compass(const char* name, glm::vec3& value, float ahead, const char* about)
{
    label(name);
    const float dialSize = style_.scaled(dialPixels);
    const float flat = std::hypot(value.x, value.z);
    float heading = flat > 1e-6f ? std::atan2(value.z, value.x) : ahead;
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    ImGui::InvisibleButton(hidden(name).c_str(), {dialSize, dialSize});
    const ImVec2 middle{corner.x + 0.5f * dialSize, corner.y + 0.5f * dialSize};

    // Clockwise from up, as seen from above.
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    const glm::vec2 pull(mouse.x - middle.x, mouse.y - middle.y);
    const int steps = focus_.stepsOf(path(name));
    const bool isPulled = ImGui::IsItemActive() && glm::length(pull) > 2.0f;
    const bool turned = isPulled || steps != 0;
    if (turned) {
        heading = isPulled ? ahead + std::atan2(pull.x, -pull.y)
                           : heading + glm::radians(dialStep * static_cast<float>(steps));
        // Avoid zero length; a vertical direction would lose its heading.
        const float length = std::max(flat, 1e-4f);
        value = glm::normalize(
            glm::vec3(length * std::cos(heading), value.y, length * std::sin(heading)));
    }

    ImDrawList& list = *ImGui::GetWindowDrawList();
    const bool isLit = ImGui::IsItemActive() || ImGui::IsItemHovered();
    list.AddCircleFilled(middle, 0.5f * dialSize, style_.packed(palette::raised, 1.0f));
    list.AddCircle(middle, 0.5f * dialSize, style_.packed(palette::dim, 0.5f));
    const float angle = heading - ahead;
    const glm::vec2 way(std::sin(angle), -std::cos(angle));
    const glm::vec2 across(-way.y, way.x);
    const auto point = [&](float along, float aside) {
        const glm::vec2 at = 0.5f * dialSize * (along * way + aside * across);
        return ImVec2(middle.x + at.x, middle.y + at.y);
    };
    const ImU32 color = style_.packed(isLit ? palette::warm : palette::accent, 1.0f);
    list.AddLine(point(-0.75f, 0.0f), point(0.4f, 0.0f), color, style_.scaled(2.5f));
    list.AddTriangleFilled(point(0.85f, 0.0f), point(0.3f, 0.28f), point(0.3f, -0.28f), color);
    const float degrees = std::remainder(glm::degrees(heading), 360.0f);
    finish(name, fmt::format("{:.0f}", degrees),
           std::string(about) + "\ndrag the arrow, -180 to 180 °; up is where the camera looks",
           "compass");
    return turned;
}

} // namespace sward::view
