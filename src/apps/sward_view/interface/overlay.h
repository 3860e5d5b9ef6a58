#pragma once

#include "apps/sward_view/interface/control_map.h"
#include "apps/sward_view/interface/style.h"
#include "apps/sward_view/viewer_state.h"
#include "render/frame/camera.h"

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace sward::view {

/// Lines over the picture and below the panels, for objects in the world other than grass.
class Overlay {
public:
    /// Overlay for a window of `size`, in its coordinates, taken by `camera`.
    Overlay(const Style& style, const render::Camera& camera, glm::uvec2 size,
            const ShownField& field);

    /// Draws the enabled parts of the state: colliders, wind arrows, frozen frustum, picked blade.
    void draw(const ViewerState& state) const;

    /// Adds the screen positions of the colliders to the map.
    void tell(const ViewerState& state, ControlMap& map) const;

private:
    glm::dvec2 onScreen(const glm::dvec4& clip) const;
    void line(const glm::dvec3& from, const glm::dvec3& to, ImU32 color, float width) const;
    void circle(const glm::dvec3& centre, const glm::dvec3& right, const glm::dvec3& up,
                ImU32 color) const;
    void drawCollider(const render::Collider& collider, double time, bool chosen) const;
    void drawWinds(const ViewerState& state) const;
    void drawFrustum(const render::Camera& frozen) const;
    void drawRings(const ViewerState& state) const;
    void drawPicked(const PickedBlade& picked) const;

    const Style& style_;
    render::Camera camera_;
    glm::dvec2 size_;
    glm::dvec3 origin_;
    Aabb content_;
    glm::dmat4 clip_; ///< relative to the origin
};

} // namespace sward::view
