#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace sward::view {

/// A folder's content: folders first, then files of the wanted kinds, each by name.
class FileBrowser {
public:
    struct Entry {
        std::string name;
        bool isFolder = false;
        std::uintmax_t bytes = 0;
    };

    /// `extensions` in lower case, with the full stop; empty: files of every kind. A folder that
    /// cannot be read leads to the present one.
    FileBrowser(const std::filesystem::path& folder, std::vector<std::string> extensions);

    /// Reads another folder, from the present one if relative; returns whether that was possible.
    /// If not, `complaint` tells why, and the present one stays.
    bool go(const std::filesystem::path& folder);
    void up() { go(folder_.parent_path()); }

    /// Shows files of all kinds or of the wanted ones only.
    void showAll(bool all);
    bool showsAll() const { return showsAll_; }

    /// Shows only entries whose name contains this, case-insensitive.
    void filter(const std::string& text);

    /// Selects an entry; `step` goes down, or up if negative, and stops at both ends.
    void select(std::size_t index) { selected_ = index; }
    void step(int steps);

    /// The path that a typed name or path means: absolute, from ~ or from this folder.
    std::filesystem::path pathOf(const std::string& typed) const;

    const std::filesystem::path& folder() const { return folder_; } ///< absolute
    const std::vector<Entry>& entries() const { return shown_; }
    /// Index into entries(); beyond the last: none.
    std::size_t selected() const { return selected_; }
    const std::string& complaint() const { return complaint_; }
    void complain(std::string text) { complaint_ = std::move(text); }

private:
    void show();

    std::filesystem::path folder_;
    std::vector<std::string> extensions_;
    bool showsAll_ = false;
    std::string filter_; ///< lower case
    std::vector<Entry> all_, shown_;
    std::size_t selected_ = 0;
    std::string complaint_;
};

/// A path as short as possible: relative if it lies below the current folder.
std::string shortPath(const std::filesystem::path& path);

/// Choice of a file to open or to write.
struct FileDialog {
    using Act = std::function<void(const std::string& path)>;

    FileBrowser browser;
    std::string title;
    std::string verb; ///< label of the button
    Act act;
    std::string otherVerb = {}; ///< a second button; empty: none
    Act otherAct = {};
    bool saves = false;       ///< the file need not exist
    std::string typed = {};   ///< a name or path; when opening also the filter
    bool isNew = true;        ///< the name wants the keys
    std::string clicked = {}; ///< path of the entry that was clicked last

    /// The file that is meant by the typed text or else the selected entry. Goes into a folder, or
    /// complains, and returns none.
    std::optional<std::string> choose();

    /// The same for an entry.
    std::optional<std::string> choose(std::size_t entry);
};

} // namespace sward::view
