#pragma once

#include "apps/sward_view/interface/control_map.h"
#include "apps/sward_view/interface/keyboard_focus.h"
#include "apps/sward_view/interface/style.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <span>
#include <string>

namespace sward::view {

/// Range of a number.
struct Extent {
    float low = 0.0f;
    float high = 1.0f;
    const char* unit = "";       ///< "m", "1/s"; empty: none
    const char* format = "%.2f"; ///< includes the unit
    bool logarithmic = false;
};

/// Panel controls: a name on the left, the control on the right, and a tooltip with purpose, unit
/// and range. A function that edits a value returns whether it changed.
class Controls {
public:
    Controls(const Style& style, ControlMap& map)
        : style_(style)
        , map_(map)
    {
    }

    /// Begins a frame with the keys since the last one.
    void beginFrame(const KeyboardFocus::Keys& keys);

    /// Sets the panel of the following controls: the first half of each control's name in the map.
    void beginPanel(std::string name) { panel_ = std::move(name); }

    /// Tooltips of the following controls begin right of here, if that is beyond their window.
    void keepTooltipsFrom(float x) { tooltipsFrom_ = x; }

    void space(float pixels); ///< empty height
    void heading(const char* text);
    void section(const char* text);
    void note(const std::string& text); ///< dim, wrapped text
    void fact(const char* name, const std::string& shows, const char* about = nullptr);

    bool number(const char* name, float& value, const Extent& extent, const char* about);
    bool number(const char* name, double& value, const Extent& extent, const char* about);
    bool wholeNumber(const char* name, int& value, int low, int high, const char* about);
    bool toggle(const char* name, bool& value, const char* about);
    bool choice(const char* name, int& value, std::span<const char* const> words,
                const char* about);
    bool color(const char* name, glm::vec3& value, const char* about);
    /// A linear reflectance, at most white.
    bool reflectance(const char* name, glm::vec3& value, const char* about);
    /// Begins a drop-down of this width at least whose rows the caller draws, if it is open;
    /// ImGui::EndCombo() ends it.
    bool beginChoice(const char* name, const char* shows, float pixels, const char* about);
    /// Rows of a list that keys have gone down since the last frame, or up if negative.
    int steps() const { return keys_.rows; }

    KeyboardFocus& focus() { return focus_; }

    /// Returns whether Enter was pressed in it.
    bool text(const char* name, std::string& value, const char* hint, const char* about);

    /// The same for the name of a file, with a button that browses for it.
    bool file(const char* name, std::string& value, const char* hint, const char* about,
              bool& browses);

    /// Three numbers [m].
    bool place(const char* name, glm::dvec3& value, const char* about);

    /// A unit vector by two angles: around the vertical and above the horizon.
    bool direction(const char* name, glm::vec3& value, const char* about);

    /// Edits the heading of a unit vector by a dial. Up on the dial is `ahead` [rad], the heading
    /// of the view. Keeps the elevation.
    bool compass(const char* name, glm::vec3& value, float ahead, const char* about);

    /// A button as wide as the panel or as its text.
    bool button(const char* name, const char* about, bool wide = false);

    /// Begins a modal popup, opening it unless it is open, on which controls stand out; whether it
    /// is drawn. ImGui::EndPopup() ends it.
    bool beginModal(const char* name, ImGuiWindowFlags flags);

    /// Adds the last item to the map, if it was drawn by other means.
    void tell(const char* name, const std::string& shows, const char* about);

    const Style& style() const { return style_; }

private:
    void label(const char* name);
    bool typed(const char* name, std::string& value, const char* hint, const char* about);
    void beginSlider(const char* name);
    void showValue(const char* text);
    float placeTooltip(const ImVec2& low, const ImVec2& high) const;
    void finish(const char* name, const std::string& shows, const std::string& about,
                const char* kind);
    static std::string hidden(const char* name) { return std::string("##") + name; }
    std::string path(const char* name) const { return panel_ + "/" + name; }
    bool stepped(const char* name, float& value, const Extent& extent) const;
    bool pickColor(const char* name, glm::vec3& encoded);

    const Style& style_;
    ControlMap& map_;
    std::string panel_;
    KeyboardFocus focus_;
    KeyboardFocus::Keys keys_;
    float tooltipsFrom_ = 0.0f;
};

} // namespace sward::view
