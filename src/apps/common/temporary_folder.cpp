#include "apps/common/temporary_folder.h"

#include "core/system/new_folder.h"

#include <string>
#include <system_error>

namespace sward::apps {

TemporaryFolder::TemporaryFolder(const std::string& name)
    : path_(makeNewFolder(std::filesystem::temp_directory_path() / name))
{
}

TemporaryFolder::~TemporaryFolder()
{
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

} // namespace sward::apps
