#include "apps/common/field_input.h"
#include "apps/sward_view/interface/units.h"
#include "apps/sward_view/paint/brush_values.h"
#include "apps/sward_view/panels/panels.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <optional>

namespace sward::view {
namespace {

namespace fs = std::filesystem;

constexpr float strokesPixels = 180.0f; ///< height of the list
constexpr float kindsPixels = 120.0f;   ///< width of the list of kinds

constexpr std::array<const char*, paintKinds> meanings{
    "Adds grass up to a ceiling",
    "Takes grass away",
    "Sets the density",
    "Smooths the density",
    "Sows one species",
    "Makes blades higher or lower",
    "Dries a share of the blades",
    "Treads a path: short blades, leaning along it",
    "Takes back what the strokes before did"};

void browseForInput(ViewerState& state, std::string& value, std::vector<std::string> extensions,
                    const char* title)
{
    state.files = FileDialog{.browser = {fs::path(value).parent_path(), std::move(extensions)},
                             .title = title,
                             .verb = "Choose",
                             .act = [&value](const std::string& path) { value = path; }};
}

// What is needed before the first stroke.
void drawBefore(Controls& controls, ViewerState& state)
{
    controls.note("A brush changes the grass where it is drawn: more or less, other species, "
                  "heights, dry grass, trodden paths.");
    const OpenedField& field = *state.field->members.at(0);
    bool browses = false;
    if (field.source.requests) {
        controls.fact("Ground", field.source.requests->ground, "Ground on which the field grows");
    } else {
        controls.file("Ground", state.meadow.ground, "terrain.glb, or hills",
                      "Ground on which this field was baked, a file or a built-in's name; the "
                      "panel Meadow has the other settings of that bake",
                      browses);
        if (browses)
            browseForInput(state, state.meadow.ground, apps::groundExtensions(), "Ground");
    }
    controls.file("Strokes", state.strokesFile, "none",
                  "Strokes to begin with: those that the field was baked with, or any others",
                  browses);
    if (browses)
        browseForInput(state, state.strokesFile, {".json"}, "Strokes");
    ImGui::BeginDisabled(!field.source.requests && state.meadow.ground.empty());
    if (controls.button("Start painting", "Opens the ground in a process of its own", true))
        state.requests.startPainting = true;
    ImGui::EndDisabled();
}

void drawSpeciesChoice(Controls& controls, ViewerState& state)
{
    const std::vector<std::string>& names = state.painter->session().ready().species;
    std::string& chosen = state.brush.species;
    if (names.empty())
        return;
    if (std::find(names.begin(), names.end(), chosen) == names.end())
        chosen = names.front();
    std::vector<const char*> words;
    for (const std::string& name : names)
        words.push_back(name.c_str());
    auto index = static_cast<int>(std::find(names.begin(), names.end(), chosen) - names.begin());
    if (controls.choice("Species", index, words, "Species that the stroke sows"))
        chosen = names[static_cast<std::size_t>(index)];
}

void drawOwnValues(Controls& controls, ViewerState& state)
{
    Brush& brush = state.brush;
    if (brush.kind == PaintKind::species)
        drawSpeciesChoice(controls, state);
    for (const BrushValue& own : brushValues)
        if (own.kind == brush.kind)
            controls.number(own.name, brush.*own.value, {own.min, own.max, "", own.format},
                            own.explanation);
}

void drawKinds(Controls& controls, Brush& brush)
{
    const char* shown = paintKindNames[static_cast<std::size_t>(brush.kind)];
    if (!controls.beginChoice("Kind", shown, kindsPixels, "What a stroke does"))
        return;
    for (std::size_t i = 0; i < paintKinds; ++i) {
        const auto kind = static_cast<PaintKind>(i);
        if (ImGui::Selectable(paintKindNames[i], brush.kind == kind))
            brush.kind = kind;
        controls.tell((std::string("Kind ") + paintKindNames[i]).c_str(), "", meanings[i]);
    }
    ImGui::EndCombo();
}

void drawBrush(Controls& controls, ViewerState& state)
{
    Brush& brush = state.brush;
    drawKinds(controls, brush);
    controls.number("Radius", brush.radius, {shortestBrush, longestBrush, "m", "%.2f", true},
                    "Radius of the brush; Alt and the wheel change it");
    controls.number("Hardness", brush.hardness, {0.0f, 1.0f, "", "%.2f"},
                    "Share of the radius with the full strength, the inner ring");
    controls.number("Strength", brush.strength, {0.0f, 1.0f, "", "%.2f"},
                    "Share of the way from what is there to what the stroke says");
    drawOwnValues(controls, state);
}

void drawStrokes(Controls& controls, StrokeList& strokes)
{
    controls.section("Strokes");
    ImGui::BeginDisabled(!strokes.canUndo());
    const bool undoes = controls.button("Undo", "Takes the last change back (Ctrl+Z)");
    ImGui::EndDisabled();
    ImGui::SameLine();
    ImGui::BeginDisabled(!strokes.canRedo());
    const bool redoes = controls.button("Redo", "Does it again (Ctrl+Shift+Z)");
    ImGui::EndDisabled();
    controls.fact("Count", std::to_string(strokes.entries().size()), "Number of strokes");

    std::optional<std::size_t> switched;
    std::optional<std::size_t> removed;
    ImGui::BeginChild("strokes", {0.0f, controls.style().scaled(strokesPixels)}, true);
    ImGuiListClipper clipper;
    clipper.Begin(static_cast<int>(strokes.entries().size()));
    while (clipper.Step())
        for (int row = clipper.DisplayStart; row < clipper.DisplayEnd; ++row) {
            const auto i = static_cast<std::size_t>(row);
            const StrokeList::Entry& entry = strokes.entries()[i];
            const std::string name = fmt::format("Stroke {}", i + 1);
            ImGui::PushID(row);
            bool visible = entry.visible;
            if (ImGui::Checkbox(fmt::format("{} {}", i + 1, entry.kind).c_str(), &visible))
                switched = i;
            controls.tell(name.c_str(), entry.kind + (entry.visible ? "" : " hidden"),
                          "Whether this stroke counts");
            ImGui::SameLine(ImGui::GetWindowContentRegionMax().x - ImGui::CalcTextSize("Delete").x -
                            controls.style().scaled(10.0f));
            if (ImGui::SmallButton("Delete"))
                removed = i;
            controls.tell(("Delete " + name).c_str(), "", "Removes this stroke");
            ImGui::PopID();
        }
    ImGui::EndChild();
    if (undoes)
        strokes.undo();
    else if (redoes)
        strokes.redo();
    else if (removed)
        strokes.remove(*removed);
    else if (switched)
        strokes.setVisible(*switched, !strokes.entries()[*switched].visible);
}

void browseToSave(ViewerState& state, const char* title, const std::string& extension,
                  const fs::path& proposed, std::optional<std::string>& request)
{
    state.files = FileDialog{.browser = {proposed.parent_path(), {extension}},
                             .title = title,
                             .verb = "Save",
                             .act = [&request](const std::string& path) { request = path; },
                             .saves = true,
                             .typed = proposed.filename().string()};
}

void drawPaintSaving(Controls& controls, ViewerState& state)
{
    controls.section("Save");
    controls.fact("Saved", state.painter->strokes.isUnsaved() ? "no" : "yes",
                  "Whether a file holds the strokes; until then an autosave beside the field does");
    if (controls.button("Save strokes...",
                        "Writes the strokes that count, for 'sward bake --paint' and for painting "
                        "later"))
        browseToSave(state, "Save strokes as", ".json",
                     fs::path(state.fieldFile).replace_extension(".strokes.json"),
                     state.requests.saveStrokes);
    ImGui::SameLine();
    if (controls.button("Save field...", "Writes the field with its strokes; Ctrl+S does, too"))
        browseToSave(state, "Save field as", ".sward", state.fieldFile, state.requests.saveField);
    if (controls.button("Stop painting", "Asks first if strokes are not saved", true))
        state.requests.stopPainting = true;
}

} // namespace

void drawPaintPanel(Controls& controls, ViewerState& state)
{
    if (state.field == nullptr)
        return controls.note("No field. Drop a field, a mesh or a recipe on the window.");
    if (!state.painter)
        return drawBefore(controls, state);
    const EditSession& session = state.painter->session();
    if (!state.painter->isReady()) {
        controls.note(fmt::format("Opening the ground: {} {:.0f} %", session.progress().state,
                                  100.0 * session.progress().share));
        if (controls.button("Cancel", "Does not begin to paint", true))
            state.requests.stopPainting = true;
        return;
    }
    drawBrush(controls, state);
    controls.note("Draw with the left button; with Shift it moves the camera, as the others do.");
    controls.fact("Blades", countText(state.painter->total()), "Number of blades in the field");
    controls.fact("Last change",
                  state.painter->seconds() > 0.0
                      ? fmt::format("{:.0f} ms", 1000.0 * state.painter->seconds())
                      : "none",
                  "Time in which the session baked it");
    drawStrokes(controls, state.painter->strokes);
    drawPaintSaving(controls, state);
}

} // namespace sward::view
