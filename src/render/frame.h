#pragma once

#include "core/bounds.h"
#include "field/distributions.h"
#include "render/camera.h"
#include "render/frame_settings.h"
#include "shaders/shared/frame.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace sward::render {

/// What of a field, beside its buffers, decides about a frame.
struct FieldShape {
    glm::dvec3 origin{0.0};
    Aabb content;           ///< relative to the origin
    field::BladeSize blade; ///< a typical one
};

/// Writes into a frame how its picture is seen, with an eye at `eye`.
void project(shared::Frame& frame, const glm::mat4& viewProjection, glm::vec3 eye);

/// Writes a camera into a frame.
void look(shared::Frame& frame, const ViewMatrices& view);

/// Camera, settings and time as the shaders read them. The addresses and counts of buffers are left
/// to FieldBuffers::describe() and FrameTables::write().
shared::Frame frameOf(const FieldShape& field, const ViewMatrices& view,
                      const FrameSettings& settings, double time, std::uint32_t samples);

} // namespace sward::render
