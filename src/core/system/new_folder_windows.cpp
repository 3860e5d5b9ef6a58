#include "core/error.h"
#include "core/system/native_windows.h"
#include "core/system/new_folder.h"

namespace sward {

std::filesystem::path makeNewFolder(const std::filesystem::path& start)
{
    // The folder of temporary files is the user's own, and what is made in it inherits its rights.
    std::filesystem::path path = start;
    path += ".";
    path = native::newName(
        path, [](const wchar_t* name) { return ::CreateDirectoryW(name, nullptr) != 0; });
    if (path.empty())
        fail(ErrorKind::io, "{}: cannot make a folder: {}", start.string(), native::lastReason());
    return path;
}

} // namespace sward
