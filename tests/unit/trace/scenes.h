#pragma once

#include "trace/surfaces.h"

#include <glm/vec3.hpp>

namespace sward::trace {

/// Surfaces without anything, for tests to fill.
inline Surfaces nothing()
{
    Surfaces surfaces;
    surfaces.points.emplace_back(0.0f);
    surfaces.groundPoints.emplace_back(0.0f);
    return surfaces;
}

/// Adds a flat leaf between four corners, as blade number `blade`: `albedo` on both sides, and what
/// it leaves passes if `translucency` is large.
inline void addLeaf(Surfaces& surfaces, glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 d,
                    glm::vec3 albedo, float translucency = 0.0f, std::uint32_t blade = 0)
{
    surfaces.points.pop_back();
    const auto first = static_cast<std::uint32_t>(surfaces.points.size());
    const auto strip = static_cast<std::uint32_t>(surfaces.strips.size());
    surfaces.strips.push_back({.firstQuad = static_cast<std::uint32_t>(surfaces.quads.size()),
                               .firstRow = static_cast<std::uint32_t>(surfaces.along.size()),
                               .blade = blade,
                               .columns = 1,
                               .root = albedo,
                               .tip = albedo,
                               .translucency = translucency,
                               .gloss = 0.0f});
    surfaces.points.insert(surfaces.points.end(), {a, b, c, d, glm::vec3(0.0f)});
    surfaces.quads.emplace_back(first, first + 1, first + 2, first + 3);
    surfaces.quadStrip.push_back(strip);
    surfaces.along.insert(surfaces.along.end(), {0.0f, 1.0f});
}

/// Adds a level square of `extent` [m] of ground around the origin at height 0.
inline void addGround(Surfaces& surfaces, float extent, glm::vec3 albedo)
{
    surfaces.groundPoints.pop_back();
    const auto first = static_cast<std::uint32_t>(surfaces.groundPoints.size());
    const float h = 0.5f * extent;
    surfaces.groundPoints.insert(surfaces.groundPoints.end(),
                                 {{-h, 0, -h}, {-h, 0, h}, {h, 0, h}, {h, 0, -h}, {0, 0, 0}});
    for (int i = 0; i < 4; ++i) {
        surfaces.groundColors.emplace_back(albedo);
        surfaces.groundUvs.emplace_back(0.0f);
    }
    surfaces.groundTriangles.emplace_back(first, first + 1, first + 2);
    surfaces.groundTriangles.emplace_back(first, first + 2, first + 3);
    surfaces.groundMaterials.insert(surfaces.groundMaterials.end(), {0U, 0U});
    surfaces.materials = {{glm::vec4(1.0f), 1.0f, 0.0f, shared::noImage, 0}};
}

} // namespace sward::trace
