#pragma once

#include "core/bounds.h"

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <array>

namespace sward::render {

/// Position and orientation of the view. Places are in world space and double precision; the GPU
/// uses places relative to the field's origin.
struct Camera {
    glm::dvec3 eye{0.0, 1.7, 5.0};  ///< world [m]
    glm::dvec3 target{0.0};         ///< world [m]
    glm::vec3 up{0.0f, 1.0f, 0.0f}; ///< roughly upwards; need not be perpendicular to the view
    float fovY = 45.0f;             ///< vertical field of view [degrees], (0, 170]
    float near = 0.0f;              ///< [m]; 0: chosen from the distance to the field
    float far = 0.0f;               ///< [m]; 0: chosen so that the whole field is inside

    bool operator==(const Camera&) const = default; ///< equal in every member
};

/// The camera as matrices, relative to `origin`.
struct ViewMatrices {
    glm::mat4 viewProjection{1.0f}; ///< reversed Z: near → 1, far → 0; Vulkan's y downwards
    std::array<glm::vec4, 6>
        planes{};               ///< left right bottom top near far: unit normal inward, offset
    glm::vec3 eye{0.0f};        ///< relative to `origin`
    float pixelsPerUnit = 1.0f; ///< height [pixels] of an object of 1 m at 1 m
};

/// `jitter` shifts the picture [pixels]. `content` is the box of everything visible, relative to
/// `origin`; it sets near and far unless the camera does.
ViewMatrices viewMatrices(const Camera& camera, glm::dvec3 origin, glm::uvec2 size,
                          const Aabb& content, glm::vec2 jitter = glm::vec2(0.0f));

/// The view of a part of `size` pixels from pixel `first` of a picture of `whole` pixels; it may
/// reach beyond the picture. Blades keep the level of detail that they have in the whole picture.
ViewMatrices partOf(const ViewMatrices& view, glm::uvec2 whole, glm::ivec2 first, glm::uvec2 size);

} // namespace sward::render
