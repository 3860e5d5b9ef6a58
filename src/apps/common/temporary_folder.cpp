#include "apps/common/temporary_folder.h"

#include "core/error.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>
#include <system_error>

namespace sward::apps {

TemporaryFolder::TemporaryFolder(const std::string& name)
{
    std::string path = (std::filesystem::temp_directory_path() / (name + ".XXXXXX")).string();
    if (::mkdtemp(path.data()) == nullptr)
        fail(ErrorKind::io, "{}: cannot make a folder: {}", path, std::strerror(errno));
    path_ = path;
}

TemporaryFolder::~TemporaryFolder()
{
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

} // namespace sward::apps
