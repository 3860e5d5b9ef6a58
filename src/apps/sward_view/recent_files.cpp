#include "apps/sward_view/recent_files.h"

#include "core/atomic_file.h"
#include "core/error.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <utility>

namespace sward::view {
namespace {

std::filesystem::path stateFolder()
{
    const char* state = std::getenv("XDG_STATE_HOME");
    if (state != nullptr && *state == '/')
        return state;
    const char* home = std::getenv("HOME");
    return home != nullptr && *home == '/' ? std::filesystem::path(home) / ".local" / "state"
                                           : std::filesystem::path();
}

std::filesystem::path recentFile()
{
    const std::filesystem::path folder = stateFolder();
    return folder.empty() ? folder : folder / "sward" / "recent";
}

} // namespace

RecentFiles::RecentFiles()
    : RecentFiles(recentFile())
{
}

RecentFiles::RecentFiles(std::filesystem::path file)
    : file_(std::move(file))
{
    std::ifstream in(file_);
    for (std::string line; inputs_.size() < most && std::getline(in, line);)
        if (!line.empty())
            inputs_.push_back(line);
}

void RecentFiles::add(const std::string& input)
{
    // A file is found again from any folder; a built-in ground has none.
    std::error_code error;
    const std::string entry = std::filesystem::exists(input, error)
                                  ? std::filesystem::absolute(input, error).string()
                                  : input;
    if (entry.find('\n') != std::string::npos)
        return;
    inputs_.erase(std::remove(inputs_.begin(), inputs_.end(), entry), inputs_.end());
    inputs_.insert(inputs_.begin(), entry);
    inputs_.resize(std::min(inputs_.size(), most));
    if (file_.empty())
        return;
    std::string text;
    for (const std::string& line : inputs_)
        text += line + "\n";
    std::filesystem::create_directories(file_.parent_path(), error);
    try {
        writeTextFile(file_, text, true);
    } catch (const Error&) {
        // The list is a comfort, not a result.
    }
}

} // namespace sward::view
