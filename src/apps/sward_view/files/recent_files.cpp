#include "apps/sward_view/files/recent_files.h"

#include "apps/sward_view/files/state_file.h"
#include "core/error.h"

#include <algorithm>
#include <sstream>
#include <utility>

namespace sward::view {
namespace {

std::vector<std::string> inputsIn(const std::string& text)
{
    std::vector<std::string> inputs;
    std::istringstream in(text);
    for (std::string line; inputs.size() < RecentFiles::most && std::getline(in, line);)
        if (!line.empty())
            inputs.push_back(line);
    return inputs;
}

} // namespace

RecentFiles::RecentFiles()
    : RecentFiles(stateFile("recent"))
{
}

RecentFiles::RecentFiles(std::filesystem::path file)
    : file_(std::move(file))
{
    try {
        if (!file_.empty())
            inputs_ = inputsIn(readState(file_));
    } catch (const Error&) {
        inputs_.clear();
    }
}

void RecentFiles::add(const std::string& input)
{
    const std::string entry = stateNameOf(input);
    if (entry.find('\n') != std::string::npos)
        return;
    const auto put = [&] {
        inputs_.erase(std::remove(inputs_.begin(), inputs_.end(), entry), inputs_.end());
        inputs_.insert(inputs_.begin(), entry);
        inputs_.resize(std::min(inputs_.size(), most));
        std::string text;
        for (const std::string& line : inputs_)
            text += line + "\n";
        return text;
    };
    try {
        if (!file_.empty())
            return changeState(file_, [&](const std::string& text) {
                inputs_ = inputsIn(text);
                return put();
            });
    } catch (const Error&) {
        // This window has it all the same.
    }
    put();
}

} // namespace sward::view
