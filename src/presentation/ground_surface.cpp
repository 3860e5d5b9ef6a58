#include "presentation/ground_surface.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace sward::presentation {
namespace {

constexpr std::uint32_t trianglesPerRun = 32;

/// Runs or boxes in a box of the next level.
constexpr std::size_t boxesPerBox = 8;

// Möller & Trumbore 1997, both sides; distance in lengths of the direction.
std::optional<double> meetsTriangle(const glm::dvec3& eye, const glm::dvec3& direction,
                                    const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c)
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
    sortRuns();

    // Levels of boxes, until one level has few.
    std::vector<Aabb> below;
    for (const Run& run : runs_)
        below.push_back(run.box);
    while (below.size() > boxesPerBox) {
        std::vector<Aabb> above((below.size() + boxesPerBox - 1) / boxesPerBox);
        for (std::size_t i = 0; i < below.size(); ++i)
            above[i / boxesPerBox].add(below[i]);
        boxes_.push_back(above);
        below = std::move(above);
    }
}

void GroundSurface::sortRuns()
{
    Aabb all;
    for (const Run& run : runs_)
        all.add(run.box);
    const glm::vec3 scale = 1023.0f / glm::max(all.size(), glm::vec3(1e-20f));
    // Order along a Z-curve, so that consecutive runs are near each other in all directions.
    std::vector<std::pair<std::uint32_t, Run>> sorted;
    sorted.reserve(runs_.size());
    for (const Run& run : runs_) {
        const glm::uvec3 cell((run.box.centre() - all.low) * scale);
        std::uint32_t place = 0;
        for (std::uint32_t bit = 10; bit-- > 0;)
            place = (place << 3u) | (((cell.x >> bit) & 1u) << 2u) |
                    (((cell.y >> bit) & 1u) << 1u) | ((cell.z >> bit) & 1u);
        sorted.emplace_back(place, run);
    }
    std::stable_sort(sorted.begin(), sorted.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    for (std::size_t i = 0; i < runs_.size(); ++i)
        runs_[i] = sorted[i].second;
}

struct GroundSurface::Search {
    glm::dvec3 eye; ///< relative to the field's origin
    glm::dvec3 direction;
    glm::dvec3 inverse;
    double nearest = std::numeric_limits<double>::infinity();
    glm::dvec3 normal{0.0}; ///< at the nearest hit, of any length
};

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

void GroundSurface::searchRun(const Run& run, Search& search) const
{
    const auto corner = [&](std::uint32_t i) {
        return glm::dvec3(ground_->vertices[ground_->indices[run.firstIndex + i]].position);
    };
    for (std::uint32_t i = 0; i + 2 < run.indexCount; i += 3) {
        const glm::dvec3 a = corner(i);
        const glm::dvec3 b = corner(i + 1);
        const glm::dvec3 c = corner(i + 2);
        const auto met = meetsTriangle(search.eye, search.direction, a, b, c);
        if (met && *met < search.nearest) {
            search.nearest = *met;
            search.normal = glm::cross(b - a, c - a);
        }
    }
}

void GroundSurface::searchBox(std::size_t level, std::size_t box, Search& search) const
{
    const std::size_t first = box * boxesPerBox;
    const std::size_t count = level == 0 ? runs_.size() : boxes_[level - 1].size();
    // Nearest first: most of the others are then behind the hit.
    std::array<std::pair<double, std::size_t>, boxesPerBox> found{};
    std::size_t foundCount = 0;
    for (std::size_t i = first; i < std::min(first + boxesPerBox, count); ++i) {
        const Aabb& bounds = level == 0 ? runs_[i].box : boxes_[level - 1][i];
        const std::optional<double> entered = enters(bounds, search.eye, search.inverse);
        if (!entered)
            continue;
        std::size_t place = foundCount++;
        for (; place > 0 && found[place - 1].first > *entered; --place)
            found[place] = found[place - 1];
        found[place] = {*entered, i};
    }
    for (std::size_t k = 0; k < foundCount && found[k].first <= search.nearest; ++k) {
        if (level == 0)
            searchRun(runs_[found[k].second], search);
        else
            searchBox(level - 1, found[k].second, search);
    }
}

std::optional<GroundSurface::Hit> GroundSurface::hit(const glm::dvec3& eye,
                                                     const glm::dvec3& direction) const
{
    // A zero component has an infinite inverse; the comparisons in enters() still hold.
    Search search{eye - origin_, direction, 1.0 / direction};
    // The box above all.
    searchBox(boxes_.size(), 0, search);
    if (std::isinf(search.nearest))
        return std::nullopt;
    return Hit{search.nearest, eye + search.nearest * direction, glm::normalize(search.normal)};
}

} // namespace sward::presentation
