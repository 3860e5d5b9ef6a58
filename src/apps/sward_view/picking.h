#pragma once

#include "apps/sward_view/shown_field.h"
#include "field/field.h"
#include "render/field_renderer.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <optional>

namespace sward::view {

/// A line of sight through a pixel.
struct Sight {
    glm::dvec3 eye{0.0};       ///< world [m]
    glm::dvec3 direction{0.0}; ///< unit
    double pixelSize = 0.001;  ///< [m] of one pixel at 1 m
};

/// Through `pixel` of a picture of `size` pixels.
Sight sightThrough(const render::Camera& camera, glm::vec2 pixel, glm::uvec2 size);

/// A blade that was pointed at.
struct PickedBlade {
    std::uint32_t patch = 0;                ///< of all that is shown
    std::uint32_t place = 0;                ///< in that patch
    field::PatchSource source;              ///< its field, and the patch of that
    shared::Blade blade = {};               ///< relative to the field's origin
    render::FieldRenderer::BladeRecord now; ///< with the id in its own field
};

/// The nearest blade that the sight passes, within a pixel or two, before the ground. `onlyDrawn`:
/// not those that were left out of the last frame. Waits for the device.
std::optional<PickedBlade> pickBlade(const render::FieldRenderer& renderer, const ShownField& shown,
                                     const Sight& sight, bool onlyDrawn);

/// The same blade as it is now.
PickedBlade lookAgain(const render::FieldRenderer& renderer, const ShownField& shown,
                      const PickedBlade& picked);

} // namespace sward::view
