#include "core/process/user_folders.h"
#include "core/system/native_windows.h"

namespace sward {
namespace {

// The absolute path that a variable of the environment holds; else empty.
std::filesystem::path folderIn(const wchar_t* variable)
{
    std::filesystem::path path = native::environmentOf(variable);
    return path.is_absolute() ? path : std::filesystem::path();
}

} // namespace

std::filesystem::path userStateFolder()
{
    std::filesystem::path state = folderIn(L"XDG_STATE_HOME");
    return state.empty() ? folderIn(L"LOCALAPPDATA") : state;
}

std::filesystem::path userHomeFolder()
{
    return folderIn(L"USERPROFILE");
}

} // namespace sward
