#include "core/error.h"
#include "core/system/new_folder.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>

namespace sward {

std::filesystem::path makeNewFolder(const std::filesystem::path& start)
{
    std::string path = start.string() + ".XXXXXX";
    if (::mkdtemp(path.data()) == nullptr)
        fail(ErrorKind::io, "{}: cannot make a folder: {}", path, std::strerror(errno));
    return path;
}

} // namespace sward
