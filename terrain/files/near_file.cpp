#include "terrain/files/near_file.h"

#include "core/json/settings_json.h"
#include "core/lower_case.h"

#include <algorithm>
#include <vector>

namespace sward::terrain {
namespace {

constexpr std::size_t folderLimit = 1024; // names of a folder that are compared

std::vector<std::string> namesIn(const std::filesystem::path& folder)
{
    std::vector<std::string> names;
    std::error_code error;
    const std::filesystem::path own = folder.empty() ? "." : folder;
    for (std::filesystem::directory_iterator at(own, error), end;
         !error && at != end && names.size() < folderLimit; at.increment(error))
        names.push_back(at->path().filename().string());
    // The order of a folder is any.
    std::sort(names.begin(), names.end());
    return names;
}

bool isRegular(const std::filesystem::path& path)
{
    std::error_code error;
    return std::filesystem::is_regular_file(path, error);
}

bool isThere(const std::filesystem::path& path)
{
    std::error_code error;
    return std::filesystem::exists(path, error);
}

// `relative` below `folder`, each part as it is or in letters of another case.
std::filesystem::path inAnyCase(const std::filesystem::path& folder,
                                const std::filesystem::path& relative)
{
    std::filesystem::path found = folder;
    for (const std::filesystem::path& part : relative) {
        const std::filesystem::path exact = found / part;
        if (isThere(exact) || part == "." || part == "..") {
            found = exact;
            continue;
        }
        const std::vector<std::string> names = namesIn(found);
        const auto near = std::find_if(names.begin(), names.end(), [&](const std::string& name) {
            return lowerCase(name) == lowerCase(part.string());
        });
        if (near == names.end())
            return {};
        found /= *near;
    }
    return found;
}

} // namespace

std::filesystem::path fileOrNear(const std::filesystem::path& folder, std::string_view name,
                                 const std::string& place, Diagnostics& diagnostics)
{
    const std::filesystem::path base = folder.empty() ? std::filesystem::path(".") : folder;
    // A path that begins at the root is taken below the folder, too.
    const auto below = [&](std::string_view text) {
        return std::filesystem::path(base.string() + "/" + std::string(text));
    };
    const std::filesystem::path exact = below(name);
    if (isRegular(exact))
        return exact;
    std::string slashed(name);
    std::replace(slashed.begin(), slashed.end(), '\\', '/');
    while (slashed.starts_with("/"))
        slashed.erase(0, 1);
    for (const std::filesystem::path& near : {below(slashed), inAnyCase(base, slashed)})
        if (!near.empty() && isRegular(near)) {
            diagnostics.warn("{}: it names {}, which is not there; {} is taken", place, name,
                             near.string());
            return near;
        }
    return exact;
}

std::string nearFileHint(const std::filesystem::path& missing)
{
    const std::string near =
        nearestWord(missing.filename().string(), namesIn(missing.parent_path()));
    return near.empty() ? std::string() : "; did you mean " + near + "?";
}

} // namespace sward::terrain
