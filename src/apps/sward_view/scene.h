#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace sward::view {

struct FrameOptions;

/// What a scene says under one key: a name, a file, or JSON that stands in the scene itself.
struct SceneText {
    std::string text;
    std::string place; ///< names it in messages: the scene's file, then the key
    bool isJson = false;
};

/// A scene of a file (docs/settings.md): what grows where, and how it is looked at.
struct Scene {
    std::filesystem::path file;
    std::string fieldName; ///< of the field without ".sward": its own name, or that of "of"
    SceneText ground;
    std::optional<SceneText> meadow;
    std::vector<std::string> bake; ///< options of 'sward bake'
    std::vector<std::string> draw; ///< options of 'sward-view bench'
    std::optional<SceneText> camera;
    std::optional<SceneText> moving; ///< a camera's path
    std::optional<SceneText> settings;
};

/// Whether `input` is the name of a scene's file.
bool isScene(const std::string& input);

/// Reads a scene, and the one that it takes its field from. Throws Error{io} if a file cannot be
/// read, Error{input} that names file, key, value and bound.
Scene readScene(const std::filesystem::path& file);

/// Lays what the scene says of the picture under what stands on the command line of `command`:
/// `options`, of which `command` has the switches. Throws Error{input} for options that `bench` has
/// not, or a path of a camera where there is none.
void lookAt(const Scene& scene, bool moving, const CLI::App& command, FrameOptions& options);

} // namespace sward::view
