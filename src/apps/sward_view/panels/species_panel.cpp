// The meadows to choose from, and the editor of their species.
#include "apps/sward_view/interface/meadow_sketch.h"
#include "apps/sward_view/interface/units.h"
#include "apps/sward_view/panels/panels.h"
#include "core/error.h"

#include <fmt/core.h>

#include <filesystem>
#include <iterator>
#include <span>
#include <vector>

namespace sward::view {
namespace {

constexpr float rowPixels = 30.0f;    ///< height of a row with a sketch
constexpr float sketchPixels = 96.0f; ///< width of a sketch in a row
constexpr float largePixels = 56.0f;  ///< height of the chosen meadow's sketch
constexpr float listPixels = 300.0f;  ///< width of the list of meadows
constexpr float swatchPixels = 12.0f;

const std::vector<MeadowSpecies>& speciesOfPreset(std::size_t preset)
{
    static const std::vector<std::vector<MeadowSpecies>> all = [] {
        std::vector<std::vector<MeadowSpecies>> read;
        for (std::size_t i = 0; i < std::size(meadowPresets); ++i)
            read.push_back(speciesOf(textOfPreset(i), meadowPresets[i].name));
        return read;
    }();
    return all.at(preset);
}

std::string densityOf(std::size_t preset)
{
    return countText(static_cast<std::uint64_t>(meadowPresets[preset].density)) + " /m²";
}

void sketch(const Controls& controls, const ImVec2& low, const ImVec2& size,
            std::span<const MeadowSpecies> species)
{
    drawMeadowSketch(*ImGui::GetWindowDrawList(), controls.style(), low,
                     {low.x + size.x, low.y + size.y}, species);
}

// A row of the list of meadows.
bool drawPreset(Controls& controls, std::size_t preset, bool isChosen)
{
    const Style& style = controls.style();
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x;
    ImGui::PushID(static_cast<int>(preset));
    const bool picked = ImGui::Selectable("##preset", isChosen, 0, {0.0f, style.scaled(rowPixels)});
    ImGui::PopID();
    controls.tell(meadowPresets[preset].name, densityOf(preset),
                  "Blades per square metre that close its sward, at blade scale 1");
    sketch(controls, {corner.x + 2.0f, corner.y + 2.0f},
           {style.scaled(sketchPixels), style.scaled(rowPixels) - 4.0f}, speciesOfPreset(preset));
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float y = corner.y + 0.5f * (style.scaled(rowPixels) - ImGui::GetTextLineHeight());
    list.AddText({corner.x + style.scaled(sketchPixels + 10.0f), y}, style.packed(palette::text),
                 meadowPresets[preset].name);
    const std::string density = densityOf(preset);
    list.AddText({corner.x + width - ImGui::CalcTextSize(density.c_str()).x - 4.0f, y},
                 style.packed(palette::dim), density.c_str());
    return picked;
}

void drawSwatch(const Controls& controls, const ImVec2& corner, const MeadowSpecies& species)
{
    const Style& style = controls.style();
    const float size = style.scaled(swatchPixels);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    int i = 0;
    for (const glm::vec3& color :
         {species.root, species.tip, species.flower.value_or(species.tip)}) {
        const float x = corner.x + size * static_cast<float>(i++);
        list.AddRectFilled({x, corner.y}, {x + size, corner.y + size}, packedLinear(color));
    }
}

void drawSpecies(Controls& controls, MeadowSpecies& species)
{
    controls.number("Share", species.share, {1e-5f, 1.0f, "", "%.4f", true},
                    "Share of the blades, relative to those of the other species");
    if (controls.number("Height from", species.height.x, {0.01f, 3.0f, "m", "%.2f", true},
                        "Height of the lowest blades"))
        species.height.y = std::max(species.height.x, species.height.y);
    if (controls.number("Height to", species.height.y, {0.01f, 3.0f, "m", "%.2f", true},
                        "Height of the highest blades"))
        species.height.x = std::min(species.height.x, species.height.y);
    controls.reflectance("Base colour", species.root, "Colour at the base of a blade");
    controls.reflectance("Tip colour", species.tip, "Colour at the tip of a blade");
    if (species.flower)
        controls.note("Its flowers and leaves are changed in the file.");
}

void drawEditor(Controls& controls, ViewerState& state)
{
    MeadowEditor& editor = *state.editor;
    for (std::size_t i = 0; i < editor.species.size(); ++i) {
        ImGui::PushID(static_cast<int>(i));
        const ImVec2 corner = ImGui::GetCursorScreenPos();
        const std::string& name = editor.species[i].name;
        if (ImGui::Selectable("##species", editor.chosen == i))
            editor.chosen = i;
        controls.tell(fmt::format("Species {}", i + 1).c_str(), name, "Selects this species");
        drawSwatch(controls, {corner.x + 2.0f, corner.y + 3.0f}, editor.species[i]);
        ImGui::GetWindowDrawList()->AddText(
            {corner.x + controls.style().scaled(3.0f * swatchPixels + 10.0f), corner.y},
            controls.style().packed(palette::text), name.c_str());
        ImGui::PopID();
    }
    if (editor.chosen < editor.species.size())
        drawSpecies(controls, editor.species[editor.chosen]);
    if (editor.isChanged())
        controls.note(fmt::format("Bake again writes {} and sows it.", editor.file()));
    if (controls.button("Save species as...", "Writes a meadow file, which is then sown", true))
        state.files = FileDialog{
            .browser = {std::filesystem::path(editor.file()).parent_path(), {".json"}},
            .title = "Save the meadow's species as",
            .verb = "Save",
            .act = [&state](const std::string& path) { state.requests.saveMeadow = path; },
            .saves = true,
            .typed = std::filesystem::path(editor.file()).filename().string()};
}

} // namespace

void drawMeadowChoice(Controls& controls, ViewerState& state)
{
    MeadowRequests& meadow = state.meadow;
    auto chosen = static_cast<std::size_t>(meadow.meadow);
    if (controls.beginChoice("Meadow", meadowPresets[chosen].name, listPixels,
                             "Species and their shares, and how many blades close its sward")) {
        for (std::size_t i = 0; i < std::size(meadowPresets); ++i)
            if (drawPreset(controls, i, i == chosen))
                meadow.meadow = static_cast<int>(i);
        ImGui::EndCombo();
    }
    chosen = static_cast<std::size_t>(meadow.meadow);
    const bool isEdited = state.editor && state.editor->isOf(meadow);
    const ImVec2 size{ImGui::GetContentRegionAvail().x, controls.style().scaled(largePixels)};
    if (isEdited || meadow.meadowFile.empty()) {
        sketch(controls, ImGui::GetCursorScreenPos(), size,
               isEdited ? state.editor->species : speciesOfPreset(chosen));
        ImGui::Dummy(size);
        controls.tell("Sketch", meadow.meadowFile.empty() ? densityOf(chosen) : "",
                      "Species of the meadow in their colours, heights and shares");
    }
    if (meadow.meadowFile.empty())
        controls.fact("Usual density", densityOf(chosen),
                      "Blades per square metre that close this meadow's sward, at blade scale 1; "
                      "Amount below sows more or fewer");
}

void drawSpeciesEditor(Controls& controls, ViewerState& state)
{
    bool edits = state.editor.has_value();
    const bool isTurned = controls.toggle("Edit species", edits,
                                          "Changes shares, heights and colours of the species");
    const bool isOther = edits && state.editor && !state.editor->isOf(state.meadow);
    if (!isTurned && !isOther)
        return edits ? drawEditor(controls, state) : void();
    state.editor.reset();
    try {
        if (edits)
            state.editor.emplace(state.meadow);
    } catch (const Error& error) {
        state.error = error.what();
    }
}

} // namespace sward::view
