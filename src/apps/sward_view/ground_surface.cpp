#include "apps/sward_view/ground_surface.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace sward::view {
namespace {

constexpr std::uint32_t trianglesPerRun = 64;

// Möller & Trumbore 1997, both sides; distance in lengths of the direction.
std::optional<double> meets(const glm::dvec3& eye, const glm::dvec3& direction, const glm::dvec3& a,
                            const glm::dvec3& b, const glm::dvec3& c)
{
    const glm::dvec3 ab = b - a;
    const glm::dvec3 ac = c - a;
    const glm::dvec3 p = glm::cross(direction, ac);
    const double determinant = glm::dot(ab, p);
    if (std::abs(determinant) < std::numeric_limits<double>::min())
        return std::nullopt;
    const glm::dvec3 t = eye - a;
    const double u = glm::dot(t, p) / determinant;
    if (u < 0.0 || u > 1.0)
        return std::nullopt;
    const glm::dvec3 q = glm::cross(t, ab);
    const double v = glm::dot(direction, q) / determinant;
    if (v < 0.0 || u + v > 1.0)
        return std::nullopt;
    const double distance = glm::dot(ac, q) / determinant;
    return distance > 0.0 ? std::optional(distance) : std::nullopt;
}

} // namespace

GroundSurface::GroundSurface(const field::FieldView& field)
    : ground_(field.ground)
    , origin_(field.origin)
{
    for (const field::GroundRange& range : ground_->ranges) {
        if (range.level != 0)
            continue;
        for (std::uint32_t done = 0; done < range.indexCount; done += 3 * trianglesPerRun) {
            Run run;
            run.firstIndex = range.firstIndex + done;
            run.indexCount = std::min(3 * trianglesPerRun, range.indexCount - done);
            for (std::uint32_t i = 0; i < run.indexCount; ++i)
                run.box.add(ground_->vertices[ground_->indices[run.firstIndex + i]].position);
            runs_.push_back(run);
        }
    }
}

std::optional<double> enters(const Aabb& box, const glm::dvec3& eye, const glm::dvec3& inverse)
{
    const glm::dvec3 low = (glm::dvec3(box.low) - eye) * inverse;
    const glm::dvec3 high = (glm::dvec3(box.high) - eye) * inverse;
    const glm::dvec3 in = glm::min(low, high);
    const glm::dvec3 out = glm::max(low, high);
    const double first = std::max({in.x, in.y, in.z, 0.0});
    const double last = std::min({out.x, out.y, out.z});
    return first <= last ? std::optional(first) : std::nullopt;
}

std::optional<GroundSurface::Hit> GroundSurface::hit(const glm::dvec3& eye,
                                                     const glm::dvec3& direction) const
{
    const glm::dvec3 from = eye - origin_;
    // A zero component has an infinite inverse; the comparisons in enters() still hold.
    const glm::dvec3 inverse = 1.0 / direction;
    double nearest = std::numeric_limits<double>::infinity();
    for (const Run& run : runs_) {
        const std::optional<double> entered = enters(run.box, from, inverse);
        if (!entered || *entered > nearest)
            continue;
        const auto corner = [&](std::uint32_t i) {
            return glm::dvec3(ground_->vertices[ground_->indices[run.firstIndex + i]].position);
        };
        for (std::uint32_t i = 0; i + 2 < run.indexCount; i += 3)
            if (const auto met = meets(from, direction, corner(i), corner(i + 1), corner(i + 2)))
                nearest = std::min(nearest, *met);
    }
    if (std::isinf(nearest))
        return std::nullopt;
    return Hit{nearest, eye + nearest * direction};
}

} // namespace sward::view
