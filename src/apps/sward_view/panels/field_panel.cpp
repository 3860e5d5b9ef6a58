#include "apps/common/field_input.h"
#include "apps/sward_view/interface/units.h"
#include "apps/sward_view/panels/panels.h"
#include "core/json/json_text.h"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <filesystem>

namespace sward::view {
namespace {

constexpr float removeWidth = 62.0f; ///< [pixels] of the button and its space
constexpr float addWidth = 40.0f;    ///< [pixels]

// The provenance, indented; unchanged if it is no JSON.
std::string indented(const std::string& provenance)
{
    const auto json = nlohmann::json::parse(provenance, nullptr, false);
    return json.is_discarded() ? provenance : jsonText(json, 2);
}

// Lists several fields to choose from or remove.
void drawMembers(Controls& controls, ViewerState& state)
{
    const ShownField& shown = *state.field;
    const bool isBusy = state.baking != nullptr || !state.loading.empty();
    for (std::size_t i = 0; i < shown.members.size(); ++i) {
        const OpenedField& field = *shown.members[i];
        ImGui::PushID(static_cast<int>(i));
        const std::string number = std::to_string(i + 1);
        const std::string row =
            fmt::format("{}   {} blades, {}", field.name, countText(field.summary.blades),
                        bytesText(field.mapped.fileBytes()));
        const float width = ImGui::GetContentRegionAvail().x - controls.style().scaled(removeWidth);
        if (ImGui::Selectable(row.c_str(), i == state.chosen, 0, {width, 0.0f}))
            state.requests.choose = i;
        controls.tell(
            ("Show " + number).c_str(), row,
            (field.source.input +
             "\nSelects this field: its properties are below, and the panel Meadow bakes it")
                .c_str());
        ImGui::SameLine();
        ImGui::BeginDisabled(isBusy);
        if (ImGui::SmallButton("Remove"))
            state.requests.remove = i;
        controls.tell(("Remove " + number).c_str(), "", "Removes this field from the picture");
        ImGui::EndDisabled();
        ImGui::PopID();
    }
    controls.fact("Total", countText(shown.summary.blades), "Blades of all fields that are shown");
}

void drawField(Controls& controls, ViewerState& state)
{
    const OpenedField& field = *state.field->members.at(state.chosen);
    const field::FieldView view = field.mapped.view();
    const field::Summary& summary = field.summary;
    controls.fact("File", field.source.input, "File or ground that was opened");
    const bool isPainted = state.painter && state.painter->isReady();
    controls.fact("Blades", countText(isPainted ? state.painter->total() : summary.blades),
                  "Number of blades in the field");
    controls.fact("Patches",
                  fmt::format("{} on {} levels", countText(summary.patches), summary.levels),
                  "Nodes of the patch tree");
    controls.fact("On disk", bytesText(field.mapped.fileBytes()), "Size of the field file");
    if (!summary.bounds.isEmpty()) {
        const glm::vec3 size = summary.bounds.size();
        controls.fact("Extent", fmt::format("{:.1f} x {:.1f} x {:.1f} m", size.x, size.y, size.z),
                      "Size of the bounding box");
    }
    controls.fact(
        "Origin",
        fmt::format("{:.0f} {:.0f} {:.0f} m", view.origin.x, view.origin.y, view.origin.z),
        "World position that coordinates of the field are relative to");
    controls.fact("Height",
                  fmt::format("{:.2f} m ({:.2f} to {:.2f})", summary.heightMean, summary.heightLow,
                              summary.heightHigh),
                  "Mean, smallest and largest height of the blades");

    controls.section("Species");
    for (std::size_t i = 0; i < view.species.size(); ++i)
        controls.fact(view.species[i].name.c_str(),
                      i < summary.perSpecies.size() ? countText(summary.perSpecies[i]) : "0",
                      "Number of blades of this species");
}

// Draws the provenance last, because it is long.
void drawProvenance(Controls& controls, const ViewerState& state)
{
    const field::FieldView view = state.field->members.at(state.chosen)->mapped.view();
    controls.section("Provenance");
    controls.note("How it was grown: tool, input and settings");
    ImGui::BeginChild("provenance", {0.0f, controls.style().scaled(180.0f)}, true);
    ImGui::PushTextWrapPos(0.0f);
    ImGui::TextUnformatted(indented(*view.provenance).c_str());
    ImGui::PopTextWrapPos();
    ImGui::EndChild();
}

// A field that was baked in this window has no file of its own.
void drawSaving(Controls& controls, ViewerState& state)
{
    const OpenedField& field = *state.field->members.at(state.chosen);
    if (!field.source.requests)
        return;
    controls.fact("Saved", field.savedAs.empty() ? "no" : field.savedAs.string(),
                  "Field file of the last bake; grass that was baked in this window is lost when "
                  "the window closes, unless it is saved");
    if (controls.button("Save field as...",
                        "Chooses a name for the field that is shown; Ctrl+S writes it at once",
                        true))
        state.files = FileDialog{
            .browser = {std::filesystem::path(state.fieldFile).parent_path(), {".sward"}},
            .title = "Save field as",
            .verb = "Save",
            .act = [&state](const std::string& path) { state.requests.saveField = path; },
            .saves = true,
            .typed = std::filesystem::path(state.fieldFile).filename().string()};
}

void drawShown(Controls& controls, ViewerState& state)
{
    if (state.field->members.size() > 1)
        drawMembers(controls, state);
    controls.fact("In memory", countText(state.counts.resident),
                  "Blades of the shown fields that are in the device's memory, each organ of a "
                  "flower counted as one");
    if (state.counts.sown > 0)
        controls.fact("Sown", countText(state.counts.sown),
                      "Of these, blades that have been grown from the field's seeds near the eye");
    if (state.counts.streamedOut > 0)
        controls.fact("Not in memory", countText(state.counts.streamedOut),
                      state.counts.sown > 0
                          ? "Blades that would grow from the field's seeds elsewhere"
                          : "Blades that are read when they are seen: the fields are larger than "
                            "the memory that --gpu-memory allows");
    controls.fact("On the device", bytesText(state.deviceBytes),
                  "Device memory of fields, ground and pictures");
    if (state.field->members.size() > 1)
        controls.section(state.field->members.at(state.chosen)->name.c_str());
    drawSaving(controls, state);
    drawField(controls, state);
}

// Lets the user choose a field or a ground from a list of files.
void browseForField(ViewerState& state)
{
    std::vector<std::string> extensions = apps::groundExtensions();
    extensions.push_back(".sward");
    state.files = FileDialog{
        .browser = {std::filesystem::path(state.another).parent_path(), std::move(extensions)},
        .title = "Open a field or a ground",
        .verb = "Open",
        .act = [&state](const std::string& path) { state.requests.open = {path}; },
        .otherVerb = state.field != nullptr ? "Add field" : "",
        .otherAct = [&state](const std::string& path) { state.requests.add = {path}; }};
}

// Opens a typed or recent name: replaces the shown fields or adds to them.
void drawOthers(Controls& controls, ViewerState& state)
{
    controls.section("Open");
    bool browses = false;
    if (controls.file("Name", state.another, "meadow.sward, a mesh, or hills",
                      "A field, or a ground on which grass is grown first; names of files count "
                      "from the folder that the viewer was started in. Enter opens it",
                      browses) &&
        !state.another.empty())
        state.requests.open = {state.another};
    if (browses)
        browseForField(state);
    ImGui::BeginDisabled(state.another.empty());
    if (controls.button("Open", "Replaces the fields that are shown"))
        state.requests.open = {state.another};
    ImGui::SameLine();
    if (controls.button("Add field", "Shows it together with the present fields"))
        state.requests.add = {state.another};
    ImGui::EndDisabled();
    controls.toggle("Drop adds", state.dropAdds,
                    "Adds dropped files to the fields that are shown, as with Shift held");

    controls.section("Open recent");
    if (state.recent == nullptr || state.recent->inputs().empty()) {
        controls.note("No recent files.");
        return;
    }
    for (const std::string& input : state.recent->inputs()) {
        const std::string name = std::filesystem::path(input).filename().string();
        ImGui::PushID(input.c_str());
        const float width = ImGui::GetContentRegionAvail().x - controls.style().scaled(addWidth);
        if (ImGui::Selectable(name.c_str(), false, 0, {width, 0.0f}))
            state.requests.open = {input};
        controls.tell(name.c_str(), input, input.c_str());
        ImGui::SameLine();
        if (ImGui::SmallButton("Add"))
            state.requests.add = {input};
        controls.tell(("Add " + name).c_str(), "", "Shows it together with the present fields");
        ImGui::PopID();
    }
}

void drawHint(Controls& controls, const char* name, const char* text)
{
    controls.note(text);
    controls.tell(name, text, nullptr);
}

} // namespace

void drawFieldPanel(Controls& controls, ViewerState& state)
{
    if (state.field != nullptr)
        drawShown(controls, state);
    else if (!state.loading.empty() || state.baking != nullptr)
        drawHint(controls, "Opening", "A field is being opened.");
    else
        drawHint(controls, "No field", "No field. Drop a field, a mesh or a recipe on the window.");
    drawOthers(controls, state);
    if (state.field != nullptr)
        drawProvenance(controls, state);
}

} // namespace sward::view
