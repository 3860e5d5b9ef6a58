#include "apps/sward/files/parts_folder.h"

#include "bake/tiles/tile_files.h"
#include "core/error.h"
#include "core/process/process_id.h"

#include <fmt/format.h>

namespace sward::apps {
namespace {

namespace fs = std::filesystem;

// A hidden name beside a folder, unique to this process.
fs::path beside(const fs::path& place, const char* role)
{
    return place.parent_path() /
           fmt::format(".{}-{}-{}", place.filename().string(), processId(), role);
}

void move(const fs::path& from, const fs::path& to)
{
    std::error_code trouble;
    fs::rename(from, to, trouble);
    if (trouble)
        fail(ErrorKind::io, "{}: cannot be renamed to {}: {}", from.string(), to.string(),
             trouble.message());
}

} // namespace

void PartsFolder::requirePlace(const fs::path& place)
{
    std::error_code trouble;
    if (fs::exists(place, trouble) && !fs::exists(bake::barePath(place), trouble) &&
        (!fs::is_directory(place) || !fs::is_empty(place)))
        fail(ErrorKind::io, "{}: exists and is not the folder of a plan", place.string());
}

PartsFolder::PartsFolder(fs::path place)
    : place_(std::move(place))
    , filling_(beside(place_, "new"))
    , before_(beside(place_, "old"))
{
    requirePlace(place_);
    std::error_code trouble;
    fs::create_directories(filling_, trouble);
    if (trouble)
        fail(ErrorKind::io, "{}: cannot be made: {}", filling_.string(), trouble.message());
}

PartsFolder::~PartsFolder()
{
    std::error_code ignored;
    if (isKept_)
        return;
    fs::remove_all(filling_, ignored);
    if (isPut_)
        fs::remove_all(place_, ignored);
    if (fs::exists(before_, ignored))
        fs::rename(before_, place_, ignored);
}

void PartsFolder::put()
{
    if (fs::exists(place_))
        move(place_, before_);
    move(filling_, place_);
    isPut_ = true;
}

void PartsFolder::keep()
{
    isKept_ = true;
    std::error_code ignored;
    fs::remove_all(before_, ignored);
}

} // namespace sward::apps
