#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace sward::view {

/// Requests of the panels; the viewer fulfils them between two frames.
struct Requests {
    std::vector<std::string> open;     ///< replaces the shown fields
    std::vector<std::string> add;      ///< adds to the shown fields
    std::optional<std::size_t> remove; ///< index of the field to remove
    std::optional<std::size_t> choose; ///< field for the next bake
    std::optional<std::string> loadSettings;
    std::optional<std::string> saveSettings;
    std::optional<std::string> saveCamera;
    std::optional<std::string> saveField;  ///< path of the chosen field
    std::optional<std::string> saveMeadow; ///< path of the edited meadow
    std::function<void()> answer;          ///< to the question
    std::optional<std::string> replayPath;
    bool resetSettings = false;
    bool bake = false;
    bool cancelBake = false;
    bool compare = false; ///< toggles between the fields before and after the bake
    bool frameField = false;
    bool goHome = false;
    bool walk = false;   ///< or no longer
    bool freeze = false; ///< or no longer
    bool record = false; ///< or no longer
    bool picture = false;
    bool sequence = false; ///< or no longer
    bool forgetTimes = false;
    bool startPainting = false;
    bool stopPainting = false;
    std::optional<std::string> saveStrokes; ///< path of the strokes
    std::optional<bool> addCapsule;         ///< adds a collider: a capsule, or a ball
};

} // namespace sward::view
