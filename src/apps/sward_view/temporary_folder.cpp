#include "apps/sward_view/temporary_folder.h"

#include "core/error.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>
#include <system_error>

namespace sward::view {

TemporaryFolder::TemporaryFolder()
{
    std::string name = (std::filesystem::temp_directory_path() / "sward-view.XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr)
        fail(ErrorKind::io, "{}: cannot make a folder: {}", name, std::strerror(errno));
    path_ = name;
}

TemporaryFolder::~TemporaryFolder()
{
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

} // namespace sward::view
