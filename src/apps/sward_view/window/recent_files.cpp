#include "apps/sward_view/window/recent_files.h"

#include "apps/sward_view/window/state_file.h"

#include <algorithm>
#include <fstream>
#include <utility>

namespace sward::view {

RecentFiles::RecentFiles()
    : RecentFiles(stateFile("recent"))
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
    const std::string entry = stateNameOf(input);
    if (entry.find('\n') != std::string::npos)
        return;
    inputs_.erase(std::remove(inputs_.begin(), inputs_.end(), entry), inputs_.end());
    inputs_.insert(inputs_.begin(), entry);
    inputs_.resize(std::min(inputs_.size(), most));
    std::string text;
    for (const std::string& line : inputs_)
        text += line + "\n";
    keepState(file_, text);
}

} // namespace sward::view
