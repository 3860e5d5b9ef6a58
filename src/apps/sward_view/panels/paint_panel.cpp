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
constexpr float maxMoved = 100.0f;      ///< [m] that strokes are moved onto the ground

constexpr std::array<const char*, paintKinds> meanings{
    "Sows grass where it is thinner than a density (add in a stroke file)",
    "Takes grass away (erase)",
    "Makes grass as dense as you say, thinner or denser (set)",
    "Evens out the density around each place (smooth)",
    "Makes the blades one species (species)",
    "Makes blades higher or lower (height)",
    "Dries a share of the blades (dryness)",
    "Short blades that lean along the stroke, as where people walk (trodden)",
    "Takes back what the strokes before did here (clear)"};

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
    const char* shown = paintKindWords[static_cast<std::size_t>(brush.kind)];
    if (!controls.beginChoice("Kind", shown, kindsPixels, "What a stroke does"))
        return;
    for (std::size_t i = 0; i < paintKinds; ++i) {
        const auto kind = static_cast<PaintKind>(i);
        if (ImGui::Selectable(paintKindWords[i], brush.kind == kind))
            brush.kind = kind;
        controls.tell((std::string("Kind ") + paintKindWords[i]).c_str(), "", meanings[i]);
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
    if (controls.button(state.desk.takesSpecies ? "Click a blade" : "Take species",
                        "Eyedropper: the next click takes the species of the blade there (I)"))
        state.desk.takesSpecies = !state.desk.takesSpecies;
}

// Where a stroke is and how large: "at 3.4, 0, -3.2; 12.3 m long, radius 0.45 m".
std::string placeText(const StrokeList::Entry& entry)
{
    const std::string at =
        fmt::format("at {:.1f}, {:.1f}, {:.1f}", entry.middle.x, entry.middle.y, entry.middle.z);
    return entry.length > 0.0
               ? fmt::format("{}; {:.3g} m long, radius {:.3g} m", at, entry.length, entry.radius)
               : fmt::format("{}; radius {:.3g} m", at, entry.radius);
}

// The same in few words, with the kind of a stroke whose name stands before it.
std::string rowText(const StrokeList::Entry& entry)
{
    if (entry.name.empty())
        return placeText(entry);
    const std::string size = entry.length > 0.0
                                 ? fmt::format("{:.3g} x {:.3g} m", entry.length, entry.radius)
                                 : fmt::format("radius {:.3g} m", entry.radius);
    return fmt::format("{}, {}, at {:.1f}, {:.1f}, {:.1f}", wordOfKind(entry.kind), size,
                       entry.middle.x, entry.middle.y, entry.middle.z);
}

std::string lossText(const LostStroke& lost)
{
    return lost.share >= 1.0 ? "touches no ground"
                             : fmt::format("{:.0f} % touch no ground", 100.0 * lost.share);
}

// What a row asks for.
struct RowWish {
    std::optional<std::size_t> switched;
    std::optional<std::size_t> removed;
};

void drawRow(Controls& controls, ViewerState& state, std::size_t i, RowWish& wish)
{
    const StrokeList::Entry& entry = state.painter->strokes.entries()[i];
    const LostStroke* const lost = state.painter->lost().of(entry.text);
    const std::string word = wordOfKind(entry.kind);
    const std::string name = fmt::format("Stroke {}", i + 1);
    const std::string place = lost != nullptr ? lossText(*lost) : placeText(entry);
    const ImVec2 begin = ImGui::GetCursorScreenPos();
    const float right = ImGui::GetWindowContentRegionMax().x;
    const float gap = controls.style().scaled(10.0f);
    bool visible = entry.visible;
    if (ImGui::Checkbox(fmt::format("{} {}", i + 1, entry.name.empty() ? word : entry.name).c_str(),
                        &visible))
        wish.switched = i;
    controls.tell(
        name.c_str(),
        fmt::format("{}{}; {}{}", entry.name.empty() ? "" : entry.name + ": ", word, place,
                    entry.visible ? "" : "; hidden"),
        fmt::format("{}, {}. The switch says whether this stroke counts", word, placeText(entry))
            .c_str());
    const float deletes = ImGui::CalcTextSize("Delete").x + gap;
    ImGui::SameLine(right - deletes - ImGui::CalcTextSize("Name").x - gap);
    if (ImGui::SmallButton("Name")) {
        state.desk.renamed = i;
        state.desk.name = entry.name;
    }
    controls.tell(("Name " + name).c_str(), entry.name, "Gives this stroke a name");
    ImGui::SameLine(right - deletes);
    if (ImGui::SmallButton("Delete"))
        wish.removed = i;
    controls.tell(("Delete " + name).c_str(), "", "Removes this stroke");
    ImGui::PushStyleColor(ImGuiCol_Text,
                          controls.style().color(lost != nullptr ? palette::warm : palette::dim));
    ImGui::TextUnformatted(lost != nullptr ? place.c_str() : rowText(entry).c_str());
    ImGui::PopStyleColor();
    const ImVec2 end(begin.x + right, ImGui::GetCursorScreenPos().y);
    if (ImGui::IsWindowHovered() && ImGui::IsMouseHoveringRect(begin, end))
        state.desk.hovered = i;
}

// A name of as many bytes as a stroke file takes, cut between characters.
std::string shortened(std::string name)
{
    if (name.size() <= longestStrokeName)
        return name;
    std::size_t size = longestStrokeName;
    while (size > 0 && (static_cast<unsigned char>(name[size]) & 0xc0) == 0x80)
        --size;
    name.resize(size);
    return name;
}

// The name of a stroke, while it is typed.
void drawNaming(Controls& controls, ViewerState& state)
{
    StrokeDesk& desk = state.desk;
    StrokeList& strokes = state.painter->strokes;
    if (!desk.renamed || *desk.renamed >= strokes.entries().size())
        return desk.renamed.reset();
    const bool isEntered = controls.text(
        "Stroke name", desk.name, "none",
        fmt::format("Name of stroke {}, at most 200 bytes; Enter takes it", *desk.renamed + 1)
            .c_str());
    const bool takes = controls.button("Take name", "Gives the stroke this name");
    ImGui::SameLine();
    const bool cancels = controls.button("Keep name", "Leaves the name as it was");
    if (isEntered || takes)
        strokes.rename(*desk.renamed, shortened(desk.name));
    if (isEntered || takes || cancels)
        desk.renamed.reset();
}

void drawMoving(Controls& controls, ViewerState& state)
{
    const std::size_t lost = state.painter->lost().countIn(state.painter->strokes);
    if (lost == 0)
        return;
    controls.fact("Off the ground", std::to_string(lost),
                  "Strokes that touch no ground, or in a part only: the ground has changed since "
                  "they were painted");
    controls.number("Move by", state.desk.moveBy, {0.01f, maxMoved, "m", "%.2f", true},
                    "How far points are moved onto the ground at most");
    if (controls.button("Move onto ground",
                        "Moves the points of all strokes that are not on the ground onto it, along "
                        "their normals; Ctrl+Z takes that back",
                        true))
        state.painter->moveStrokes(static_cast<double>(state.desk.moveBy));
}

void drawStrokes(Controls& controls, ViewerState& state)
{
    StrokeList& strokes = state.painter->strokes;
    controls.section("Strokes");
    ImGui::BeginDisabled(!strokes.canUndo());
    const bool undoes = controls.button("Undo", "Takes the last change back (Ctrl+Z)");
    ImGui::EndDisabled();
    ImGui::SameLine();
    ImGui::BeginDisabled(!strokes.canRedo());
    const bool redoes = controls.button("Redo", "Does it again (Ctrl+Shift+Z)");
    ImGui::EndDisabled();
    controls.fact("Count", std::to_string(strokes.entries().size()), "Number of strokes");
    drawMoving(controls, state);
    drawNaming(controls, state);

    RowWish wish;
    ImGui::BeginChild("strokes", {0.0f, controls.style().scaled(strokesPixels)}, true);
    ImGuiListClipper clipper;
    clipper.Begin(static_cast<int>(strokes.entries().size()));
    while (clipper.Step())
        for (int row = clipper.DisplayStart; row < clipper.DisplayEnd; ++row) {
            ImGui::PushID(row);
            drawRow(controls, state, static_cast<std::size_t>(row), wish);
            ImGui::PopID();
        }
    ImGui::EndChild();
    if (undoes || redoes || wish.removed)
        state.desk.renamed.reset();
    if (undoes)
        strokes.undo();
    else if (redoes)
        strokes.redo();
    else if (wish.removed)
        strokes.remove(*wish.removed);
    else if (wish.switched)
        strokes.setVisible(*wish.switched, !strokes.entries()[*wish.switched].visible);
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
    if (const std::string& trouble = state.painter->autosaveTrouble(); !trouble.empty())
        controls.fact("Autosave", "fails", trouble.c_str());
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
    state.desk.hovered.reset();
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
    controls.note("Draw with the left button. Shift and a click: a straight stroke from the end of "
                  "the last. Shift and dragging, and the other buttons, move the camera.");
    controls.fact("Blades", countText(state.painter->total()), "Number of blades in the field");
    controls.fact("Last change",
                  state.painter->seconds() > 0.0
                      ? fmt::format("{:.0f} ms", 1000.0 * state.painter->seconds())
                      : "none",
                  "Time in which the session baked it");
    drawStrokes(controls, state);
    drawPaintSaving(controls, state);
}

} // namespace sward::view
