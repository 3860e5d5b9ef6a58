#pragma once

#include "core/bounds.h"
#include "field/measure/distributions.h"
#include "render/frame/camera.h"
#include "render/frame/frame_settings.h"
#include "shaders/shared/frame.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace sward::render {

/// What the level of detail of a field that is sown depends on (decision 0045).
struct SownShape {
    double room = 0.0;          ///< blades that may be in memory at once; 0: it is not sown
    double bladesPerArea = 0.0; ///< [1/m²] of the closed sward
    double stored = 1.0;        ///< share of the blades that is always there
    double blades = 0.0;        ///< all that would grow; 0: not known
    double levels = 6.0;        ///< field::SeedMeadow::levels
};

/// Properties of a field, besides its buffers, that a frame depends on.
struct FieldShape {
    glm::dvec3 origin{0.0};
    Aabb content;           ///< relative to the origin
    field::BladeSize blade; ///< typical size
    float exposure = 1.0f;  ///< where the settings leave it open
    SownShape sown{};
};

/// Distance [m] up to which a sown field's level of detail is that of a stored one: with less
/// beyond it, see shared::sparseShare(), what is drawn around an eye on level ground fits into the
/// room. `full`: distance up to which all blades are drawn [m]; `nearest`: of the content from the
/// eye [m]. 0: everything fits.
float sparseDistance(const FieldShape& field, float full, float nearest);

/// Writes the projection of a frame's picture, for an eye at `eye`.
void project(shared::Frame& frame, const glm::mat4& viewProjection, glm::vec3 eye);

/// Writes a camera into a frame.
void look(shared::Frame& frame, const ViewMatrices& view);

/// The culling tests and the level of detail of a view, so far as the settings tell them.
shared::Eyepoint testsOf(const FrameSettings& settings);

/// Camera, settings and time in shader form. PlacedField::write() adds the
/// addresses and counts of buffers.
shared::Frame frameOf(const FieldShape& field, const ViewMatrices& view,
                      const FrameSettings& settings, double time, std::uint32_t samples);

/// The frame that lists every blade for the picture and keeps the cull results found before.
shared::Frame listingAll(const shared::Frame& frame);

} // namespace sward::render
