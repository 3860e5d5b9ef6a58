#include "interchange/tiles/tile_folders.h"

#include "core/error.h"

namespace sward::interchange {

void makeFolderFor(const std::filesystem::path& file)
{
    std::error_code trouble;
    std::filesystem::create_directories(file.parent_path(), trouble);
    if (trouble)
        fail(ErrorKind::io, "{}: cannot be made: {}", file.parent_path().string(),
             trouble.message());
}

} // namespace sward::interchange
