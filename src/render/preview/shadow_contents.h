#pragma once

#include "shaders/shared/collision.h"
#include "shaders/shared/sun_shadow.h"

#include <glm/vec3.hpp>
#include <vulkan/vulkan.h>

#include <cstdint>
#include <span>
#include <vector>

namespace sward::render {

/// Rectangle of the shadow map's pixels that a collider may cover; empty if it casts no shadow on
/// the ground.
VkRect2D shadowRect(const shared::SunShadow& view, const shared::Collider& collider);

/// Parts of the shadow map that differ from the frame before. Rectangles do not overlap.
struct ShadowChanges {
    bool ground = false;                  ///< the whole ground is drawn anew, without colliders
    std::vector<VkRect2D> parts;          ///< of the map; get the ground's depths again …
    std::vector<std::uint32_t> colliders; ///< … and then these colliders are drawn
    bool isNone() const { return !ground && parts.empty(); }
};

/// What the shadow map shows. The ground is drawn when the sun moves; of the colliders those that
/// change and touch the map.
class ShadowContents {
public:
    /// Changes that bring the map to this frame. They count as done.
    ShadowChanges follow(const shared::SunShadow& view, glm::vec3 sun,
                         std::span<const shared::Collider> colliders);

private:
    /// A collider without its velocity, which casts no shadow.
    struct Shape {
        glm::vec3 from, to;
        float radius;
        bool operator==(const Shape&) const = default;
    };

    glm::vec3 sun_{0.0f};
    std::vector<Shape> shapes_;
    std::vector<VkRect2D> rects_; ///< of each shape
};

} // namespace sward::render
