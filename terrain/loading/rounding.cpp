#include "terrain/loading/rounding.h"

#include "terrain/reach.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace sward::terrain {
namespace {

constexpr double minSteps = 100.0; // of the longest edge of a triangle
constexpr double tolerated = 0.01; // share of a node's area in finer triangles

// Areas of a node, all and that of triangles too fine for their place.
struct NodeArea {
    double all = 0.0;
    double fine = 0.0;
    double distance = 0.0; // [m] from the origin, of the finest place
};

double largest(const glm::dvec3& v)
{
    return std::max({std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)});
}

} // namespace

void warnOfRounding(const Soup& soup, const std::string& place, Diagnostics& diagnostics)
{
    const std::size_t vertices = soup.positions.size();
    DAabb bounds;
    for (const glm::uvec3& t : soup.triangles)
        for (glm::length_t corner = 0; corner < 3; ++corner)
            if (t[corner] < vertices && isWithinReach(soup.positions[t[corner]]))
                bounds.add(soup.positions[t[corner]]);
    if (bounds.isEmpty())
        return;
    const glm::dvec3 origin = originFor(bounds);
    std::vector<NodeArea> nodes(std::max<std::size_t>(soup.nodes.size(), 1));
    for (std::size_t i = 0; i < soup.triangles.size(); ++i) {
        const glm::uvec3& t = soup.triangles[i];
        if (t.x >= vertices || t.y >= vertices || t.z >= vertices)
            continue;
        const glm::dvec3 a = soup.positions[t.x];
        const glm::dvec3 u = soup.positions[t.y] - a;
        const glm::dvec3 v = soup.positions[t.z] - a;
        const double area = 0.5 * glm::length(glm::cross(u, v));
        const double step = largest(a - origin) * 0x1p-24;
        const std::size_t node = i < soup.nodeOf.size() ? soup.nodeOf[i] : 0;
        if (!std::isfinite(area) || node >= nodes.size())
            continue;
        nodes[node].all += area;
        if (std::max({largest(u), largest(v), largest(u - v)}) < minSteps * step) {
            nodes[node].fine += area;
            nodes[node].distance = std::max(nodes[node].distance, largest(a - origin));
        }
    }
    std::size_t count = 0;
    std::size_t first = 0;
    for (std::size_t i = nodes.size(); i-- > 0;)
        if (nodes[i].fine > tolerated * nodes[i].all) {
            ++count;
            first = i;
        }
    if (count > 0)
        diagnostics.warn(
            "{}: {} nodes lose their shape by rounding, \"{}\" first: it lies {:.4g} m from the "
            "middle of the ground, where single precision resolves {:.2g} m; move the parts nearer "
            "to one another or bake them apart",
            place, count, first < soup.nodes.size() ? soup.nodes[first] : "ground",
            nodes[first].distance, nodes[first].distance * 0x1p-24);
}

} // namespace sward::terrain
