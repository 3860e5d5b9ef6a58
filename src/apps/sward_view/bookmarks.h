#pragma once

#include "render/camera.h"

#include <filesystem>
#include <map>
#include <span>
#include <string>

namespace sward::view {

/// Cameras that the user has set for what he looks at, by number, kept between runs in
/// $XDG_STATE_HOME/sward/bookmarks.json. A file that is damaged counts as none.
class Bookmarks {
public:
    using Numbered = std::map<int, render::Camera>; ///< 1 to 9

    Bookmarks();

    /// At `file`, for tests; empty: kept nowhere.
    explicit Bookmarks(std::filesystem::path file);

    /// Those set for a field, a mesh or a built-in ground, in this run or before.
    Numbered of(const std::string& input) const;

    void set(const std::string& input, int number, const render::Camera& camera);

    /// Forgets those of all other inputs.
    void keepOnly(std::span<const std::string> inputs);

private:
    void keep() const;

    std::filesystem::path file_;
    std::map<std::string, Numbered> byInput_;
};

} // namespace sward::view
