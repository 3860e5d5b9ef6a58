#include "terrain/procedural/primitives.h"

#include "core/expect.h"
#include "core/math/exact_math.h"
#include "terrain/heightmap/heightfield.h"
#include "terrain/topology/soup.h"

namespace sward::terrain {
namespace {

constexpr double pi = 3.14159265358979323846;

// Part `i` of a full turn of `n`; the last is bitwise equal to the first.
SinCos turn(std::uint32_t i, std::uint32_t n)
{
    return exactSinCos(2.0 * pi * static_cast<double>(i % n) / static_cast<double>(n));
}

glm::vec2 uvAt(std::uint32_t i, std::uint32_t columns, std::uint32_t j, std::uint32_t rows)
{
    return glm::vec2(glm::dvec2(i, j) / glm::dvec2(columns, rows));
}

} // namespace

GroundMesh makePlane(const PlaneSettings& settings)
{
    return heightfield({settings.size, settings.cells}, [](double, double) { return 0.0; });
}

GroundMesh makeSphere(const SphereSettings& settings)
{
    expect(settings.segments >= 3 && settings.rings >= 2 && settings.rings % 2 == 0,
           "a sphere needs 3 segments and an even number of rings");
    const std::uint32_t columns = settings.segments + 1; // the seam is duplicated for its uv
    Soup soup;
    for (std::uint32_t ring = 0; ring <= settings.rings; ++ring) {
        // Angles start at the equator, so that both halves are bitwise mirror images.
        const double halfRings = static_cast<double>(settings.rings) / 2.0;
        const double above = halfRings - static_cast<double>(ring);
        const bool isPole = ring == 0 || ring == settings.rings;
        const SinCos latitude = exactSinCos(0.5 * pi * (above < 0.0 ? -above : above) / halfRings);
        for (std::uint32_t i = 0; i < columns; ++i) {
            const SinCos longitude = turn(i, settings.segments);
            const double across = isPole ? 0.0 : latitude.cos;
            const glm::dvec3 normal(across * longitude.cos,
                                    above < 0.0 ? -latitude.sin : latitude.sin,
                                    -across * longitude.sin);
            soup.positions.push_back(settings.radius * normal);
            soup.normals.emplace_back(normal);
            soup.uvs.push_back(uvAt(i, settings.segments, ring, settings.rings));
        }
    }
    for (std::uint32_t ring = 0; ring < settings.rings; ++ring)
        for (std::uint32_t i = 0; i < settings.segments; ++i) {
            const std::uint32_t a = ring * columns + i;
            const std::uint32_t c = a + columns;
            if (ring > 0)
                soup.triangles.emplace_back(a, c, a + 1);
            if (ring + 1 < settings.rings)
                soup.triangles.emplace_back(a + 1, c, c + 1);
        }
    return settle(std::move(soup), "sphere");
}

GroundMesh makeTorus(const TorusSettings& settings)
{
    expect(settings.majorSegments >= 3 && settings.minorSegments >= 3 &&
               settings.minorRadius < settings.majorRadius,
           "a torus needs 3 segments each way and a hole");
    const std::uint32_t columns = settings.minorSegments + 1;
    Soup soup;
    for (std::uint32_t i = 0; i <= settings.majorSegments; ++i) {
        const SinCos around = turn(i, settings.majorSegments);
        const glm::dvec3 outward(around.cos, 0.0, -around.sin);
        for (std::uint32_t j = 0; j < columns; ++j) {
            const SinCos tube = turn(j, settings.minorSegments);
            const glm::dvec3 normal = tube.cos * outward + glm::dvec3(0.0, tube.sin, 0.0);
            soup.positions.push_back(settings.majorRadius * outward +
                                     settings.minorRadius * normal);
            soup.normals.emplace_back(normal);
            soup.uvs.push_back(uvAt(i, settings.majorSegments, j, settings.minorSegments));
        }
    }
    for (std::uint32_t i = 0; i < settings.majorSegments; ++i)
        for (std::uint32_t j = 0; j < settings.minorSegments; ++j) {
            const std::uint32_t a = i * columns + j;
            const std::uint32_t c = a + columns;
            soup.triangles.emplace_back(a, c, a + 1);
            soup.triangles.emplace_back(a + 1, c, c + 1);
        }
    return settle(std::move(soup), "torus");
}

} // namespace sward::terrain
