#include "apps/sward/files/new_output_folder.h"

#include "core/error.h"
#include "core/files/atomic_file.h"
#include "core/system/new_folder.h"

#include <fmt/format.h>

namespace sward::apps {
namespace {

namespace fs = std::filesystem;

// The folder's name without a slash at its end.
fs::path withoutSlash(const fs::path& place)
{
    return place.has_filename() ? place : place.parent_path();
}

fs::path folderAbove(const fs::path& place)
{
    const fs::path above = withoutSlash(place).parent_path();
    return above.empty() ? fs::path(".") : above;
}

void moveFolder(const fs::path& from, const fs::path& to)
{
    std::error_code trouble;
    fs::rename(from, to, trouble);
    if (trouble)
        fail(ErrorKind::io, "{}: cannot be renamed to {}: {}", from.string(), to.string(),
             trouble.message());
}

} // namespace

void NewOutputFolder::requirePlace(const fs::path& place, const fs::path& mark, bool overwrite)
{
    std::error_code ignored;
    if (!fs::exists(withoutSlash(place), ignored)) {
        requireWritable(withoutSlash(place), overwrite);
        return;
    }
    if (!fs::is_directory(place, ignored))
        fail(ErrorKind::io, "{}: exists and is not a folder", withoutSlash(place).string());
    if (fs::is_empty(place, ignored))
        return;
    if (!fs::exists(place / mark, ignored))
        fail(ErrorKind::io, "{}: holds other files and no {}", place.string(), mark.string());
    if (!overwrite)
        fail(ErrorKind::io, "{}: exists; --force replaces it", place.string());
}

NewOutputFolder::NewOutputFolder(fs::path place, const fs::path& mark, bool overwrite)
    : place_(withoutSlash(place))
{
    requirePlace(place_, mark, overwrite);
    filling_ = makeNewFolder(folderAbove(place_) / fmt::format(".{}", place_.filename().string()));
    // Others may read it, as they may read other output.
    std::error_code ignored;
    fs::permissions(filling_, fs::perms(0755), ignored);
}

NewOutputFolder::~NewOutputFolder()
{
    std::error_code ignored;
    if (!isPut_)
        fs::remove_all(filling_, ignored);
}

void NewOutputFolder::put()
{
    const fs::path before = filling_.string() + "-old";
    const bool hasBefore = fs::exists(place_);
    if (hasBefore)
        moveFolder(place_, before);
    std::error_code trouble;
    fs::rename(filling_, place_, trouble);
    if (trouble) {
        std::error_code ignored;
        if (hasBefore)
            fs::rename(before, place_, ignored);
        fail(ErrorKind::io, "{}: cannot be renamed to {}: {}", filling_.string(), place_.string(),
             trouble.message());
    }
    isPut_ = true;
    std::error_code ignored;
    fs::remove_all(before, ignored);
}

} // namespace sward::apps
