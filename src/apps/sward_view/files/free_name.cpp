#include "apps/sward_view/files/free_name.h"

#include <fmt/core.h>

#include <system_error>
#include <utility>

namespace sward::view {
namespace {

// Links that lead nowhere count: a name is taken if anything has it.
bool isTaken(const std::filesystem::path& path)
{
    std::error_code ignored;
    return std::filesystem::exists(std::filesystem::symlink_status(path, ignored));
}

} // namespace

std::filesystem::path freeName(const std::filesystem::path& path)
{
    std::filesystem::path name = path;
    for (int number = 2; isTaken(name); ++number)
        name = path.parent_path() /
               fmt::format("{}-{}{}", path.stem().string(), number, path.extension().string());
    return name;
}

std::string fieldNameFor(const std::string& input)
{
    return std::filesystem::path(input).stem().string() + ".sward";
}

std::string strokesNameFor(const std::string& input)
{
    return std::filesystem::path(input).stem().string() + ".strokes.json";
}

Question replaceQuestion(const std::filesystem::path& path,
                         std::function<void(const std::filesystem::path&, bool)> write)
{
    const std::filesystem::path other = freeName(path);
    return {
        fmt::format("{} exists already.", path.string()),
        {{"Replace", "Writes the new file; the old one is lost",
          [path, write] { write(path, true); }},
         {"Save as " + other.filename().string(), "Keeps both files: the new one gets this name",
          [other, write = std::move(write)] { write(other, false); }},
         {"Cancel", "Writes nothing (Escape)", {}}}};
}

} // namespace sward::view
