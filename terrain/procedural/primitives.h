#pragma once

#include "terrain/ground_mesh.h"

#include <glm/vec2.hpp>

#include <cstdint>

namespace sward::terrain {

// Simple bodies around the world's origin, fronts outward; coordinates are equal on every CPU.

struct PlaneSettings {
    glm::dvec2 size{20.0};      ///< [m] along x and z
    glm::uvec2 cells{20U, 20U}; ///< two triangles each
};

/// A level square at y = 0 that faces up.
GroundMesh makePlane(const PlaneSettings& settings = {});

struct SphereSettings {
    double radius = 10.0;         ///< [m]
    std::uint32_t segments = 128; ///< around the axis, at least 3
    std::uint32_t rings =
        64; ///< from pole to pole, even, so that a ring of vertices is the equator
};

/// A sphere with its poles on the y axis and radial vertex normals; inscribed, so its area is below
/// 4πr².
GroundMesh makeSphere(const SphereSettings& settings = {});

struct TorusSettings {
    double majorRadius = 8.0;          ///< [m] of the circle in the x-z plane
    double minorRadius = 3.0;          ///< [m] of the tube, below majorRadius
    std::uint32_t majorSegments = 128; ///< at least 3
    std::uint32_t minorSegments = 64;  ///< at least 3
};

/// A torus that lies in the x-z plane.
GroundMesh makeTorus(const TorusSettings& settings = {});

} // namespace sward::terrain
