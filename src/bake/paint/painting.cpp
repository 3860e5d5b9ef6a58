#include "bake/paint/painting.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace sward::bake {
namespace {

// A surface is painted if its normal is within 72° of the stroke's.
constexpr double boundCosine = 0.3;

// Segments whose boxes are joined to one, to find the triangles where candidates may be missing.
constexpr std::uint32_t segmentsPerBox = 8;

double towards(double from, double to, double share)
{
    return share >= 1.0 ? to : from + share * (to - from);
}

// 1 up to `hardness`, falling smoothly to 0 at 1.
double falloff(double distance, double hardness)
{
    if (distance <= hardness)
        return 1.0;
    const double x = 1.0 - (distance - hardness) / (1.0 - hardness);
    return x <= 0.0 ? 0.0 : x * x * (3.0 - 2.0 * x);
}

glm::dvec3 normalized(const glm::dvec3& v)
{
    const double squared = glm::dot(v, v);
    return squared > 0.0 ? v / std::sqrt(squared) : v;
}

bool raises(const Stroke& stroke)
{
    return (stroke.kind == StrokeKind::add || stroke.kind == StrokeKind::set) && stroke.value > 1.0;
}

// Millimetres from the origin, exactly.
glm::dvec3 relativeTo(const glm::dvec3& origin, const std::array<std::int64_t, 3>& point)
{
    glm::dvec3 result;
    for (glm::length_t axis = 0; axis < 3; ++axis)
        result[axis] =
            double(point[std::size_t(axis)] - std::llround(origin[axis] * 1000.0)) / 1000.0;
    return result;
}

glm::vec3 normalOf(const Stroke& stroke, std::size_t point)
{
    if (stroke.normals.empty())
        return glm::vec3(0.0f);
    const auto& n = stroke.normals[stroke.normals.size() == 1 ? 0 : point];
    return glm::vec3(normalized(glm::dvec3(double(n[0]), double(n[1]), double(n[2]))));
}

std::vector<StrokeSegment> segmentsNear(const Strokes& strokes, const glm::dvec3& origin,
                                        const Aabb& ground)
{
    std::vector<StrokeSegment> segments;
    const DAabb wide{glm::dvec3(ground.low), glm::dvec3(ground.high)};
    for (std::uint32_t s = 0; s < strokes.list.size(); ++s) {
        const Stroke& stroke = strokes.list[s];
        if (stroke.points.empty())
            continue;
        const std::size_t count = std::max<std::size_t>(stroke.points.size() - 1, 1);
        for (std::size_t i = 0; i < count; ++i) {
            const std::size_t next = std::min(i + 1, stroke.points.size() - 1);
            StrokeSegment segment;
            segment.from = relativeTo(origin, stroke.points[i]);
            segment.along = relativeTo(origin, stroke.points[next]) - segment.from;
            segment.fromNormal = normalOf(stroke, i);
            segment.toNormal = normalOf(stroke, next);
            segment.hasNormals = !stroke.normals.empty();
            segment.radius = stroke.radius;
            segment.stroke = s;
            const DAabb box = segment.box();
            bool isNear = true;
            for (glm::length_t axis = 0; axis < 3; ++axis)
                isNear = isNear && box.low[axis] <= wide.high[axis] &&
                         wide.low[axis] <= box.high[axis];
            if (isNear)
                segments.push_back(segment);
        }
    }
    return segments;
}

std::vector<DAabb> raisingBoxes(const Strokes& strokes, const std::vector<StrokeSegment>& segments)
{
    std::vector<DAabb> boxes;
    std::uint32_t inBox = 0;
    std::uint32_t last = 0;
    for (const StrokeSegment& segment : segments) {
        if (!raises(strokes.list[segment.stroke]))
            continue;
        if (boxes.empty() || inBox == segmentsPerBox || segment.stroke != last) {
            boxes.emplace_back();
            inBox = 0;
        }
        boxes.back().add(segment.box());
        last = segment.stroke;
        ++inBox;
    }
    return boxes;
}

// A unit vector across `normal`.
glm::dvec3 across(const glm::dvec3& normal)
{
    const glm::dvec3 axis = std::fabs(normal.x) < 0.7 ? glm::dvec3(1.0, 0.0, 0.0)
                                                      : glm::dvec3(0.0, 0.0, 1.0);
    return normalized(glm::cross(normal, axis));
}

// The density after a stroke that does not smooth.
double densityAfter(const Stroke& stroke, double share, double density, double base)
{
    switch (stroke.kind) {
    case StrokeKind::add:
        return density < stroke.value ? towards(density, stroke.value, share) : density;
    case StrokeKind::erase:
        return towards(density, 0.0, share);
    case StrokeKind::set:
        return towards(density, stroke.value, share);
    case StrokeKind::clear:
        return towards(density, base, share);
    default:
        return density;
    }
}

} // namespace

Painting::Painting(const Strokes& strokes, const glm::dvec3& origin, const Aabb& ground)
    : strokes_(strokes)
    , grid_(segmentsNear(strokes, origin, ground))
    , raising_(raisingBoxes(strokes, grid_.segments()))
{
    for (const StrokeSegment& segment : grid_.segments())
        if (const Stroke& stroke = strokes.list[segment.stroke]; raises(stroke))
            highest_ = std::max(highest_, stroke.value);
}

bool Painting::mayRaise(const Aabb& box) const
{
    return raising_.meets({glm::dvec3(box.low), glm::dvec3(box.high)});
}

// Share [0, 1] of a capsule's strength at a point; 0 for other surfaces than its own.
double Painting::reachOf(const StrokeSegment& segment, const glm::dvec3& place,
                         const glm::dvec3& normal) const
{
    const double along = segment.shareAt(place);
    const glm::dvec3 offset = place - segment.from - along * segment.along;
    const double squared = glm::dot(offset, offset);
    if (squared >= segment.radius * segment.radius)
        return 0.0;
    const Stroke& stroke = strokes_.list[segment.stroke];
    if (segment.hasNormals) {
        const glm::dvec3 own = normalized(
            glm::mix(glm::dvec3(segment.fromNormal), glm::dvec3(segment.toNormal), along));
        if (glm::dot(own, normal) <= boundCosine)
            return 0.0;
        if (stroke.depth > 0.0 && std::fabs(glm::dot(own, offset)) > stroke.depth)
            return 0.0;
    }
    return falloff(std::sqrt(squared) / segment.radius, stroke.hardness);
}

// The strokes that reach a point, in their order, each with its greatest share.
void Painting::findHits(const glm::dvec3& place, const glm::dvec3& normal,
                        std::vector<Hit>& hits) const
{
    hits.clear();
    grid_.visitNear(place, [&](std::uint32_t index) {
        const StrokeSegment& segment = grid_.segments()[index];
        const double share = reachOf(segment, place, normal);
        if (share <= 0.0)
            return;
        // Strokes of one width come in order; few strokes have segments of several.
        auto at = hits.end();
        while (at != hits.begin() && std::prev(at)->stroke > segment.stroke)
            --at;
        if (at == hits.begin() || std::prev(at)->stroke != segment.stroke) {
            hits.insert(at, {segment.stroke, index, share});
            return;
        }
        Hit& known = *std::prev(at);
        if (share > known.share || (share == known.share && index < known.segment))
            known = {segment.stroke, index, share};
    });
}

double Painting::densityBefore(const glm::dvec3& place, const glm::dvec3& normal, double base,
                               std::uint32_t before, std::vector<Hit>& hits) const
{
    findHits(place, normal, hits);
    double density = base;
    for (const Hit& hit : hits) {
        if (hit.stroke >= before)
            break;
        const Stroke& stroke = strokes_.list[hit.stroke];
        density = densityAfter(stroke, stroke.strength * hit.share, density, base);
    }
    return density;
}

// The mean density around a point before a stroke. Strokes that smooth do not count.
double Painting::smoothed(const glm::dvec3& place, const glm::dvec3& normal, double base,
                          std::uint32_t before) const
{
    constexpr double diagonal = 0.70710678118654752;
    constexpr double turns[8][2] = {{1.0, 0.0},  {diagonal, diagonal},   {0.0, 1.0},
                                    {-diagonal, diagonal}, {-1.0, 0.0}, {-diagonal, -diagonal},
                                    {0.0, -1.0}, {diagonal, -diagonal}};
    thread_local std::vector<Hit> hits;
    const glm::dvec3 first = across(normal);
    const glm::dvec3 second = glm::cross(normal, first);
    const double radius = strokes_.list[before].radius;
    double sum = densityBefore(place, normal, base, before, hits);
    for (int i = 0; i < 8; ++i) {
        const double width = radius * (i % 2 == 0 ? 2.0 / 3.0 : 1.0 / 3.0);
        const glm::dvec3 aside = width * (turns[i][0] * first + turns[i][1] * second);
        sum += densityBefore(place + aside, normal, base, before, hits);
    }
    return sum / 9.0;
}

Painted Painting::at(const glm::vec3& point, const glm::vec3& up, double base) const
{
    thread_local std::vector<Hit> hits;
    const glm::dvec3 place(point);
    const glm::dvec3 normal(up);
    Painted painted;
    painted.density = base;
    findHits(place, normal, hits);
    for (const Hit& hit : hits) {
        const Stroke& stroke = strokes_.list[hit.stroke];
        const double share = stroke.strength * hit.share;
        const auto fade = [&](double kept) {
            painted.keepsSpecies = kept;
            for (double& species : painted.species)
                species = towards(species, 0.0, share);
        };
        switch (stroke.kind) {
        case StrokeKind::smooth:
            painted.density = towards(painted.density,
                                      smoothed(place, normal, base, hit.stroke), share);
            break;
        case StrokeKind::species:
            fade(towards(painted.keepsSpecies, 0.0, share));
            painted.species[stroke.slot] += share;
            break;
        case StrokeKind::height:
            painted.look.height = towards(painted.look.height, stroke.value, share);
            break;
        case StrokeKind::dryness:
            painted.look.dryness = towards(painted.look.dryness, stroke.value, share);
            break;
        case StrokeKind::trodden:
            painted.look.height = towards(painted.look.height, stroke.value, share);
            painted.look.lean +=
                share * (stroke.lean * normalized(grid_.segments()[hit.segment].along) -
                         painted.look.lean);
            break;
        case StrokeKind::clear:
            fade(towards(painted.keepsSpecies, 1.0, share));
            painted.density = towards(painted.density, base, share);
            painted.look.height = towards(painted.look.height, 1.0, share);
            painted.look.dryness = towards(painted.look.dryness, 0.0, share);
            painted.look.lean -= share * painted.look.lean;
            break;
        case StrokeKind::add:
        case StrokeKind::erase:
        case StrokeKind::set:
            painted.density = densityAfter(stroke, share, painted.density, base);
            break;
        }
    }
    return painted;
}

} // namespace sward::bake
