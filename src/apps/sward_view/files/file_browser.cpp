#include "apps/sward_view/files/file_browser.h"

#include "core/lower_case.h"
#include "core/process/user_folders.h"

#include <algorithm>
#include <system_error>
#include <utility>

namespace sward::view {

namespace fs = std::filesystem;

FileBrowser::FileBrowser(const fs::path& folder, std::vector<std::string> extensions)
    : extensions_(std::move(extensions))
{
    std::error_code error;
    folder_ = fs::current_path(error);
    if (!go(folder.empty() ? folder_ : folder))
        go(folder_);
}

bool FileBrowser::go(const fs::path& folder)
{
    std::error_code error;
    fs::path wanted = fs::weakly_canonical(folder_ / folder, error);
    std::vector<Entry> found;
    fs::directory_iterator next(wanted, error);
    for (; !error && next != fs::directory_iterator(); next.increment(error)) {
        std::error_code unknown;
        Entry entry;
        entry.name = next->path().filename().string();
        entry.isFolder = next->is_directory(unknown);
        if (entry.name.starts_with('.') || (!entry.isFolder && !next->is_regular_file(unknown)))
            continue;
        entry.bytes = entry.isFolder ? 0 : next->file_size(unknown);
        found.push_back(std::move(entry));
    }
    if (error) {
        complaint_ = wanted.string() + ": " + error.message();
        return false;
    }
    std::ranges::sort(found, [](const Entry& a, const Entry& b) {
        if (a.isFolder != b.isFolder)
            return a.isFolder;
        const std::string first = lowerCase(a.name);
        const std::string second = lowerCase(b.name);
        return first != second ? first < second : a.name < b.name;
    });
    all_ = std::move(found);
    folder_ = std::move(wanted);
    filter_.clear();
    complaint_.clear();
    show();
    return true;
}

void FileBrowser::showAll(bool all)
{
    showsAll_ = all;
    show();
}

void FileBrowser::filter(const std::string& text)
{
    filter_ = lowerCase(text);
    complaint_.clear();
    show();
}

void FileBrowser::show()
{
    shown_.clear();
    for (const Entry& entry : all_) {
        const std::string name = lowerCase(entry.name);
        const bool isWanted =
            entry.isFolder || showsAll_ || extensions_.empty() ||
            std::ranges::any_of(extensions_, [&name](const std::string& extension) {
                return name.ends_with(extension);
            });
        if (isWanted && name.find(filter_) != std::string::npos)
            shown_.push_back(entry);
    }
    selected_ = 0;
}

void FileBrowser::step(int steps)
{
    const auto last = static_cast<std::ptrdiff_t>(shown_.size()) - 1;
    const auto wanted = static_cast<std::ptrdiff_t>(selected_) + steps;
    selected_ = static_cast<std::size_t>(
        std::clamp<std::ptrdiff_t>(wanted, 0, std::max<std::ptrdiff_t>(last, 0)));
}

fs::path FileBrowser::pathOf(const std::string& typed) const
{
    if (typed == "~" || typed.starts_with("~/"))
        if (const fs::path home = userHomeFolder(); !home.empty())
            return home / (typed.size() > 2 ? typed.substr(2) : "");
    return (folder_ / typed).lexically_normal();
}

std::string shortPath(const fs::path& path)
{
    std::error_code error;
    const fs::path below = path.lexically_relative(fs::current_path(error));
    return error || below.empty() || below.string().starts_with("..") ? path.string()
                                                                      : below.string();
}

std::optional<std::string> FileDialog::choose(std::size_t entry)
{
    const FileBrowser::Entry chosen = browser.entries().at(entry);
    if (!chosen.isFolder) {
        typed = chosen.name;
        return choose();
    }
    // A name that is to be written stays.
    if (browser.go(chosen.name) && !saves)
        typed.clear();
    return std::nullopt;
}

std::optional<std::string> FileDialog::choose()
{
    const auto& entries = browser.entries();
    const bool hasSelected = browser.selected() < entries.size();
    std::error_code error;
    fs::path path = browser.pathOf(typed);
    // A part of a name means the entry that it leaves selected.
    if (!saves && hasSelected && (typed.empty() || !fs::exists(path, error)))
        path = browser.folder() / entries[browser.selected()].name;
    if ((saves || !hasSelected) && typed.empty()) {
        browser.complain(saves ? "The file needs a name." : "There is no such file here.");
        return std::nullopt;
    }
    if (fs::is_directory(path, error)) {
        if (browser.go(path))
            typed.clear();
        return std::nullopt;
    }
    if (!saves && !fs::exists(path, error)) {
        browser.complain(shortPath(path) + ": no such file");
        return std::nullopt;
    }
    if (saves && !fs::is_directory(path.parent_path(), error)) {
        browser.complain(shortPath(path.parent_path()) + ": no such folder");
        return std::nullopt;
    }
    return shortPath(path);
}

} // namespace sward::view
