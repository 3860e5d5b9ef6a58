#pragma once

#include "render/frame/camera.h"

#include <filesystem>
#include <map>
#include <string>

namespace sward::view {

/// The user's cameras for each input, by number, stored in $XDG_STATE_HOME/sward/bookmarks.json.
/// All windows share the file: it is read when it is asked for, and changed under a lock. Entries
/// that are no camera stay in it; a file that is no list of inputs is kept under another name.
class Bookmarks {
public:
    using Numbered = std::map<int, render::Camera>; ///< 1 to 9

    /// Inputs whose cameras are kept; the one whose camera was set longest ago goes first.
    static constexpr std::size_t maxInputs = 500;

    Bookmarks();

    /// Stores them in `file`, for tests; empty: nowhere.
    explicit Bookmarks(std::filesystem::path file);

    /// The cameras of a field, a mesh or a built-in ground.
    Numbered of(const std::string& input);

    /// Throws Error{io} if it cannot be stored.
    void set(const std::string& input, int number, const render::Camera& camera);

    /// Names what could not be read since the last call, and what was done about it; each once.
    std::string takeComplaint();

private:
    void complain(const std::string& what);

    std::filesystem::path file_;
    std::string complaint_; ///< not taken yet
    std::string told_;      ///< all that was ever told
};

} // namespace sward::view
