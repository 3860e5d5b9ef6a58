#include "apps/sward_view/panels/layout.h"

#include "apps/sward_view/interface/picked_text.h"
#include "apps/sward_view/interface/units.h"
#include "apps/sward_view/panels/panels.h"
#include "apps/sward_view/picture/at_rest.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

namespace sward::view {
namespace {

// Pixels of an unscaled interface.
constexpr float railPixels = 96.0f;
constexpr float railRowPixels = 26.0f;
constexpr float minPanel = 180.0f;
constexpr float maxPanel = 640.0f;
constexpr float pictureShare = 0.27f; ///< of a window's width that a panel leaves to the picture
constexpr float edgePixels = 6.0f;    ///< of a panel, by which it is dragged wider
constexpr float statusPixels = 28.0f;
constexpr float statusPadding = 12.0f;
constexpr float margin = 16.0f; ///< between messages and the window's border
constexpr float keysPixels = 210.0f;
constexpr float bladeNamePixels = 90.0f;

constexpr ImGuiWindowFlags fixedWindow =
    ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
    ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings |
    ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoBringToFrontOnFocus |
    ImGuiWindowFlags_NoNavInputs;

struct KeyLine {
    const char* keys;
    const char* meaning;
};

constexpr std::array<KeyLine, 27> keyLines{
    {{"Drop, Shift+drop", "open a file; add it to the fields shown"},
     {"Left drag", "orbit"},
     {"Middle drag, Shift+left", "pan"},
     {"Wheel", "zoom; while flying: speed"},
     {"Right drag + W A S D Q E", "look around and fly; Shift: faster"},
     {"F", "show the whole field"},
     {"Home", "return to the first camera"},
     {"1 to 9", "recall a bookmark; Ctrl sets it"},
     {"G", "walk on the ground, W A S D to go"},
     {"Left click", "pick a blade"},
     {"Left drag on a collider", "move it over the ground; release to throw"},
     {"Space", "pause and resume time"},
     {".", "single time step"},
     {"C", "freeze the culling camera"},
     {"R", "record a camera path"},
     {"P", "take a picture"},
     {"Tab", "next control of the open panel; none: hide and show panels"},
     {"Arrows, Enter, Space", "change, open or press the control that Tab has reached"},
     {"Ctrl+H", "hide and show the panels"},
     {"Ctrl + plus, minus, 0", "larger, smaller, normal text and controls"},
     {"Ctrl+S", "save the field that was baked or painted in this window"},
     {"Ctrl+Z, Ctrl+Shift+Z", "undo and redo a stroke"},
     {"Alt + wheel", "radius of the brush"},
     {"Shift + click", "straight stroke from the end of the last"},
     {"I", "take the species of the blade that is clicked next"},
     {"H", "show and hide these keys"},
     {"Escape", "close the topmost item; finally the window"}}};

ImVec2 scaledPair(const Style& style, float x, float y)
{
    return {style.scaled(x), style.scaled(y)};
}

// Size of a window that others adjoin: whole pixels, as windows begin and end at whole ones.
float edge(const Style& style, float pixels)
{
    return std::round(style.scaled(pixels));
}

void beginFixed(const char* name, const ImVec2& place, const ImVec2& size,
                ImGuiWindowFlags more = 0)
{
    ImGui::SetNextWindowPos(place);
    ImGui::SetNextWindowSize(size);
    ImGui::Begin(name, nullptr, fixedWindow | more);
}

// Begins a window centred at a position, as large as its content.
void beginCentred(const char* name, const Style& style, const ImVec2& place, const ImVec2& pivot)
{
    ImGui::SetNextWindowPos(place, ImGuiCond_Always, pivot);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, style.scaled(8.0f));
    ImGui::Begin(name, nullptr,
                 (fixedWindow & ~ImGuiWindowFlags_NoBringToFrontOnFocus) |
                     ImGuiWindowFlags_AlwaysAutoResize);
    ImGui::PopStyleVar();
}

} // namespace

bool Layout::openPanel(const std::string& name)
{
    const auto found = std::find_if(panels.begin(), panels.end(), [&name](const Panel& panel) {
        return std::equal(
            name.begin(), name.end(), panel.name,
            panel.name + std::char_traits<char>::length(panel.name),
            [](unsigned char a, unsigned char b) { return std::tolower(a) == std::tolower(b); });
    });
    if (found == panels.end())
        return false;
    open = static_cast<std::size_t>(found - panels.begin());
    return true;
}

float Layout::panelWidth(const Style& style, float width) const
{
    // Leave room for the picture where the controls are large for the window.
    const float room = width - edge(style, railPixels);
    const float most = std::max(room - std::round(pictureShare * width), edge(style, minPanel));
    return std::clamp(edge(style, wanted_), 1.0f, std::max(std::min(most, room), 1.0f));
}

Covered Layout::covered(const Style& style, float width) const
{
    if (!shown)
        return {};
    return {.rail = std::min(edge(style, railPixels), width),
            .panel = open ? panelWidth(style, width) : 0.0f,
            .status = edge(style, statusPixels)};
}

bool Layout::takesTab(const ViewerState& state) const
{
    return state.question || state.files || keySheet || (shown && open);
}

void Layout::draw(Controls& controls, ViewerState& state)
{
    if (shown) {
        drawRail(controls);
        if (open) {
            drawPanel(controls, state);
            drawPanelEdge(controls);
        }
        drawStatus(controls, state);
        drawPicked(controls, state);
        if (state.field == nullptr && state.loading.empty() && state.baking == nullptr)
            drawWelcome(controls, state);
    }
    drawMessages(controls, state);
    if (keySheet)
        drawKeySheet(controls);
    drawFileDialog(controls, state);
    drawQuestion(controls, state);
}

void Layout::drawRail(Controls& controls)
{
    const Style& style = controls.style();
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, scaledPair(style, 12.0f, 14.0f));
    ImGui::PushStyleVar(ImGuiStyleVar_SelectableTextAlign, {0.0f, 0.5f});
    beginFixed("rail", {0.0f, 0.0f}, {edge(style, railPixels), size.y - edge(style, statusPixels)});
    controls.beginPanel("Rail");
    // A tab's tooltip would cover the panel that it opens.
    if (open)
        controls.keepTooltipsFrom(edge(style, railPixels) + panelWidth(style, size.x));
    // All rows are in sight, also if the controls are large for the window.
    const float spacing = ImGui::GetStyle().ItemSpacing.y;
    const float room = ImGui::GetContentRegionAvail().y / float(panels.size()) - spacing;
    const float height =
        std::min(style.scaled(railRowPixels), std::max(room, ImGui::GetTextLineHeight()));
    for (std::size_t i = 0; i < panels.size(); ++i) {
        const bool isOpen = open == i;
        ImGui::PushStyleColor(ImGuiCol_Text, style.color(isOpen ? palette::text : palette::dim));
        if (ImGui::Selectable(panels[i].name, isOpen, 0, {0.0f, height}))
            open = isOpen ? std::nullopt : std::optional(i);
        ImGui::PopStyleColor();
        controls.tell(panels[i].name, isOpen ? "open" : "", panels[i].about);
    }
    controls.keepTooltipsFrom(0.0f);
    ImGui::End();
    ImGui::PopStyleVar(2);
}

void Layout::drawPanel(Controls& controls, ViewerState& state)
{
    const Style& style = controls.style();
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    const Panel& panel = panels[*open];
    const float left = edge(style, railPixels);
    beginFixed(panel.name, {left, 0.0f},
               {panelWidth(style, size.x), size.y - edge(style, statusPixels)});
    controls.beginPanel(panel.name);
    controls.heading(panel.name);
    panel.draw(controls, state);
    ImGui::End();
}

// The strip beside a panel by which its width is dragged.
void Layout::drawPanelEdge(Controls& controls)
{
    const Style& style = controls.style();
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    const float left = edge(style, railPixels) + panelWidth(style, size.x);
    const ImVec2 strip{edge(style, edgePixels), size.y - edge(style, statusPixels)};
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0.0f, 0.0f});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1.0f, 1.0f});
    beginFixed("edge", {left, 0.0f}, strip,
               ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoScrollbar);
    ImGui::InvisibleButton("##width", {strip.x, std::max(strip.y, 1.0f)});
    const bool isHeld = ImGui::IsItemActive();
    if (isHeld) {
        const float unit = style.scaled(1.0f);
        wanted_ = std::clamp((ImGui::GetIO().MousePos.x - edge(style, railPixels)) / unit,
                             minPanel, maxPanel);
    }
    if (isHeld || ImGui::IsItemHovered()) {
        ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
        ImGui::GetWindowDrawList()->AddRectFilled(
            {left, 0.0f}, {left + style.scaled(2.0f), strip.y}, style.packed(palette::accent));
    }
    controls.beginPanel("Panel");
    controls.tell("Width", fmt::format("{:.0f}", panelWidth(style, size.x)),
                  isHeld ? nullptr : "Drag: makes the panel narrower or wider");
    ImGui::End();
    ImGui::PopStyleVar(2);
}

void Layout::drawStatus(Controls& controls, ViewerState& state)
{
    const Style& style = controls.style();
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, scaledPair(style, statusPadding, 5.0f));
    ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1.0f, 1.0f});
    const float height = edge(style, statusPixels);
    beginFixed("status", {0.0f, size.y - height}, {size.x, height},
               ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
    controls.beginPanel("Status");
    const bool isResting = state.passesAtRest.has_value();
    const std::uint64_t drawn = isResting ? state.drawnAtRest : state.counts.drawn;
    const bool isOpening = !state.loading.empty() || state.baking != nullptr;
    std::string left = state.field != nullptr ? state.field->name
                       : isOpening            ? "opening"
                                              : "no field";
    if (state.field != nullptr)
        left += fmt::format("   {} of {} blades drawn   {}", countText(drawn),
                            countText(state.counts.total),
                            isResting ? "time stopped"
                                      : fmt::format("{:.1f} frames/s   {:.1f} ms",
                                                    1.0 / std::max(state.frameSeconds, 1e-6),
                                                    1000.0 * state.frameSeconds));
    if (state.time.paused)
        left += "   paused";
    if (state.walking)
        left += "   walking";
    if (state.recording)
        left += "   recording";
    if (state.settings.cullingCamera)
        left += "   culling camera frozen";
    ImGui::TextUnformatted(left.c_str());
    controls.tell("Numbers", left, nullptr);

    // Show the current automatic resolution, or how fine the picture is.
    const int percent = isResting ? 100 : static_cast<int>(100.0f * state.scale + 0.5f);
    const std::string pictures =
        isResting ? fmt::format("{} of {}", *state.passesAtRest, AtRest::passes) : std::string();
    const char* const keys = "H: keys";
    std::string right = isResting ? fmt::format("refined: {}   H: keys", pictures)
                        : percent < 100
                            ? fmt::format("drawn at {} % of the resolution   H: keys", percent)
                            : keys;
    const auto widthOf = [](const std::string& text) {
        return ImGui::CalcTextSize(text.c_str()).x;
    };
    const float room = size.x - 4.0f * style.scaled(statusPadding) - widthOf(left);
    if (widthOf(right) > room)
        right = widthOf(keys) > room ? "" : keys;
    ImGui::SameLine(size.x - widthOf(right) - style.scaled(statusPadding));
    controls.note(right);
    controls.tell("Resolution", std::to_string(percent),
                  "Resolution of drawing relative to the window, %; see panel Profile");
    controls.tell("Refined", pictures, nullptr);
    ImGui::End();
    ImGui::PopStyleVar(2);
}

void Layout::drawMessages(Controls& controls, ViewerState& state)
{
    const Style& style = controls.style();
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    const Covered now = covered(style, size.x);
    const float left = now.rail + now.panel;
    const ImVec2 place{left + 0.5f * std::max(size.x - left, 0.0f), style.scaled(margin)};
    controls.beginPanel("Message");
    if (!state.error.empty()) {
        beginCentred("error", style, place, {0.5f, 0.0f});
        ImGui::PushStyleColor(ImGuiCol_Text, style.color(palette::alarm));
        ImGui::TextUnformatted("Error");
        ImGui::PopStyleColor();
        ImGui::PushTextWrapPos(std::max(size.x - left - style.scaled(80.0f), style.scaled(160.0f)));
        ImGui::TextUnformatted(state.error.c_str());
        ImGui::PopTextWrapPos();
        controls.tell("Error", state.error, nullptr);
        if (controls.button("Close", "Closes this message"))
            state.error.clear();
        ImGui::End();
        return;
    }
    if (!state.shaderError.empty()) {
        beginCentred("shaders", style, place, {0.5f, 0.0f});
        ImGui::PushStyleColor(ImGuiCol_Text, style.color(palette::alarm));
        ImGui::TextUnformatted("Shaders do not compile; the last valid ones are in use");
        ImGui::PopStyleColor();
        ImGui::PushTextWrapPos(std::max(size.x - left - style.scaled(80.0f), style.scaled(160.0f)));
        ImGui::TextUnformatted(state.shaderError.c_str());
        ImGui::PopTextWrapPos();
        controls.tell("Shaders", state.shaderError, nullptr);
        ImGui::End();
        return;
    }
    std::string text = state.notice;
    if (!state.loading.empty())
        text = fmt::format("Reading {} ...", state.loading);
    else if (state.baking != nullptr)
        text = fmt::format("Baking: {} {:.0f} %", state.baking->progress().state,
                           100.0 * state.baking->progress().share);
    if (text.empty())
        return;
    beginCentred("notice", style, place, {0.5f, 0.0f});
    ImGui::TextUnformatted(text.c_str());
    controls.tell("Notice", text, nullptr);
    if (state.baking != nullptr) {
        ImGui::SameLine();
        if (controls.button("Cancel bake", "Cancels the bake; the field that is shown stays"))
            state.requests.cancelBake = true;
    }
    ImGui::End();
}

void Layout::drawPicked(Controls& controls, ViewerState& state)
{
    if (!state.picked || state.field == nullptr)
        return;
    const Style& style = controls.style();
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    beginCentred("blade", style, {size.x - style.scaled(margin), style.scaled(margin)},
                 {1.0f, 0.0f});
    controls.beginPanel("Blade");
    controls.heading("Blade");
    for (const auto& [name, text, about] :
         pickedLines(*state.picked, *state.field, state.settings, state.time.now)) {
        ImGui::PushStyleColor(ImGuiCol_Text, style.color(palette::dim));
        ImGui::TextUnformatted(name.c_str());
        ImGui::PopStyleColor();
        ImGui::SameLine(style.scaled(bladeNamePixels));
        ImGui::TextUnformatted(text.c_str());
        controls.tell(name.c_str(), text, about.c_str());
    }
    if (controls.button("Deselect", "Deselects this blade"))
        state.picked.reset();
    ImGui::End();
}

void Layout::drawWelcome(Controls& controls, ViewerState& state)
{
    const Style& style = controls.style();
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    beginCentred("welcome", style, {0.5f * (size.x + edge(style, railPixels)), 0.5f * size.y},
                 {0.5f, 0.5f});
    controls.beginPanel("Welcome");
    controls.heading("Sward");
    ImGui::TextUnformatted("Drop a field, a mesh or a recipe on this window.");
    if (state.recent != nullptr && !state.recent->inputs().empty())
        controls.section("Open recent");
    if (state.recent != nullptr)
        for (const std::string& input : state.recent->inputs()) {
            if (ImGui::Selectable(input.c_str()))
                state.requests.open = {input};
            controls.tell(input.c_str(), input, "Opens this file again");
        }
    controls.section("Or a built-in ground");
    for (const char* name : {"hills", "sphere", "dunes", "arch"}) {
        if (controls.button(name, "Bakes grass on this ground and shows it"))
            state.requests.open = {name};
        ImGui::SameLine();
    }
    ImGui::NewLine();
    ImGui::End();
}

void Layout::drawKeySheet(Controls& controls)
{
    const Style& style = controls.style();
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    beginCentred("keys", style, {0.5f * size.x, 0.5f * size.y}, {0.5f, 0.5f});
    controls.beginPanel("Keys");
    controls.heading("Keys");
    // Narrow lines, so that all are in sight in a small window.
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, scaledPair(style, 8.0f, 3.0f));
    for (const KeyLine& line : keyLines) {
        ImGui::TextUnformatted(line.keys);
        ImGui::SameLine(style.scaled(keysPixels));
        ImGui::PushStyleColor(ImGuiCol_Text, style.color(palette::dim));
        ImGui::TextUnformatted(line.meaning);
        ImGui::PopStyleColor();
        controls.tell(line.keys, line.meaning, nullptr);
    }
    ImGui::PopStyleVar();
    if (controls.button("Close", "Closes this list (H or Escape)"))
        keySheet = false;
    ImGui::End();
}

} // namespace sward::view
