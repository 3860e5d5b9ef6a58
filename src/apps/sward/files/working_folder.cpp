#include "apps/sward/files/working_folder.h"

#include "core/error.h"

namespace sward::apps {

WorkingFolder::WorkingFolder(const std::filesystem::path& folder, const std::string& place)
    : before_(std::filesystem::current_path())
{
    std::error_code trouble;
    std::filesystem::current_path(folder, trouble);
    if (trouble)
        fail(ErrorKind::io,
             "{}: the folder {} from which its files are named cannot be entered: {}", place,
             folder.string(), trouble.message());
}

WorkingFolder::~WorkingFolder()
{
    std::error_code ignored;
    std::filesystem::current_path(before_, ignored);
}

} // namespace sward::apps
