#pragma once

#include "apps/sward_view/dataset/dataset_scene.h"
#include "apps/sward_view/scene/camera_path.h"
#include "field/field.h"
#include "render/frame/camera.h"
#include "render/frame/frame_settings.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

namespace sward::view {

/// Index of the field that a frame of a set shows.
std::size_t fieldOfFrame(const DatasetScene& scene, std::uint64_t frame);

/// What a frame of a set shows: a function of the scene, the field and the frame's number alone.
struct DrawnFrame {
    render::Camera before; ///< DatasetScene::step before the frame
    render::Camera camera;
    render::Camera next; ///< and after it
    render::FrameSettings settings;
    double time = 0.0;         ///< [s]
    double windStrength = 0.0; ///< as --wind-strength
};

/// Draws frames of one field at random.
class FrameDraws {
public:
    /// All must outlive it. `settings`: of all frames. Throws Error{input} if cameras shall stand
    /// on ground and there is none, or as readCameraPath() does.
    FrameDraws(const DatasetScene& scene, const field::FieldView& field,
               const render::FrameSettings& settings);

    /// Throws Error{input} if the scene's area has no ground.
    DrawnFrame draw(std::uint64_t frame) const;

private:
    render::Camera onGround(std::uint64_t frame, double after) const;
    render::Camera onPath(std::uint64_t frame, double after) const;
    glm::dvec3 placeOnGround(std::uint64_t frame) const;
    glm::dvec3 headingOf(double degrees) const;
    double between(glm::dvec2 range, std::uint64_t frame, std::uint32_t dimension) const;

    const DatasetScene& scene_;
    const field::FieldView& field_;
    const render::FrameSettings& settings_;
    glm::dvec3 up_;    ///< unit, against gravity
    glm::dvec3 north_; ///< unit, level
    glm::dvec3 east_;
    CameraPath path_;                      ///< empty: cameras stand on the ground
    std::vector<double> areas_;            ///< [m²] of ground up to and with each triangle …
    std::vector<std::uint32_t> triangles_; ///< … whose first index is here
};

} // namespace sward::view
