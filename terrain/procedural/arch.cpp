#include "core/expect.h"
#include "core/math/exact_math.h"
#include "terrain/procedural/landforms.h"
#include "terrain/topology/soup.h"

#include <glm/geometric.hpp>

#include <cmath>

namespace sward::terrain {
namespace {

constexpr double pi = 3.14159265358979323846;
constexpr std::uint32_t alongSegments = 96;
constexpr std::uint32_t aroundSegments = 40;
constexpr double sunk = 0.25; // how far each foot goes on below the ground [rad of the half circle]

// A half torus in the x-y plane from foot to foot, its feet closed. The rock bulges by noise.
GroundMesh makeRock(const ArchSettings& settings)
{
    const Octaves bulges{.count = 4, .lacunarity = 2.0, .gain = 0.5};
    Soup soup;
    for (std::uint32_t i = 0; i <= alongSegments; ++i) {
        const double angle =
            -sunk + (pi + 2.0 * sunk) * static_cast<double>(i) / static_cast<double>(alongSegments);
        const SinCos along = exactSinCos(angle);
        const glm::dvec3 outward(along.cos, along.sin, 0.0);
        for (std::uint32_t j = 0; j < aroundSegments; ++j) {
            const SinCos tube = exactSinCos(2.0 * pi * static_cast<double>(j) /
                                            static_cast<double>(aroundSegments));
            const glm::dvec3 normal = tube.cos * outward + glm::dvec3(0.0, 0.0, tube.sin);
            const glm::dvec3 smooth = settings.span * outward + settings.thickness * normal;
            const double bulge =
                settings.roughness * 2.0 * fractalNoise(settings.seed, smooth * 0.8, bulges);
            soup.positions.push_back(smooth + bulge * normal);
            soup.uvs.emplace_back(glm::dvec2(static_cast<double>(i) / alongSegments,
                                             static_cast<double>(j) / aroundSegments));
        }
    }
    for (std::uint32_t i = 0; i < alongSegments; ++i)
        for (std::uint32_t j = 0; j < aroundSegments; ++j) {
            const std::uint32_t a = i * aroundSegments + j;
            const std::uint32_t b = i * aroundSegments + (j + 1) % aroundSegments;
            soup.triangles.emplace_back(a, a + aroundSegments, b);
            soup.triangles.emplace_back(b, a + aroundSegments, b + aroundSegments);
        }

    // Close each foot with a fan around its middle.
    for (const std::uint32_t ring : {0U, alongSegments}) {
        const std::uint32_t first = ring * aroundSegments;
        glm::dvec3 middle(0.0);
        for (std::uint32_t j = 0; j < aroundSegments; ++j)
            middle += soup.positions[first + j] / static_cast<double>(aroundSegments);
        const auto centre = static_cast<std::uint32_t>(soup.positions.size());
        soup.positions.push_back(middle);
        soup.uvs.emplace_back(0.5f);
        for (std::uint32_t j = 0; j < aroundSegments; ++j) {
            const std::uint32_t a = first + j;
            const std::uint32_t b = first + (j + 1) % aroundSegments;
            soup.triangles.emplace_back(centre, ring == 0 ? a : b, ring == 0 ? b : a);
        }
    }
    GroundMesh rock = settle(std::move(soup), "arch");
    rock.materials[0] = {.name = "rock", .baseColor = glm::vec4(0.25f, 0.24f, 0.22f, 1.0f)};
    rock.nodes[0] = "arch";
    return rock;
}

} // namespace

GroundMesh makeArch(const ArchSettings& settings)
{
    expect(settings.thickness + settings.roughness < settings.span, "an arch needs a passage");
    HillsSettings gentle;
    gentle.grid = {glm::dvec2(settings.patch), glm::uvec2(96U)};
    gentle.seed = settings.seed;
    gentle.height = 0.6;
    gentle.width = 12.0;
    gentle.octaves.count = 3;
    GroundMesh mesh = makeHills(gentle);
    mesh.nodes[0] = "ground";
    append(mesh, makeRock(settings));
    return mesh;
}

} // namespace sward::terrain
