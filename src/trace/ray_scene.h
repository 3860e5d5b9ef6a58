#pragma once

#include "trace/surfaces.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <memory>

namespace sward::trace {

/// A place where a ray meets a surface.
struct RayHit {
    Part part = Part::blades;
    std::uint32_t primitive = 0; ///< quad of the blades, triangle of the ground
    float distance = 0.0f;       ///< [m]
    glm::vec3 position{0.0f};    ///< [m] from the primitive's corners, not from the ray
    glm::vec3 normal{0.0f};      ///< unit, of the primitive, on the side where the ray comes from
    glm::vec3 shares{0.0f};      ///< of the ground: weights of the triangle's corners
    float along = 0.0f;          ///< of blades: [0, 1] between root and tip
    float across = 0.0f;         ///< of blades: −1 … 1 between left and right edge
    std::uint32_t strip = 0;     ///< of blades: index of Surfaces::strips
};

/// Rays among the surfaces. Embree answers them in robust mode, with AVX2 where the CPU has it,
/// over a hierarchy that one thread builds: every run has the same hits. Thread-safe once built.
class RayScene {
public:
    /// Throws Error{runtime} if memory is short, Error{unsupported} without SSE2.
    explicit RayScene(Surfaces surfaces);
    RayScene(RayScene&&) noexcept;            ///< references stay valid
    RayScene& operator=(RayScene&&) noexcept; ///< discards the former scene
    ~RayScene();

    /// What the scene holds.
    const Surfaces& surfaces() const;

    /// Whether the ray meets something; then `hit` is the nearest. `direction` is unit.
    bool meets(glm::vec3 from, glm::vec3 direction, RayHit& hit) const;

    /// Whether anything lies in a unit direction.
    bool isHidden(glm::vec3 from, glm::vec3 direction) const;

    /// The start of a ray that leaves a hit on the side of `direction`: the place, moved along the
    /// normal by 1e-6 of its largest coordinate, which exceeds all rounding.
    static glm::vec3 leaving(const RayHit& hit, glm::vec3 direction);

private:
    struct Scene;
    std::unique_ptr<Scene> scene_;
};

} // namespace sward::trace
