#include "apps/sward_view/interface/units.h"
#include "apps/sward_view/panels/panels.h"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <filesystem>

namespace sward::view {
namespace {

// The provenance, indented; as it is if it is no JSON.
std::string indented(const std::string& provenance)
{
    const auto json = nlohmann::json::parse(provenance, nullptr, false);
    return json.is_discarded() ? provenance : json.dump(2);
}

void drawShown(Controls& controls, Stage& stage)
{
    const ShownField& field = *stage.field;
    const field::Summary& summary = field.summary;
    controls.fact("File", field.input, "What was opened");
    controls.fact("Blades", countText(summary.blades), "All blades of the field");
    controls.fact("Resident", countText(stage.counts.resident),
                  "Blades in the device's memory; streaming is not in this version, so all are");
    controls.fact("Patches",
                  fmt::format("{} on {} levels", countText(summary.patches), summary.levels),
                  "Nodes of the tree of patches");
    controls.fact("On disk", bytesText(field.mapped.fileBytes()), "Size of the field file");
    controls.fact("On the device", bytesText(stage.deviceBytes),
                  "Memory that field, ground and pictures take");
    if (!summary.bounds.isEmpty()) {
        const glm::vec3 size = summary.bounds.size();
        controls.fact("Extent", fmt::format("{:.1f} x {:.1f} x {:.1f} m", size.x, size.y, size.z),
                      "Box of everything that can be seen");
    }
    const glm::dvec3 origin = field.view.origin;
    controls.fact("Origin", fmt::format("{:.0f} {:.0f} {:.0f} m", origin.x, origin.y, origin.z),
                  "World place that the field counts from");
    controls.fact("Height",
                  fmt::format("{:.2f} m ({:.2f} to {:.2f})", summary.heightMean, summary.heightLow,
                              summary.heightHigh),
                  "Mean height of the blades, and the extremes");

    controls.section("Species");
    for (std::size_t i = 0; i < field.view.species.size(); ++i)
        controls.fact(field.view.species[i].name.c_str(),
                      i < summary.perSpecies.size() ? countText(summary.perSpecies[i]) : "0",
                      "Blades of this species");

    controls.section("Provenance");
    controls.note("How it was grown: tool, input and settings");
    ImGui::BeginChild("provenance", {0.0f, 180.0f}, true);
    ImGui::PushTextWrapPos(0.0f);
    ImGui::TextUnformatted(indented(*field.view.provenance).c_str());
    ImGui::PopTextWrapPos();
    ImGui::EndChild();
}

} // namespace

void drawFieldPanel(Controls& controls, Stage& stage)
{
    if (stage.field != nullptr)
        drawShown(controls, stage);
    else
        controls.note("Nothing is shown yet. Drop a field, a mesh or a recipe on the window.");

    controls.section("Open recent");
    if (stage.recent == nullptr || stage.recent->inputs().empty())
        controls.note("Nothing was opened before.");
    else
        for (const std::string& input : stage.recent->inputs()) {
            const std::string name = std::filesystem::path(input).filename().string();
            if (ImGui::Selectable((name + "##" + input).c_str()))
                stage.wishes.open = input;
            controls.tell(name.c_str(), input, input.c_str());
        }
}

} // namespace sward::view
