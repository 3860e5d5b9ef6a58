#pragma once

#include "core/bounds.h"

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <array>

namespace sward::render {

/// Where the picture is taken from. Places are in world space and double precision; what the GPU
/// sees is relative to the field's origin.
struct Camera {
    glm::dvec3 eye{0.0, 1.7, 5.0};  ///< world [m]
    glm::dvec3 target{0.0};         ///< world [m]
    glm::vec3 up{0.0f, 1.0f, 0.0f}; ///< roughly upwards; need not be perpendicular to the view
    float fovY = 45.0f;             ///< vertical field of view [degrees], (0, 170]
    float near = 0.0f;              ///< [m]; 0: chosen from the distance to the field
    float far = 0.0f;               ///< [m]; 0: chosen so that the whole field is inside
};

/// The camera as matrices, relative to `origin`.
struct ViewMatrices {
    glm::mat4 viewProjection{1.0f}; ///< reversed Z: near → 1, far → 0; Vulkan's y downwards
    std::array<glm::vec4, 6>
        planes{};               ///< left right bottom top near far: unit normal inward, offset
    glm::vec3 eye{0.0f};        ///< relative to `origin`
    float pixelsPerUnit = 1.0f; ///< height [pixels] of something 1 m tall at 1 m
};

/// `jitter` moves the picture by so many pixels. `content` is the box of what can be seen, relative
/// to `origin`; it decides near and far where the camera does not.
ViewMatrices viewMatrices(const Camera& camera, glm::dvec3 origin, glm::uvec2 size,
                          const Aabb& content, glm::vec2 jitter = glm::vec2(0.0f));

/// Cameras that show all of `content` (relative to `origin`), with `groundUp` as up: from above at
/// an angle (fit), standing in it at eye level (eye), straight down (top), along the ground from
/// its border (edge).
enum class CameraPreset { fit, eye, top, edge };
Camera presetCamera(CameraPreset preset, const Aabb& content, glm::dvec3 origin, glm::vec3 groundUp,
                    float aspect);

} // namespace sward::render
