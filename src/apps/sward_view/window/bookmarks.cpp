#include "apps/sward_view/window/bookmarks.h"

#include "apps/sward_view/camera_file.h"
#include "apps/sward_view/window/state_file.h"
#include "core/error.h"
#include "core/json_text.h"
#include "core/mapped_file.h"
#include "core/settings_json.h"

#include <nlohmann/json.hpp>

#include <set>
#include <string_view>
#include <utility>

namespace sward::view {
namespace {

constexpr std::size_t largestBookmarksFile = 1u << 20; ///< [bytes] about fifty times ninety cameras

std::map<std::string, Bookmarks::Numbered> readBookmarks(const std::filesystem::path& file)
{
    const std::vector<std::byte> bytes = readFile(file, largestBookmarksFile);
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const nlohmann::json json = parseJson(text, file.string());
    std::map<std::string, Bookmarks::Numbered> all;
    for (const auto& [input, numbered] : json.items())
        for (int number = 1; number <= 9; ++number) {
            const std::string key = std::to_string(number);
            if (!numbered.is_object() || !numbered.contains(key))
                continue;
            SettingsReader reader(numbered[key], key);
            all[input][number] = readCamera(reader, key, glm::vec3(0.0f, 1.0f, 0.0f));
        }
    return all;
}

} // namespace

Bookmarks::Bookmarks()
    : Bookmarks(stateFile("bookmarks.json"))
{
}

Bookmarks::Bookmarks(std::filesystem::path file)
    : file_(std::move(file))
{
    std::error_code error;
    if (file_.empty() || !std::filesystem::exists(file_, error))
        return;
    try {
        byInput_ = readBookmarks(file_);
    } catch (const Error&) {
        byInput_.clear();
    }
}

Bookmarks::Numbered Bookmarks::of(const std::string& input) const
{
    const auto found = byInput_.find(stateNameOf(input));
    return found == byInput_.end() ? Numbered() : found->second;
}

void Bookmarks::set(const std::string& input, int number, const render::Camera& camera)
{
    byInput_[stateNameOf(input)][number] = camera;
    keep();
}

void Bookmarks::keepOnly(std::span<const std::string> inputs)
{
    const std::set<std::string> wanted(inputs.begin(), inputs.end());
    if (std::erase_if(byInput_, [&](const auto& entry) { return !wanted.contains(entry.first); }) >
        0)
        keep();
}

void Bookmarks::keep() const
{
    nlohmann::ordered_json json = nlohmann::ordered_json::object();
    for (const auto& [input, numbered] : byInput_)
        for (const auto& [number, c] : numbered)
            json[input][std::to_string(number)] = {{"eye", {c.eye.x, c.eye.y, c.eye.z}},
                                                   {"target", {c.target.x, c.target.y, c.target.z}},
                                                   {"up", {c.up.x, c.up.y, c.up.z}},
                                                   {"fov_y_deg", c.fovY}};
    // A file name may be invalid UTF-8.
    keepState(file_, jsonText(json, 1) + "\n");
}

} // namespace sward::view
