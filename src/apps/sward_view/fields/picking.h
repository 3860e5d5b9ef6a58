#pragma once

#include "apps/sward_view/fields/shown_field.h"
#include "field/field.h"
#include "render/viewer/field_renderer.h"

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

/// The line of sight through `pixel` of a picture of `size` pixels.
Sight sightThrough(const render::Camera& camera, glm::vec2 pixel, glm::vec2 size);

/// A blade that is sown, and its key.
struct PickedSown {
    render::SownPatch patch;
    field::BladeKey key;
};

/// A picked blade.
struct PickedBlade {
    std::uint32_t patch = 0;                ///< in the joined view; unless it is sown
    std::uint32_t place = 0;                ///< index in that patch, or in the sown one
    field::PatchSource source;              ///< its field, and its patch there; unless it is sown
    std::optional<PickedSown> sown;         ///< unset: it is stored
    shared::Blade blade = {};               ///< relative to the field's origin
    render::FieldRenderer::BladeRecord now; ///< with the id in its own field
};

/// The nearest blade within a pixel or two of the line of sight and in front of the ground.
/// `onlyDrawn`: ignore blades not drawn in the last frame. Waits for the device.
std::optional<PickedBlade> pickBlade(const render::FieldRenderer& renderer, const ShownField& shown,
                                     const Sight& sight, bool onlyDrawn);

/// The current state of the same blade.
PickedBlade lookAgain(const render::FieldRenderer& renderer, const ShownField& shown,
                      const PickedBlade& picked);

} // namespace sward::view
