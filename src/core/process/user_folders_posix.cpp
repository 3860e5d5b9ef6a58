#include "core/process/user_folders.h"

#include <cstdlib>

namespace sward {
namespace {

// The absolute path that a variable of the environment holds; else empty.
std::filesystem::path folderIn(const char* variable)
{
    const char* path = std::getenv(variable);
    return path != nullptr && *path == '/' ? std::filesystem::path(path) : std::filesystem::path();
}

} // namespace

std::filesystem::path userStateFolder()
{
    if (std::filesystem::path state = folderIn("XDG_STATE_HOME"); !state.empty())
        return state;
    const std::filesystem::path home = userHomeFolder();
    return home.empty() ? home : home / ".local" / "state";
}

std::filesystem::path userHomeFolder()
{
    return folderIn("HOME");
}

} // namespace sward
