#include "apps/sward_view/interface/controls.h"

#include <fmt/core.h>
#include <imgui_internal.h> // whether a slider is typed into
#include <imgui_stdlib.h>

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <string_view>

namespace sward::view {
namespace {

constexpr float labelShare = 0.40f;     ///< of a panel's width
constexpr float tooltipWidth = 300.0f;  ///< [pixels]
constexpr float narrowTooltip = 120.0f; ///< [pixels] the narrowest beside a panel
constexpr float tooltipGap = 8.0f;      ///< [pixels]
constexpr float valueWidth = 76.0f;     ///< [pixels] of a number beside its slider
constexpr float browseWidth = 34.0f;    ///< [pixels] of a button that browses, and its space
constexpr float stepsAcross = 100.0f;   ///< steps of an arrow key from end to end of a slider

std::string rangeText(const char* about, double low, double high, const char* unit)
{
    return fmt::format("{}\n{:g} to {:g}{}{}", about, low, high, *unit == 0 ? "" : " ", unit);
}

} // namespace

void Controls::beginFrame(const KeyboardFocus::Keys& keys)
{
    keys_ = keys;
    tooltipsFrom_ = 0.0f;
    focus_.begin(keys);
}

void Controls::space(float pixels)
{
    ImGui::Dummy({0.0f, style_.scaled(pixels)});
}

void Controls::heading(const char* text)
{
    ImGui::PushFont(style_.heading());
    ImGui::TextUnformatted(text);
    ImGui::PopFont();
    space(2.0f);
}

void Controls::section(const char* text)
{
    space(4.0f);
    ImGui::PushStyleColor(ImGuiCol_Text, style_.color(palette::accent));
    ImGui::TextUnformatted(text);
    ImGui::PopStyleColor();
}

void Controls::note(const std::string& text)
{
    ImGui::PushStyleColor(ImGuiCol_Text, style_.color(palette::dim));
    ImGui::PushTextWrapPos(0.0f);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopTextWrapPos();
    ImGui::PopStyleColor();
}

void Controls::label(const char* name)
{
    ImGui::AlignTextToFramePadding();
    ImGui::PushStyleColor(ImGuiCol_Text, style_.color(palette::dim));
    ImGui::TextUnformatted(name);
    ImGui::PopStyleColor();
    const float left = ImGui::GetWindowContentRegionMin().x;
    const float width = ImGui::GetWindowContentRegionMax().x - left;
    ImGui::SameLine(left + labelShare * width);
    ImGui::SetNextItemWidth(-1.0f);
}

void Controls::finish(const char* name, const std::string& shows, const std::string& about,
                      const char* kind)
{
    const ImVec2 low = ImGui::GetItemRectMin();
    const ImVec2 high = ImGui::GetItemRectMax();
    map_.add(path(name), {low.x, low.y, high.x - low.x, high.y - low.y, shows, about, kind});
    // A colour is a button, or a group of fields, which has no number.
    const std::string_view is(kind);
    const bool isTyped =
        is == "text" || is == "place" || (is == "color" && ImGui::GetItemID() == 0);
    focus_.add(path(name),
               isTyped                             ? KeyboardFocus::Kind::typed
               : is == "number" || is == "compass" ? KeyboardFocus::Kind::adjusted
                                                   : KeyboardFocus::Kind::pressed,
               style_.packed(palette::warm));
    if (focus_.has(path(name)))
        map_.add("Keyboard/Focus",
                 {low.x, low.y, high.x - low.x, high.y - low.y, path(name), {}, {}});
    if (about.empty() || !ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled))
        return;
    const float wrap = placeTooltip(low, high);
    if (wrap <= 0.0f)
        return;
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(wrap);
    ImGui::TextUnformatted(about.c_str());
    ImGui::PopTextWrapPos();
    const ImVec2 corner = ImGui::GetWindowPos();
    const ImVec2 size = ImGui::GetWindowSize();
    ImGui::EndTooltip();
    map_.add("Tooltip/" + path(name), {corner.x, corner.y, size.x, size.y, about, {}, {}});
}

// Beside the window of the control, so that it covers none; narrower where there is little room.
// Returns the width at which its text is wrapped; 0: it would cover what it must not.
float Controls::placeTooltip(const ImVec2& low, const ImVec2& high) const
{
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    const float left = ImGui::GetWindowPos().x;
    const float right = std::max(left + ImGui::GetWindowWidth(), tooltipsFrom_);
    const float gap = style_.scaled(tooltipGap);
    const float widest = style_.scaled(tooltipWidth);
    const float narrowest = style_.scaled(narrowTooltip);
    const float around = 2.0f * ImGui::GetStyle().WindowPadding.x + 2.0f * gap;
    const bool isLow = low.y > 0.6f * display.y;
    const float y = isLow ? high.y : low.y;
    const float onRight = std::min(display.x - right - around, widest);
    const float onLeft = std::min(left - around, widest);
    if (onRight >= narrowest && (onRight >= widest || onRight >= onLeft)) {
        ImGui::SetNextWindowPos({right + gap, y}, ImGuiCond_Always, {0.0f, isLow ? 1.0f : 0.0f});
        return onRight;
    }
    if (onLeft >= narrowest && tooltipsFrom_ <= 0.0f) {
        ImGui::SetNextWindowPos({left - gap, y}, ImGuiCond_Always, {1.0f, isLow ? 1.0f : 0.0f});
        return onLeft;
    }
    return tooltipsFrom_ > 0.0f ? 0.0f : widest;
}

void Controls::tell(const char* name, const std::string& shows, const char* about)
{
    finish(name, shows, about == nullptr ? "" : about, "");
}

void Controls::fact(const char* name, const std::string& shows, const char* about)
{
    label(name);
    ImGui::PushTextWrapPos(0.0f);
    ImGui::TextUnformatted(shows.c_str());
    ImGui::PopTextWrapPos();
    finish(name, shows, about == nullptr ? "" : about, "");
}

// A slider whose number stands beside it, where its grab does not cover it; but what is typed.
void Controls::beginSlider(const char* name)
{
    ImGui::SetNextItemWidth(-style_.scaled(valueWidth));
    const bool types = ImGui::TempInputIsActive(ImGui::GetID(hidden(name).c_str()));
    ImGui::PushStyleColor(ImGuiCol_Text, style_.color(palette::text, types ? 1.0f : 0.0f));
}

void Controls::showValue(const char* text)
{
    ImGui::SameLine();
    ImGui::TextUnformatted(text);
}

// Arrow keys take a number a hundredth of its range further; of a logarithmic one, of its factor.
bool Controls::stepped(const char* name, float& value, const Extent& extent) const
{
    const int steps = focus_.stepsOf(path(name));
    if (steps == 0)
        return false;
    const float share = static_cast<float>(steps) / stepsAcross;
    const float least = std::max(extent.low, 1e-4f * extent.high);
    if (extent.logarithmic)
        value = std::max(value, least) * std::pow(extent.high / least, share);
    else
        value += share * (extent.high - extent.low);
    return true;
}

bool Controls::number(const char* name, float& value, const Extent& extent, const char* about)
{
    label(name);
    const bool isStepped = stepped(name, value, extent);
    const std::string format = *extent.unit == 0 || std::strchr(extent.format, '%') == nullptr
                                   ? extent.format
                                   : fmt::format("{} {}", extent.format, extent.unit);
    beginSlider(name);
    const bool turned =
        ImGui::SliderFloat(hidden(name).c_str(), &value, extent.low, extent.high, format.c_str(),
                           extent.logarithmic ? ImGuiSliderFlags_Logarithmic : 0) ||
        isStepped;
    ImGui::PopStyleColor();
    // Clamp: Ctrl+click accepts any typed value.
    if (turned)
        value = std::clamp(value, extent.low, extent.high);
    finish(name, fmt::format("{:g}", value),
           rangeText(about, static_cast<double>(extent.low), static_cast<double>(extent.high),
                     extent.unit) +
               "; Ctrl+click to type",
           "number");
    char text[64];
    std::snprintf(text, sizeof text, format.c_str(), static_cast<double>(value));
    showValue(text);
    return turned;
}

bool Controls::number(const char* name, double& value, const Extent& extent, const char* about)
{
    auto single = static_cast<float>(value);
    if (!number(name, single, extent, about))
        return false;
    value = static_cast<double>(single);
    return true;
}

bool Controls::wholeNumber(const char* name, int& value, int low, int high, const char* about)
{
    label(name);
    const int step = std::max((high - low) / static_cast<int>(stepsAcross), 1);
    const int steps = focus_.stepsOf(path(name));
    value += steps * step;
    beginSlider(name);
    const bool turned = ImGui::SliderInt(hidden(name).c_str(), &value, low, high) || steps != 0;
    ImGui::PopStyleColor();
    if (turned)
        value = std::clamp(value, low, high);
    finish(name, std::to_string(value), rangeText(about, low, high, "") + "; Ctrl+click to type",
           "number");
    showValue(std::to_string(value).c_str());
    return turned;
}

bool Controls::toggle(const char* name, bool& value, const char* about)
{
    label(name);
    const bool turned = ImGui::Checkbox(hidden(name).c_str(), &value);
    finish(name, value ? "on" : "off", std::string(about) + "\non or off", "toggle");
    return turned;
}

bool Controls::choice(const char* name, int& value, std::span<const char* const> words,
                      const char* about)
{
    label(name);
    const int before = value;
    const int last = static_cast<int>(words.size()) - 1;
    value = std::clamp(value + focus_.rowsOf(path(name)), 0, last);
    if (ImGui::BeginCombo(hidden(name).c_str(), words[static_cast<std::size_t>(value)])) {
        const std::string row = std::string(name) + " ";
        focus_.setShownRows({path((row + words[static_cast<std::size_t>(value)]).c_str())});
        for (int i = 0; i <= last; ++i) {
            const char* const word = words[static_cast<std::size_t>(i)];
            if (ImGui::Selectable(word, i == value))
                value = i;
            tell((row + word).c_str(), i == value ? "chosen" : "", nullptr);
        }
        ImGui::EndCombo();
    }
    const bool turned = value != before;
    std::string all;
    for (const char* word : words)
        all += (all.empty() ? "" : ", ") + std::string(word);
    finish(name, words[static_cast<std::size_t>(value)], fmt::format("{}\n{}", about, all),
           "choice");
    return turned;
}

bool Controls::beginChoice(const char* name, const char* shows, float pixels, const char* about)
{
    label(name);
    ImGui::SetNextWindowSizeConstraints({style_.scaled(pixels), 0.0f}, {FLT_MAX, FLT_MAX});
    const bool isOpen =
        ImGui::BeginCombo(hidden(name).c_str(), shows, ImGuiComboFlags_HeightLargest);
    if (!isOpen) {
        finish(name, shows, std::string(about) + "\nclick for the list", "choice");
        return false;
    }
    focus_.setShownRows({path((std::string(name) + " " + shows).c_str()), path(shows)});
    return true;
}

bool Controls::text(const char* name, std::string& value, const char* hint, const char* about)
{
    label(name);
    return typed(name, value, hint, about);
}

bool Controls::file(const char* name, std::string& value, const char* hint, const char* about,
                    bool& browses)
{
    label(name);
    ImGui::SetNextItemWidth(-style_.scaled(browseWidth));
    const bool entered = typed(name, value, hint, about);
    ImGui::SameLine();
    browses = ImGui::Button((std::string("...##") + name).c_str());
    finish((std::string(name) + " browse").c_str(), "", "Chooses the file from a list", "button");
    return entered;
}

bool Controls::typed(const char* name, std::string& value, const char* hint, const char* about)
{
    if (focus_.startsTyping(path(name)))
        ImGui::SetKeyboardFocusHere();
    const bool wasEntered = ImGui::InputTextWithHint(hidden(name).c_str(), hint, &value,
                                                     ImGuiInputTextFlags_EnterReturnsTrue);
    const bool entered = wasEntered || (keys_.entered && ImGui::IsItemActive());
    if (entered)
        ImGui::ClearActiveID();
    finish(name, value, about, "text");
    return entered;
}

bool Controls::place(const char* name, glm::dvec3& value, const char* about)
{
    label(name);
    if (focus_.startsTyping(path(name)))
        ImGui::SetKeyboardFocusHere();
    const bool turned = ImGui::DragScalarN(hidden(name).c_str(), ImGuiDataType_Double, &value.x, 3,
                                           0.05f, nullptr, nullptr, "%.2f");
    finish(name, fmt::format("{:.2f} {:.2f} {:.2f}", value.x, value.y, value.z),
           std::string(about) + "\nx, y, z in m, world space; drag, or Ctrl+click to type",
           "place");
    return turned;
}

bool Controls::beginModal(const char* name, ImGuiWindowFlags flags)
{
    if (!ImGui::IsPopupOpen(name))
        ImGui::OpenPopup(name);
    ImGui::PushStyleColor(ImGuiCol_PopupBg, style_.color(palette::panel));
    ImGui::PushStyleVar(ImGuiStyleVar_PopupBorderSize, 1.0f);
    const bool isDrawn =
        ImGui::BeginPopupModal(name, nullptr,
                               flags | ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoMove |
                                   ImGuiWindowFlags_NoNavInputs | ImGuiWindowFlags_NoSavedSettings);
    ImGui::PopStyleVar();
    ImGui::PopStyleColor();
    return isDrawn;
}

bool Controls::button(const char* name, const char* about, bool wide)
{
    const bool pressed = ImGui::Button(name, {wide ? -1.0f : 0.0f, 0.0f});
    finish(name, "", about, "button");
    return pressed;
}

} // namespace sward::view
