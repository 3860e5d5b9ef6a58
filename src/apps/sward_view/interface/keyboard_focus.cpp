#include "apps/sward_view/interface/keyboard_focus.h"

#include <imgui_internal.h> // presses items from outside, and knows the open popup

#include <algorithm>
#include <cstddef>

namespace sward::view {
namespace {

constexpr int framesToType = 4; ///< until ImGui types into a field that is in sight
constexpr float outline = 1.5f; ///< [pixels] width, and distance from the control

} // namespace

void KeyboardFocus::begin(const Keys& keys)
{
    ImGuiContext& context = *ImGui::GetCurrentContext();
    if (ImGui::IsMouseClicked(0) || ImGui::IsMouseClicked(1))
        isShown_ = false;
    // Of the frame before: what is in the topmost popup, or everything.
    const ImGuiWindow* popup =
        context.OpenPopupStack.empty() ? nullptr : context.OpenPopupStack.back().Window;
    isInPopup_ = popup != nullptr && (popup->Flags & ImGuiWindowFlags_Modal) == 0;
    std::vector<const Item*> items;
    for (const Item& item : items_)
        if (popup == nullptr || item.root == popup)
            items.push_back(&item);
    if (!isInPopup_) {
        row_.clear();
        shownRows_.clear();
    }
    std::string& at = isInPopup_ ? row_ : focus_;
    const int steps = keys.tabs != 0 ? keys.tabs : isInPopup_ ? keys.rows : 0;
    if (steps != 0)
        move(items, at, steps);

    const auto found = std::find_if(items.begin(), items.end(),
                                    [&at](const Item* item) { return item->name == at; });
    isAlive_ = found != items.end() && (*found)->kind != Kind::typed;
    if (isShown_ && isAlive_ && (keys.entered || keys.space))
        context.NavNextActivateId = (*found)->id;
    wait_ = std::max(wait_ - 1, 0);
    sides_ = keys.sides;
    rows_ = keys.rows;
    items_.clear();
}

void KeyboardFocus::move(const std::vector<const Item*>& items, std::string& to, int steps)
{
    // What was typed is kept.
    ImGui::ClearActiveID();
    typing_.clear();
    wait_ = 0;
    if (items.empty())
        return;
    const auto indexOf = [&items](const std::string& name) {
        return std::find_if(items.begin(), items.end(),
                            [&name](const Item* item) { return item->name == name; }) -
               items.begin();
    };
    const auto count = static_cast<std::ptrdiff_t>(items.size());
    std::ptrdiff_t at = indexOf(to);
    for (const std::string& shown : shownRows_)
        at = at == count ? indexOf(shown) : at;
    // Begin with the panel; its tabs come after its last control.
    if (at == count && steps > 0) {
        const auto first = std::find_if(items.begin(), items.end(), [](const Item* item) {
            return item->name.rfind("Rail/", 0) != 0;
        });
        at = first == items.end() ? -1 : first - items.begin() - 1;
    }
    // Rows of a drop-down end; the controls of a panel begin again.
    const std::ptrdiff_t next = at + steps;
    const Item& item =
        *items[static_cast<std::size_t>(isInPopup_ ? std::clamp<std::ptrdiff_t>(next, 0, count - 1)
                                                   : ((next % count) + count) % count)];
    to = item.name;
    isShown_ = true;
    scrolled_ = to;
    if (item.kind == Kind::typed)
        typing_ = to;
}

bool KeyboardFocus::startsTyping(const std::string& name)
{
    if (typing_ != name || wait_ > 0)
        return false;
    wait_ = framesToType;
    return true;
}

int KeyboardFocus::rowsOf(const std::string& name) const
{
    return isShown_ && !isInPopup_ && focus_ == name ? rows_ : 0;
}

void KeyboardFocus::add(const std::string& name, Kind kind, ImU32 color)
{
    const ImGuiID id = ImGui::GetItemID();
    const bool isDisabled = ImGui::GetStyle().Alpha < 1.0f;
    if ((id == 0 && kind != Kind::typed) || isDisabled)
        return;
    items_.push_back({name, id, kind, ImGui::GetCurrentWindowRead()->RootWindow});
    // The mouse moves the focus, too, without an outline.
    if (ImGui::IsItemActivated() && !isInPopup_)
        focus_ = name;
    if (typing_ == name && ImGui::IsItemActive())
        typing_.clear();
    if (!has(name))
        return;
    const ImVec2 low = ImGui::GetItemRectMin();
    const ImVec2 high = ImGui::GetItemRectMax();
    if (scrolled_ == name) {
        const ImVec2 corner = ImGui::GetWindowPos();
        if (low.y < corner.y || high.y > corner.y + ImGui::GetWindowHeight())
            ImGui::SetScrollHereY();
        else
            scrolled_.clear();
    }
    ImGui::GetWindowDrawList()->AddRect({low.x - outline, low.y - outline},
                                        {high.x + outline, high.y + outline}, color,
                                        ImGui::GetStyle().FrameRounding, 0, outline);
}

} // namespace sward::view
