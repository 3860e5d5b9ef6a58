#pragma once

#include "render/camera.h"

#include <filesystem>
#include <map>
#include <span>
#include <string>

namespace sward::view {

/// The user's cameras for each input, by number, stored in $XDG_STATE_HOME/sward/bookmarks.json. A
/// damaged file counts as empty.
class Bookmarks {
public:
    using Numbered = std::map<int, render::Camera>; ///< 1 to 9

    Bookmarks();

    /// Stores them in `file`, for tests; empty: nowhere.
    explicit Bookmarks(std::filesystem::path file);

    /// The cameras of a field, a mesh or a built-in ground.
    Numbered of(const std::string& input) const;

    void set(const std::string& input, int number, const render::Camera& camera);

    /// Removes the cameras of all other inputs.
    void keepOnly(std::span<const std::string> inputs);

private:
    void keep() const;

    std::filesystem::path file_;
    std::map<std::string, Numbered> byInput_;
};

} // namespace sward::view
