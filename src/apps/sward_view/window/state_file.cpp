#include "apps/sward_view/window/state_file.h"

#include "core/atomic_file.h"
#include "core/error.h"

#include <cstdlib>

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

} // namespace

std::filesystem::path stateFile(const std::string& name)
{
    const std::filesystem::path folder = stateFolder();
    return folder.empty() ? folder : folder / "sward" / name;
}

void keepState(const std::filesystem::path& file, const std::string& text)
{
    if (file.empty())
        return;
    std::error_code ignored;
    std::filesystem::create_directories(file.parent_path(), ignored);
    try {
        writeTextFile(file, text, true);
    } catch (const Error&) {
        return;
    }
}

std::string stateNameOf(const std::string& input)
{
    std::error_code error;
    return std::filesystem::exists(input, error) ? std::filesystem::absolute(input, error).string()
                                                 : input;
}

} // namespace sward::view
