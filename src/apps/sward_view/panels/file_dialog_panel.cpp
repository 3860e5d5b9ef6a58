#include "apps/sward_view/interface/units.h"
#include "apps/sward_view/panels/panels.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

namespace sward::view {
namespace {

constexpr const char* filePopup = "files";
constexpr float dialogPixels = 560.0f; ///< width of an unscaled dialog, at most
constexpr float dialogHeight = 420.0f; ///< [pixels], at most
constexpr float dialogShare = 0.9f;    ///< of the window, at most
constexpr float bytesWidth = 90.0f;    ///< [pixels] of the column of sizes
constexpr float belowList = 92.0f;     ///< [pixels] of what stands below the list

// Returns the entry that was clicked twice.
std::optional<std::size_t> drawEntries(Controls& controls, FileDialog& dialog, bool hasStepped)
{
    std::optional<std::size_t> chosen;
    FileBrowser& browser = dialog.browser;
    const Style& style = controls.style();
    ImGui::BeginChild("entries", {0.0f, -style.scaled(belowList)}, true);
    const auto& entries = browser.entries();
    if (entries.empty())
        controls.note("Nothing here.");
    std::size_t selected = browser.selected();
    for (std::size_t i = 0; i < entries.size(); ++i) {
        const FileBrowser::Entry& entry = entries[i];
        const std::string row = entry.isFolder ? entry.name + "/" : entry.name;
        ImGui::PushID(static_cast<int>(i));
        ImGui::PushStyleColor(ImGuiCol_Text,
                              style.color(entry.isFolder ? palette::accent : palette::text));
        const float width = ImGui::GetContentRegionAvail().x - style.scaled(bytesWidth);
        if (ImGui::Selectable(row.c_str(), i == browser.selected(), 0, {width, 0.0f})) {
            // A second click opens it, however late: frames of a slow device miss double clicks.
            const std::string path = (browser.folder() / entry.name).string();
            if (path == std::exchange(dialog.clicked, path))
                chosen = i;
            selected = i;
            if (!dialog.saves)
                dialog.typed.clear();
            else if (!entry.isFolder)
                dialog.typed = entry.name;
        }
        ImGui::PopStyleColor();
        controls.tell(row.c_str(), i == browser.selected() ? "selected" : "", nullptr);
        if (hasStepped && i == browser.selected())
            ImGui::SetScrollHereY();
        if (!entry.isFolder) {
            ImGui::SameLine(width + style.scaled(12.0f));
            controls.note(bytesText(entry.bytes));
        }
        ImGui::PopID();
    }
    browser.select(selected);
    ImGui::EndChild();
    return chosen;
}

} // namespace

void drawFileDialog(Controls& controls, ViewerState& state)
{
    if (!state.files)
        return;
    FileDialog& dialog = *state.files;
    FileBrowser& browser = dialog.browser;
    const Style& style = controls.style();
    const ImVec2 window = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({0.5f * window.x, 0.5f * window.y}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowSize({std::min(style.scaled(dialogPixels), dialogShare * window.x),
                              std::min(style.scaled(dialogHeight), dialogShare * window.y)});
    if (!controls.beginModal(filePopup, ImGuiWindowFlags_NoResize))
        return;
    controls.beginPanel("Files");
    controls.heading(dialog.title.c_str());
    if (controls.button("Up", "Goes to the folder above; typed, two full stops"))
        browser.up();
    ImGui::SameLine();
    ImGui::AlignTextToFramePadding();
    controls.note(browser.folder().string());
    controls.tell("Folder", browser.folder().string(), nullptr);

    const int steps = controls.steps();
    browser.step(steps);
    const std::optional<std::size_t> entry = drawEntries(controls, dialog, steps != 0);
    bool isChosen = false;

    const std::string before = dialog.typed;
    if (dialog.isNew)
        ImGui::SetKeyboardFocusHere();
    dialog.isNew = false;
    if (controls.text("Name", dialog.typed,
                      dialog.saves ? "name of the file" : "part of a name, or a path",
                      dialog.saves ? "Name or path of the file. Enter writes it"
                                   : "A part of a name, which leaves only such entries, or a path; "
                                     "up and down select, Enter opens")) {
        isChosen = true;
        dialog.isNew = true; // goes on typing in another folder
    }
    if (dialog.typed != before && !dialog.saves)
        browser.filter(dialog.typed.find('/') == std::string::npos ? dialog.typed : "");
    bool all = browser.showsAll();
    if (controls.toggle("All files", all, "Shows files of every kind"))
        browser.showAll(all);
    isChosen |=
        controls.button(dialog.verb.c_str(), dialog.saves ? "Writes the file that is named above"
                                                          : "Opens what is selected (Enter)");
    ImGui::SameLine();
    bool isOther = false;
    if (!dialog.otherVerb.empty()) {
        isOther =
            controls.button(dialog.otherVerb.c_str(), "Shows it together with the present fields");
        ImGui::SameLine();
    }
    const bool isCancelled = controls.button("Cancel", "Opens and writes nothing (Escape)");
    ImGui::SameLine();
    ImGui::PushStyleColor(ImGuiCol_Text, style.color(palette::alarm));
    ImGui::TextUnformatted(browser.complaint().c_str());
    ImGui::PopStyleColor();
    controls.tell("Complaint", browser.complaint(), nullptr);

    const auto chosen = entry                 ? dialog.choose(*entry)
                        : isChosen || isOther ? dialog.choose()
                                              : std::nullopt;
    const bool isDone = isCancelled || chosen.has_value();
    if (isDone)
        ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
    if (!isDone)
        return;
    if (chosen)
        state.requests.answer = [act = isOther ? dialog.otherAct : dialog.act, path = *chosen] {
            act(path);
        };
    state.files.reset();
}

} // namespace sward::view
