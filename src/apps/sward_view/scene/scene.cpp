#include "apps/sward_view/scene/scene.h"

#include "apps/sward_view/scene/frame_options.h"
#include "core/error.h"
#include "core/files/mapped_file.h"
#include "core/json/json_text.h"
#include "core/json/settings_json.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstddef>
#include <string_view>

namespace sward::view {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t largestSceneFile = 1u << 22; ///< [bytes]
constexpr std::size_t maxOptions = 256;

// Resolves a path with a slash in the scene's folder, else in the nearest parent that has it.
std::string fileNamed(const fs::path& scene, const std::string& text, const std::string& place)
{
    if (text.find('/') == std::string::npos)
        return text;
    const fs::path folder = fs::absolute(scene).parent_path();
    for (fs::path above = folder;; above = above.parent_path()) {
        if (fs::exists(above / text))
            return (above / text).lexically_normal().string();
        if (above == above.parent_path())
            break;
    }
    fail(ErrorKind::io, "{}: \"{}\" is neither in {} nor in a folder above it", place, text,
         folder.string());
}

std::optional<SceneText> readText(SettingsReader& reader, const char* key, const fs::path& file,
                                  bool mayBeArray = false)
{
    if (!reader.has(key))
        return std::nullopt;
    const nlohmann::json& value = reader.child(key);
    const std::string place = reader.placeOf(key);
    if (value.is_object() || (mayBeArray && value.is_array()))
        return SceneText{jsonText(value), place, true};
    if (!value.is_string())
        fail(ErrorKind::input, "{}: expected a text or an object, found {}", place,
             value.type_name());
    return SceneText{fileNamed(file, value.get<std::string>(), place), place, false};
}

std::vector<std::string> readOptions(SettingsReader& reader, const char* key)
{
    std::vector<std::string> options;
    if (!reader.has(key))
        return options;
    const nlohmann::json& array = reader.child(key);
    if (!array.is_array() || array.size() > maxOptions)
        fail(ErrorKind::input, "{}: expected an array of at most {} texts", reader.placeOf(key),
             maxOptions);
    for (const nlohmann::json& option : array) {
        if (!option.is_string())
            fail(ErrorKind::input, "{}: expected texts, found {}", reader.placeOf(key),
                 jsonText(option));
        options.push_back(option.get<std::string>());
    }
    return options;
}

// Reads the field settings of a scene.
void readField(SettingsReader& reader, Scene& scene)
{
    const std::optional<SceneText> ground = readText(reader, "ground", scene.file);
    if (!ground)
        fail(ErrorKind::input, "{}: missing", reader.placeOf("ground"));
    scene.ground = *ground;
    scene.meadow = readText(reader, "meadow", scene.file);
    scene.bake = readOptions(reader, "bake");
    int tiles = 1; // number of processes in scripts/bench
    reader.read("tiles", tiles, 1, 1'000'000);
}

// Skips keys of the gallery's pictures, which a bench does not use.
void passOver(SettingsReader& reader)
{
    std::string about;
    reader.read("about", about);
    for (const char* key : {"close", "frames"})
        reader.has(key);
}

Scene readScene(const fs::path& file, bool mayBorrow)
{
    const std::vector<std::byte> bytes = readFile(file, largestSceneFile);
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const nlohmann::json json = parseJson(text, file.string());
    SettingsReader reader(json, file.string());
    Scene scene;
    if (mayBorrow && reader.has("of")) {
        std::string other;
        reader.read("of", other);
        scene = readScene(file.parent_path() / (other + ".json"), false);
        scene.file = file;
    } else {
        scene.file = file;
        scene.fieldName = file.stem().string();
        readField(reader, scene);
    }
    passOver(reader);
    if (reader.has("draw"))
        scene.draw = readOptions(reader, "draw");
    if (auto camera = readText(reader, "camera", file, true))
        scene.camera = std::move(camera);
    if (auto moving = readText(reader, "moving", file, true))
        scene.moving = std::move(moving);
    if (auto settings = readText(reader, "settings", file))
        scene.settings = std::move(settings);
    reader.finish();
    return scene;
}

// The scene's options that the command line does not set.
std::vector<std::string> optionsLeft(const std::vector<std::string>& options,
                                     const CLI::App& command)
{
    std::vector<std::string> left;
    bool taken = true;
    for (const std::string& option : options) {
        if (option.starts_with("--")) {
            const CLI::Option* const own = command.get_option_no_throw(option);
            taken = own == nullptr || own->count() == 0;
        }
        if (taken)
            left.push_back(option);
    }
    return left;
}

} // namespace

bool isScene(const std::string& input)
{
    return input.ends_with(".json");
}

Scene readScene(const std::filesystem::path& file)
{
    return readScene(file, true);
}

void lookAt(const Scene& scene, bool moving, const CLI::App& command, FrameOptions& options)
{
    // Options.
    CLI::App app;
    options.addShared(app);
    options.addMeasured(app);
    app.get_option("--device")->envname("");
    std::vector<std::string> left = optionsLeft(scene.draw, command);
    std::reverse(left.begin(), left.end());
    const std::string place = fmt::format("{}: draw", scene.file.string());
    try {
        app.parse(std::move(left));
    } catch (const CLI::Error& error) {
        fail(ErrorKind::input, "{}: {}", place, error.what());
    } catch (const Error& error) {
        fail(ErrorKind::input, "{}: {}", place, error.what());
    }

    // Camera.
    if (moving && !scene.moving)
        fail(ErrorKind::input, "{}: moving: missing", scene.file.string());
    const std::optional<SceneText>& camera = moving ? scene.moving : scene.camera;
    if (camera && command.get_option("--camera")->count() == 0) {
        if (camera->isJson)
            options.sceneCamera = *camera;
        else
            options.camera = camera->text;
    }
    if (scene.settings && scene.settings->isJson)
        options.sceneSettings = *scene.settings;
    else if (scene.settings && options.settingsFile.empty())
        options.settingsFile = scene.settings->text;
}

} // namespace sward::view
