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

/// Value of a scene's key: a name, a file, or JSON inside the scene.
struct SceneText {
    std::string text;
    std::string place; ///< name for messages: the scene's file, then the key
    bool isJson = false;
};

/// A scene file (docs/settings.md): field, camera and picture settings.
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

/// Reads a scene, and the scene that defines its field. Throws Error{io} if a file cannot be read,
/// Error{input} naming file, key, value and bound.
Scene readScene(const std::filesystem::path& file);

/// Applies the scene's picture settings to `options`, except those set on the command line of
/// `command`. Throws Error{input} for options unknown to `bench`, or if a camera path is requested
/// and missing.
void lookAt(const Scene& scene, bool moving, const CLI::App& command, FrameOptions& options);

} // namespace sward::view
