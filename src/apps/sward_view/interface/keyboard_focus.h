#pragma once

#include <imgui.h>

#include <string>
#include <vector>

struct ImGuiWindow;

namespace sward::view {

/// The control that keys act on. Tab goes through the controls in the order in which they are
/// drawn; arrows go through the rows of an open drop-down; Enter and Space press what has the
/// focus. While a drop-down or a question is open, only what is in it can have the focus. Dear
/// ImGui's own navigation would take Space, Escape and the arrows from the window's keys.
class KeyboardFocus {
public:
    /// Keys since the last frame.
    struct Keys {
        int tabs = 0;         ///< Tab, less Shift+Tab
        int rows = 0;         ///< down, less up
        int sides = 0;        ///< right, less left
        bool entered = false; ///< Enter
        bool space = false;
    };

    /// Begins a frame, before its first control.
    void begin(const Keys& keys);

    /// The last item has been drawn under this name. Text fields begin to be typed into when they
    /// get the focus; others are outlined.
    enum class Kind { pressed, typed, adjusted };
    void add(const std::string& name, Kind kind, ImU32 color);

    /// Before an item is drawn: whether keys begin to type into it.
    bool startsTyping(const std::string& name);

    /// Before an item is drawn: steps that left and right take it further, if it has the focus.
    int stepsOf(const std::string& name) const { return isShown_ && focus_ == name ? sides_ : 0; }
    /// The same for down and up.
    int rowsOf(const std::string& name) const;

    /// The drop-down whose rows come next shows the row of one of these names.
    void setShownRows(std::vector<std::string> names) { shownRows_ = std::move(names); }

    /// Whether a control is outlined.
    bool has(const std::string& name) const
    {
        return isShown_ && (isInPopup_ ? row_ : focus_) == name;
    }

    /// Whether Enter and Space press something.
    bool takesSpace() const { return isShown_ && isAlive_; }

private:
    struct Item {
        std::string name;
        ImGuiID id;
        Kind kind;
        const ImGuiWindow* root;
    };
    void move(const std::vector<const Item*>& items, std::string& to, int steps);

    std::vector<Item> items_; ///< of the frame so far
    std::vector<std::string> shownRows_;
    std::string focus_;
    std::string row_;        ///< of the open drop-down
    std::string typing_;     ///< text field that is about to be typed into; empty: none
    int wait_ = 0;           ///< frames until keys try again to type into it
    std::string scrolled_;   ///< comes into sight
    bool isShown_ = false;   ///< after a key, until the mouse is pressed
    bool isAlive_ = false;   ///< it was drawn in the last frame
    bool isInPopup_ = false; ///< a drop-down is open
    int sides_ = 0;
    int rows_ = 0;
};

} // namespace sward::view
