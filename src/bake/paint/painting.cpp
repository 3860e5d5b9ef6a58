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

// What a stroke changes.
enum class Change { density, species, look };

bool changes(StrokeKind kind, Change change)
{
    switch (kind) {
    case StrokeKind::add:
    case StrokeKind::erase:
    case StrokeKind::set:
    case StrokeKind::smooth:
        return change == Change::density;
    case StrokeKind::species:
        return change == Change::species;
    case StrokeKind::height:
    case StrokeKind::dryness:
    case StrokeKind::trodden:
        return change == Change::look;
    case StrokeKind::clear:
        break;
    }
    return true;
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

std::vector<StrokeSegment> segmentsNear(const Strokes& strokes, Change change,
                                        const glm::dvec3& origin, const Aabb& ground)
{
    std::vector<StrokeSegment> segments;
    // A stroke that smooths looks at places beside the ground, too.
    double beside = 0.0;
    for (const Stroke& stroke : strokes.list)
        if (stroke.kind == StrokeKind::smooth)
            beside = std::max(beside, stroke.radius);
    const DAabb wide{glm::dvec3(ground.low) - beside, glm::dvec3(ground.high) + beside};
    for (std::uint32_t s = 0; s < strokes.list.size(); ++s) {
        const Stroke& stroke = strokes.list[s];
        if (stroke.points.empty() || !changes(stroke.kind, change))
            continue;
        const std::size_t count = std::max<std::size_t>(stroke.points.size() - 1, 1);
        for (std::size_t i = 0; i < count; ++i) {
            const std::size_t next = std::min(i + 1, stroke.points.size() - 1);
            StrokeSegment segment;
            segment.from = relativeTo(origin, stroke.points[i]);
            segment.along = relativeTo(origin, stroke.points[next]) - segment.from;
            const double squared = glm::dot(segment.along, segment.along);
            segment.perSquaredLength = squared > 0.0 ? 1.0 / squared : 0.0;
            segment.fromNormal = normalOf(stroke, i);
            segment.toNormal = normalOf(stroke, next);
            segment.hasNormals = !stroke.normals.empty();
            segment.radius = stroke.radius;
            segment.stroke = s;
            const DAabb box = segment.box();
            bool isNear = true;
            for (glm::length_t axis = 0; axis < 3; ++axis)
                isNear =
                    isNear && box.low[axis] <= wide.high[axis] && wide.low[axis] <= box.high[axis];
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
    const glm::dvec3 axis =
        std::fabs(normal.x) < 0.7 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 0.0, 1.0);
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
    , density_(segmentsNear(strokes, Change::density, origin, ground))
    , species_(segmentsNear(strokes, Change::species, origin, ground))
    , look_(segmentsNear(strokes, Change::look, origin, ground))
    , raising_(raisingBoxes(strokes, density_.segments()))
{
    for (const StrokeSegment& segment : density_.segments())
        if (const Stroke& stroke = strokes.list[segment.stroke]; raises(stroke))
            highest_ = std::max(highest_, stroke.value);
}

bool Painting::mayRaise(const Aabb& box) const
{
    return raising_.meets({glm::dvec3(box.low), glm::dvec3(box.high)});
}

// Share [0, 1] of the way to a stroke's value.
double Painting::shareOf(const StrokeGrid& grid, const Hit& hit) const
{
    const Stroke& stroke = strokes_.list[hit.stroke];
    const double radius = grid.segments()[hit.segment].radius;
    return stroke.strength * falloff(std::sqrt(hit.squared) / radius, stroke.hardness);
}

// Whether a surface near a capsule is the one that it was painted on.
bool Painting::belongs(const StrokeSegment& segment, double along, const glm::dvec3& offset,
                       const glm::dvec3& normal) const
{
    if (!segment.hasNormals)
        return true;
    const glm::dvec3 own =
        glm::mix(glm::dvec3(segment.fromNormal), glm::dvec3(segment.toNormal), along);
    const double squared = glm::dot(own, own);
    const double cosine = glm::dot(own, normal);
    if (cosine <= 0.0 || cosine * cosine <= boundCosine * boundCosine * squared)
        return false;
    const double depth = strokes_.list[segment.stroke].depth;
    if (depth <= 0.0)
        return true;
    const double away = glm::dot(own, offset);
    return away * away <= depth * depth * squared;
}

// The strokes that reach a point, in their order.
void Painting::findHits(const StrokeGrid& grid, const glm::dvec3& place, const glm::dvec3& normal,
                        std::vector<Hit>& hits) const
{
    hits.clear();
    grid.visitNear(place, [&](std::uint32_t index) {
        const StrokeSegment& segment = grid.segments()[index];
        const double along = segment.shareAt(place);
        const glm::dvec3 offset = place - segment.from - along * segment.along;
        const double squared = glm::dot(offset, offset);
        if (squared >= segment.radius * segment.radius)
            return;
        // Strokes of one width come in order; few strokes have segments of several.
        auto after = hits.end();
        while (after != hits.begin() && std::prev(after)->stroke > segment.stroke)
            --after;
        const bool isKnown = after != hits.begin() && std::prev(after)->stroke == segment.stroke;
        if (isKnown) {
            const Hit& known = *std::prev(after);
            if (squared > known.squared || (squared == known.squared && index > known.segment))
                return;
        }
        if (!belongs(segment, along, offset, normal))
            return;
        const Hit hit{segment.stroke, index, squared};
        if (isKnown)
            *std::prev(after) = hit;
        else
            hits.insert(after, hit);
    });
}

// The mean density around a point before a stroke. Strokes that smooth do not count.
double Painting::smoothed(const glm::dvec3& place, const glm::dvec3& normal, double base,
                          std::uint32_t before) const
{
    // A spiral of the golden angle.
    constexpr int places = 24;
    constexpr double turnCos = -0.73736887807831963;
    constexpr double turnSin = 0.67549029426152362;
    thread_local std::vector<Hit> hits;
    const glm::dvec3 first = across(normal);
    const glm::dvec3 second = glm::cross(normal, first);
    const double radius = strokes_.list[before].radius;
    double sum = 0.0;
    double cos = 1.0;
    double sin = 0.0;
    for (int i = 0; i < places; ++i) {
        const double width = radius * std::sqrt((double(i) + 0.5) / double(places));
        findHits(density_, place + width * (cos * first + sin * second), normal, hits);
        double density = base;
        for (const Hit& hit : hits)
            if (hit.stroke < before)
                density =
                    densityAfter(strokes_.list[hit.stroke], shareOf(density_, hit), density, base);
        sum += density;
        const double next = cos * turnCos - sin * turnSin;
        sin = sin * turnCos + cos * turnSin;
        cos = next;
    }
    return sum / double(places);
}

double Painting::densityAt(const glm::vec3& point, const glm::vec3& up, double base) const
{
    thread_local std::vector<Hit> hits;
    const glm::dvec3 place(point);
    const glm::dvec3 normal(up);
    findHits(density_, place, normal, hits);
    double density = base;
    for (const Hit& hit : hits) {
        const Stroke& stroke = strokes_.list[hit.stroke];
        const double share = shareOf(density_, hit);
        density = stroke.kind == StrokeKind::smooth
                      ? towards(density, smoothed(place, normal, base, hit.stroke), share)
                      : densityAfter(stroke, share, density, base);
    }
    return density;
}

PaintedSpecies Painting::speciesAt(const glm::vec3& place, const glm::vec3& normal) const
{
    thread_local std::vector<Hit> hits;
    PaintedSpecies painted;
    findHits(species_, glm::dvec3(place), glm::dvec3(normal), hits);
    for (const Hit& hit : hits) {
        const Stroke& stroke = strokes_.list[hit.stroke];
        const double share = shareOf(species_, hit);
        const bool isSpecies = stroke.kind == StrokeKind::species;
        painted.kept = towards(painted.kept, isSpecies ? 0.0 : 1.0, share);
        for (std::size_t slot = 0; slot < painted.share.size(); ++slot)
            painted.share[slot] =
                towards(painted.share[slot], isSpecies && slot == stroke.slot ? 1.0 : 0.0, share);
    }
    return painted;
}

PaintedLook Painting::lookAt(const glm::vec3& place, const glm::vec3& normal) const
{
    thread_local std::vector<Hit> hits;
    PaintedLook look;
    findHits(look_, glm::dvec3(place), glm::dvec3(normal), hits);
    for (const Hit& hit : hits) {
        const Stroke& stroke = strokes_.list[hit.stroke];
        const double share = shareOf(look_, hit);
        const auto leanTowards = [&](const glm::dvec3& lean) {
            look.lean = share >= 1.0 ? lean : look.lean + share * (lean - look.lean);
        };
        switch (stroke.kind) {
        case StrokeKind::height:
            look.height = towards(look.height, stroke.value, share);
            break;
        case StrokeKind::dryness:
            look.dryness = towards(look.dryness, stroke.value, share);
            break;
        case StrokeKind::trodden:
            look.height = towards(look.height, stroke.value, share);
            leanTowards(stroke.lean * normalized(look_.segments()[hit.segment].along));
            break;
        default: // clear
            look.height = towards(look.height, 1.0, share);
            look.dryness = towards(look.dryness, 0.0, share);
            leanTowards(glm::dvec3(0.0));
            break;
        }
    }
    return look;
}

} // namespace sward::bake
