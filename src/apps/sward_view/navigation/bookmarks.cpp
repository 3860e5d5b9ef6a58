#include "apps/sward_view/navigation/bookmarks.h"

#include "apps/sward_view/files/free_name.h"
#include "apps/sward_view/files/state_file.h"
#include "apps/sward_view/scene/camera_file.h"
#include "core/error.h"
#include "core/json/json_text.h"
#include "core/json/settings_json.h"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <charconv>
#include <optional>
#include <string_view>
#include <utility>

namespace sward::view {
namespace {

using nlohmann::ordered_json;

constexpr const char* asideMark = " (damaged"; ///< in keys of entries that are no camera

// The number of a bookmark, 1 to 9.
std::optional<int> numberOf(const std::string& key)
{
    return key.size() == 1 && key[0] >= '1' && key[0] <= '9' ? std::optional(key[0] - '0')
                                                             : std::nullopt;
}

// The inputs of a file, in the order in which they were set; nothing if it is no such file.
std::optional<ordered_json> inputsOf(const std::string& text, const std::filesystem::path& file,
                                     std::string& why)
{
    if (text.empty())
        return ordered_json::object();
    try {
        // Within the limits on JSON, and with their messages.
        parseJson(text, file.string());
    } catch (const Error& error) {
        why = error.what();
        return std::nullopt;
    }
    ordered_json json = ordered_json::parse(text, nullptr, false);
    if (json.is_object())
        return json;
    why = file.string() + ": is no list of inputs, which is an object";
    return std::nullopt;
}

ordered_json jsonOf(const render::Camera& c)
{
    return {{"eye", {c.eye.x, c.eye.y, c.eye.z}},
            {"target", {c.target.x, c.target.y, c.target.z}},
            {"up", {c.up.x, c.up.y, c.up.z}},
            {"fov_y_deg", c.fovY}};
}

// The camera of an entry. Throws Error{input} if it is none.
render::Camera cameraOf(const ordered_json& entry, const std::string& place)
{
    const nlohmann::json object = entry;
    if (!object.is_object())
        fail(ErrorKind::input, "{}: is no camera, which is an object", place);
    SettingsReader reader(object, place);
    return readCamera(reader, place, glm::vec3(0.0f, 1.0f, 0.0f));
}

// A file name may be invalid UTF-8; in JSON it is as jsonText() writes it.
std::string keyOf(const std::string& input)
{
    return toUtf8(stateNameOf(input));
}

// The entry under `key` of an object; null if there is none.
const ordered_json* entryAt(const ordered_json& object, const std::string& key)
{
    const auto found = object.is_object() ? object.find(key) : object.end();
    return object.is_object() && found != object.end() ? &*found : nullptr;
}

} // namespace

Bookmarks::Bookmarks()
    : Bookmarks(stateFile("bookmarks.json"))
{
}

Bookmarks::Bookmarks(std::filesystem::path file)
    : file_(std::move(file))
{
}

void Bookmarks::complain(const std::string& what)
{
    if (told_.find(what) != std::string::npos)
        return;
    told_ += what + "\n";
    complaint_ += (complaint_.empty() ? "" : "\n") + what;
}

std::string Bookmarks::takeComplaint()
{
    return std::exchange(complaint_, {});
}

Bookmarks::Numbered Bookmarks::of(const std::string& input)
{
    Numbered numbered;
    std::string text;
    try {
        if (!file_.empty())
            text = readState(file_);
    } catch (const Error& error) {
        complain(error.what());
        return numbered;
    }
    std::string why;
    const auto inputs = inputsOf(text, file_, why);
    if (!inputs) {
        complain(why + ". No place is recalled from it; the next one that is set moves it aside.");
        return numbered;
    }
    const ordered_json* const own = entryAt(*inputs, keyOf(input));
    if (own == nullptr)
        return numbered;
    const std::string place = file_.string() + ": " + keyOf(input);
    if (!own->is_object())
        complain(place + ": is no list of places, which is an object; it stays in the file");
    else
        for (const auto& [key, entry] : own->items())
            try {
                if (key.find(asideMark) != std::string::npos)
                    continue;
                const auto number = numberOf(key);
                if (!number)
                    fail(ErrorKind::input, "{}: {}: is no number from 1 to 9", place, key);
                numbered[*number] = cameraOf(entry, place + ": " + key);
            } catch (const Error& error) {
                complain(std::string(error.what()) + "; it stays in the file");
            }
    return numbered;
}

void Bookmarks::set(const std::string& input, int number, const render::Camera& camera)
{
    if (file_.empty())
        return;
    changeState(file_, [&](const std::string& text) {
        std::string why;
        auto inputs = inputsOf(text, file_, why);
        if (!inputs) {
            const std::filesystem::path aside = freeName(file_.string() + ".damaged");
            std::filesystem::copy_file(file_, aside);
            complain(why + ". It is kept as " + aside.string());
            inputs = ordered_json::object();
        }
        // The newest last.
        const std::string key = keyOf(input);
        ordered_json own = ordered_json::object();
        if (const ordered_json* const before = entryAt(*inputs, key)) {
            own = *before;
            inputs->erase(key);
        }
        const std::string name = std::to_string(number);
        const ordered_json* const former = own.is_object() ? entryAt(own, name) : &own;
        bool isBad = false;
        try {
            if (former != nullptr)
                cameraOf(*former, key);
        } catch (const Error&) {
            isBad = true;
        }
        if (isBad) {
            // What the new place takes the room of.
            std::string aside = (own.is_object() ? name : std::string("places")) + asideMark + ")";
            ordered_json kept = *former;
            if (!own.is_object())
                own = ordered_json::object();
            for (int i = 2; own.contains(aside); ++i)
                aside = fmt::format("{}{} {})", name, asideMark, i);
            complain(fmt::format("{}: {}: {}: is no camera; it is kept there as \"{}\"",
                                 file_.string(), key, name, aside));
            own[aside] = std::move(kept);
        }
        own[name] = jsonOf(camera);
        (*inputs)[key] = std::move(own);
        while (inputs->size() > maxInputs)
            inputs->erase(inputs->begin());
        return jsonText(*inputs, 1) + "\n";
    });
}

} // namespace sward::view
