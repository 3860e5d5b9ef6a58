#include "terrain/loading/plausibility.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace sward::terrain {
namespace {

constexpr std::size_t samples = 1U << 16; // most triangles tested

// Ground on its side: thin axis at most this share of the others; most area, and twice the area
// facing up, faces that axis. A wall looks the same, so the warning says "if".
constexpr double thin = 0.5;
constexpr double thinWithUnits = 0.2; // where the format defines up
constexpr double share = 0.6;

// Other units: wider than plausible for a hundred thousand triangles, or, if the format defines no
// units, a kilometre or more in large triangles. Planes of a few triangles may have any size.
constexpr std::size_t fewTriangles = 100'000;
constexpr std::size_t someTriangles = 100;
constexpr double veryWide = 20e3;   // [m]
constexpr double wide = 1e3;        // [m]
constexpr double largeEdge = 20.0;  // [m]
constexpr double withUnits = 10.0;  // times wider where the format defines metres
constexpr double millimetres = 100; // times wider than for centimetres

struct Shape {
    DAabb bounds;
    glm::dvec3 looks{0.0}; // area facing each axis, both directions
    glm::dvec3 net{0.0};   // signed area facing each axis
    double area = 0.0;
    std::size_t triangles = 0; // that bear grass
};

Shape shapeOf(const GroundMesh& ground)
{
    Shape shape;
    const std::size_t step = ground.triangles.size() / samples + 1;
    for (std::size_t i = 0; i < ground.triangles.size(); i += step) {
        if (ground.bears[i] == 0)
            continue;
        const double area = ground.area(i);
        const glm::dvec3 normal = ground.faceNormal(i);
        shape.looks += area * glm::abs(normal);
        shape.net += area * normal;
        shape.area += area;
        shape.triangles += step;
        for (glm::length_t corner = 0; corner < 3; ++corner)
            shape.bounds.add(glm::dvec3(ground.positions[ground.triangles[i][corner]]));
    }
    shape.area *= static_cast<double>(step);
    shape.looks *= static_cast<double>(step);
    shape.net *= static_cast<double>(step);
    return shape;
}

void warnOfUpAxis(const Shape& shape, bool hasUnits, const std::string& place,
                  Diagnostics& diagnostics)
{
    const glm::dvec3 size = shape.bounds.size();
    for (const glm::length_t axis : {2, 0}) {
        const double others = std::min(size.y, size[2 - axis]);
        if (size[axis] > (hasUnits ? thinWithUnits : thin) * others ||
            shape.looks[axis] < share * shape.area || shape.looks[axis] < 2.0 * shape.looks.y)
            continue;
        const char name = axis == 2 ? 'z' : 'x';
        const char* const sign = shape.net[axis] < -0.5 * shape.area ? "-" : "";
        diagnostics.warn("{}: its ground is upright and faces along {}{}; if that is up in the "
                         "file, try --up-axis {}{}",
                         place, sign, name, sign, name);
    }
}

void warnOfUnits(const Shape& shape, bool hasUnits, const std::string& place,
                 Diagnostics& diagnostics)
{
    const glm::dvec3 size = shape.bounds.size();
    const double width = std::max({size.x, size.y, size.z});
    const double edge = std::sqrt(2.0 * shape.area / static_cast<double>(shape.triangles));
    const bool isVeryWide = width > veryWide * (hasUnits ? withUnits : 1.0);
    const bool isCoarse = !hasUnits && width > wide && edge > largeEdge;
    if (shape.triangles >= fewTriangles || shape.triangles < someTriangles ||
        (!isVeryWide && !isCoarse))
        return;
    const bool areMillimetres = width > millimetres * veryWide;
    diagnostics.warn("{}: {:.4g} m across with triangles of {:.3g} m; if the file is in {}, try "
                     "--units {}",
                     place, width, edge, areMillimetres ? "millimetres" : "centimetres",
                     areMillimetres ? "mm" : "cm");
}

} // namespace

void warnOfImplausible(const GroundMesh& ground, const ImportSettings& settings, bool hasUnits,
                       const std::string& place, Diagnostics& diagnostics)
{
    const Shape shape = shapeOf(ground);
    if (shape.area == 0.0)
        return;
    if (settings.upAxis == "y")
        warnOfUpAxis(shape, hasUnits, place, diagnostics);
    if (settings.units == "m" && settings.scale == 1.0)
        warnOfUnits(shape, hasUnits, place, diagnostics);
}

} // namespace sward::terrain
