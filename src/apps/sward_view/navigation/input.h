#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <optional>
#include <string>
#include <vector>

namespace sward::view {

/// Keys of the window (docs/viewer.md has the list).
enum class Key {
    escape,
    frame,     ///< F: shows the whole field
    home,      ///< Home: back to where the camera started
    pause,     ///< Space
    step,      ///< full stop: one step of time while it is paused
    help,      ///< H: the sheet of keys
    tab,       ///< Tab: the next control, or hides and shows the panels
    hide,      ///< Ctrl+H: hides and shows everything but the grass
    walk,      ///< G: walk on the ground, or fly again
    freeze,    ///< C: freezes the culling camera
    picture,   ///< P: writes a picture
    record,    ///< R: records a camera path
    larger,    ///< Ctrl and plus: larger texts and controls
    smaller,   ///< Ctrl and minus
    usualSize, ///< Ctrl and 0
    save,      ///< Ctrl+S: saves the field that was baked or painted in this window
    undo,      ///< Ctrl+Z: takes the last change of the strokes back
    redo,      ///< Ctrl+Shift+Z: does it again
    species,   ///< I: the next click takes the species of a blade, while painting
    bookmark,  ///< 1 to 9
};

struct KeyPress {
    Key key;
    int number = 0; ///< of a bookmark, 1 to 9
    bool control = false;
    bool shift = false;
};

/// User input since the last poll. Positions and distances are in the window's coordinates, from
/// the upper left corner.
struct Input {
    glm::vec2 cursor{0.0f};
    glm::vec2 rotate{0.0f}; ///< drag with the left button
    glm::vec2 pan{0.0f};    ///< drag with the middle button, or left with shift
    glm::vec2 look{0.0f};   ///< drag with the right button
    float wheel = 0.0f;     ///< steps; away from the user is positive
    bool leftHeld = false;
    bool rightHeld = false;
    bool leftPressed = false; ///< pressed since the last poll
    glm::vec2 pressedAt{0.0f};
    std::optional<glm::vec2> clicked; ///< left button clicked without a drag
    glm::vec3 walk{0.0f}; ///< held W A S D Q E: to the right, up and ahead, each in [−1, 1]
    bool hurry = false;   ///< shift is held
    bool alt = false;     ///< Alt is held
    std::vector<KeyPress> keys;
    std::vector<std::string> dropped; ///< files dropped on the window …
    bool dropsMore = false;           ///< … with shift held
    bool entered = false;             ///< Enter was pressed
    int steps = 0;                    ///< rows down, or up if negative, by arrow and page keys
    int sides = 0;                    ///< to the right, or left if negative, by arrow keys
    bool exposed = false;             ///< the window's content was lost
};

} // namespace sward::view
