#include "terrain/mesh_files/polygon.h"

#include "core/bounds.h"

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace sward::terrain {
namespace {

// Areas below this share of the polygon's bounding square are rounding of flat corners.
constexpr double flatShare = 1e-12;

// A normal shorter than this share of the square is the rest of halves that cancel.
constexpr double balancedShare = 1e-9;

// Twice the signed area; positive if a, b, c turn anti-clockwise.
double turnOf(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c)
{
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// Twice the polygon's area vector by Newell's formula, relative to the first corner.
glm::dvec3 newellNormal(std::span<const glm::dvec3> corners)
{
    glm::dvec3 normal(0.0);
    for (std::size_t i = 1; i + 1 < corners.size(); ++i)
        normal += glm::cross(corners[i] - corners[0], corners[i + 1] - corners[0]);
    return normal;
}

// The axis to leave out: the normal's longest, or the thinnest of the polygon if its halves cancel.
glm::length_t axisOf(std::span<const glm::dvec3> corners, const glm::dvec3& normal)
{
    DAabb box;
    for (const glm::dvec3& corner : corners)
        box.add(corner);
    const glm::dvec3 extent = box.size();
    const double reach = std::max({extent.x, extent.y, extent.z});
    glm::dvec3 size(std::fabs(normal.x), std::fabs(normal.y), std::fabs(normal.z));
    if (std::max({size.x, size.y, size.z}) <= balancedShare * reach * reach)
        size = -extent;
    return size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
}

// The corners in the plane that loses least, turning anti-clockwise.
std::vector<glm::dvec2> project(std::span<const glm::dvec3> corners, const glm::dvec3& normal)
{
    const glm::length_t axis = axisOf(corners, normal);
    const glm::length_t u = (axis + 1) % 3;
    const glm::length_t v = (axis + 2) % 3;
    std::vector<glm::dvec2> plane;
    plane.reserve(corners.size());
    for (const glm::dvec3& corner : corners) {
        const glm::dvec3 own = corner - corners[0];
        plane.push_back(normal[axis] >= 0.0 ? glm::dvec2(own[u], own[v])
                                            : glm::dvec2(own[v], own[u]));
    }
    return plane;
}

std::vector<PolygonTriangle> fanOf(std::size_t corners)
{
    std::vector<PolygonTriangle> triangles;
    for (std::uint32_t i = 1; i + 1 < corners; ++i)
        triangles.push_back({0, i, i + 1});
    return triangles;
}

// Whether a fan around corner 0 covers the polygon once: no triangle is turned over, and the whole
// turns less than once around the corner.
bool isFan(const std::vector<glm::dvec2>& plane, double flat)
{
    bool isBeyondHalf = false;
    for (std::size_t i = 1; i + 1 < plane.size(); ++i) {
        const double area = turnOf(plane[0], plane[i], plane[i + 1]);
        const double along = glm::dot(plane[i] - plane[0], plane[i + 1] - plane[0]);
        if (area < -flat || (area <= flat && along < 0.0))
            return false;
        const double turned = turnOf(plane[0], plane[1], plane[i + 1]);
        if (isBeyondHalf && turned > flat)
            return false;
        isBeyondHalf = isBeyondHalf || turned < -flat;
    }
    return true;
}

// Whether the open segments ab and cd cross in one inner point.
bool doCross(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c, const glm::dvec2& d,
             double flat)
{
    const double abc = turnOf(a, b, c);
    const double abd = turnOf(a, b, d);
    const double cda = turnOf(c, d, a);
    const double cdb = turnOf(c, d, b);
    const auto differ = [flat](double p, double q) {
        return (p > flat && q < -flat) || (p < -flat && q > flat);
    };
    return differ(abc, abd) && differ(cda, cdb);
}

bool hasCrossing(const std::vector<glm::dvec2>& plane, double flat)
{
    const std::size_t n = plane.size();
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = i + 2; j < n; ++j)
            if (doCross(plane[i], plane[(i + 1) % n], plane[j], plane[(j + 1) % n], flat))
                return true;
    return false;
}

// Clips ears of a polygon that turns anti-clockwise.
class EarClipper {
public:
    EarClipper(const std::vector<glm::dvec2>& plane, double flat)
        : plane_(plane)
        , flat_(flat)
        , left_(plane.size())
    {
        std::iota(left_.begin(), left_.end(), 0U);
    }

    // Whether ears were found to the end; else the rest is a fan.
    bool run(std::vector<PolygonTriangle>& triangles)
    {
        std::size_t at = 0;
        std::size_t failures = 0;
        bool mayBeFlat = false;
        while (left_.size() > 3) {
            if (failures == left_.size()) {
                // No true ear is left: clip flat corners, which cover nothing.
                if (mayBeFlat)
                    break;
                mayBeFlat = true;
                failures = 0;
            }
            const std::size_t n = left_.size();
            at %= n;
            if (!isEar(at, mayBeFlat)) {
                ++failures;
                ++at;
                continue;
            }
            triangles.push_back({left_[(at + n - 1) % n], left_[at], left_[(at + 1) % n]});
            left_.erase(left_.begin() + static_cast<std::ptrdiff_t>(at));
            failures = 0;
            mayBeFlat = false;
        }
        const bool isDone = left_.size() == 3;
        for (std::size_t i = 1; i + 1 < left_.size(); ++i)
            triangles.push_back({left_[0], left_[i], left_[i + 1]});
        return isDone;
    }

private:
    bool isEar(std::size_t at, bool mayBeFlat) const
    {
        const std::size_t n = left_.size();
        const glm::dvec2& a = plane_[left_[(at + n - 1) % n]];
        const glm::dvec2& b = plane_[left_[at]];
        const glm::dvec2& c = plane_[left_[(at + 1) % n]];
        const double area = turnOf(a, b, c);
        if (mayBeFlat)
            return std::fabs(area) <= flat_;
        if (area <= flat_)
            return false;
        // No other corner may lie inside or on the diagonal.
        for (const std::uint32_t other : left_) {
            const glm::dvec2& p = plane_[other];
            if (p == a || p == b || p == c)
                continue;
            if (turnOf(a, b, p) >= -flat_ && turnOf(b, c, p) >= -flat_ && turnOf(c, a, p) >= -flat_)
                return false;
        }
        return !isCutByOwnEdge(at, a, c);
    }

    // Where a corner is passed twice, an edge at its other passage may cut the diagonal.
    bool isCutByOwnEdge(std::size_t at, const glm::dvec2& a, const glm::dvec2& c) const
    {
        const std::size_t n = left_.size();
        for (std::size_t i = 0; i < n; ++i) {
            if (i == at || (i + 1) % n == at)
                continue;
            if (doCross(a, c, plane_[left_[i]], plane_[left_[(i + 1) % n]], flat_))
                return true;
        }
        return false;
    }

    const std::vector<glm::dvec2>& plane_;
    double flat_;
    std::vector<std::uint32_t> left_;
};

} // namespace

std::vector<PolygonTriangle> triangulate(std::span<const glm::dvec3> corners, bool& crosses)
{
    crosses = false;
    if (corners.size() <= 3)
        return fanOf(corners.size());
    const glm::dvec3 normal = newellNormal(corners);
    const std::vector<glm::dvec2> plane = project(corners, normal);
    double reach = 0.0;
    for (const glm::dvec2& point : plane)
        reach = std::max({reach, std::fabs(point.x), std::fabs(point.y)});
    const double flat = flatShare * reach * reach;
    if (!std::isfinite(flat) || isFan(plane, flat))
        return fanOf(corners.size());
    if (corners.size() > earLimit) {
        crosses = true;
        return fanOf(corners.size());
    }
    crosses = hasCrossing(plane, flat);
    std::vector<PolygonTriangle> triangles;
    if (!EarClipper(plane, flat).run(triangles))
        crosses = true;
    return triangles;
}

} // namespace sward::terrain
