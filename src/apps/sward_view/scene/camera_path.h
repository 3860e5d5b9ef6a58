#pragma once

#include "render/frame/camera.h"

#include <glm/vec3.hpp>

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace sward::view {

/// A camera path: a timed list of cameras, or one static camera.
class CameraPath {
public:
    CameraPath() = default;
    explicit CameraPath(const render::Camera& still) { add(0.0, still); }

    /// Adds a camera; `time` must be later than all before.
    void add(double time, const render::Camera& camera);

    /// Camera at `time` [s], on a smooth curve through all cameras; constant before the first and
    /// after the last. Requires at least one.
    render::Camera at(double time) const;

    bool isEmpty() const { return stops_.empty(); }
    std::size_t size() const { return stops_.size(); }
    double end() const { return stops_.empty() ? 0.0 : stops_.back().time; } ///< [s]

private:
    struct Stop {
        double time; ///< [s]
        render::Camera camera;
    };

    std::vector<Stop> stops_;
};

/// Reads a camera file (camera_file.h), or a list of such objects with "time" [s] in ascending
/// order. Throws as readCamera() does.
CameraPath readCameraPath(const std::filesystem::path& path, glm::vec3 up);

/// The same from a text; messages name `name`.
CameraPath readCameraPath(std::string_view text, const std::string& name, glm::vec3 up);

/// The path as text, sampled every `step` [s] from its first time.
std::string cameraPathText(const CameraPath& path, double step);

} // namespace sward::view
