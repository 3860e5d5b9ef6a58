#include "apps/sward_view/panels/panels.h"

#include <utility>

namespace sward::view {
namespace {

constexpr const char* popup = "question";
constexpr float textPixels = 420.0f; ///< width of an unscaled text

} // namespace

void drawQuestion(Controls& controls, ViewerState& state)
{
    if (!state.question)
        return;
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({0.5f * size.x, 0.4f * size.y}, ImGuiCond_Always, {0.5f, 0.5f});
    if (!controls.beginModal(popup, ImGuiWindowFlags_AlwaysAutoResize))
        return;
    controls.beginPanel("Question");
    ImGui::PushTextWrapPos(controls.style().scaled(textPixels));
    ImGui::TextUnformatted(state.question->text.c_str());
    ImGui::PopTextWrapPos();
    controls.tell("Text", state.question->text, nullptr);
    controls.space(4.0f);
    bool isAnswered = false;
    for (const Question::Answer& answer : state.question->answers) {
        if (controls.button(answer.label.c_str(), answer.about.c_str())) {
            isAnswered = true;
            state.requests.answer = answer.act;
        }
        ImGui::SameLine();
    }
    ImGui::NewLine();
    if (isAnswered)
        ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
    if (isAnswered)
        state.question.reset();
}

} // namespace sward::view
