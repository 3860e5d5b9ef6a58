#include "bake/session/stroke_reach.h"

#include "bake/paint/stroke_grid.h"
#include "bake/patches/local_ranks.h"
#include "bake/sample/progressive_order.h"
#include "bake/session/cells_between.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <vector>

namespace sward::bake {
namespace {

// For what is rounded on the way from a stroke to a root [m].
constexpr double slackOfStrokes = 0.01;

// Whether a stroke changes which roots grow, and with them the order of their neighbours.
bool changesRoots(StrokeKind kind)
{
    switch (kind) {
    case StrokeKind::add:
    case StrokeKind::erase:
    case StrokeKind::set:
    case StrokeKind::smooth:
    case StrokeKind::clear:
        return true;
    case StrokeKind::species:
    case StrokeKind::height:
    case StrokeKind::dryness:
    case StrokeKind::trodden:
        break;
    }
    return false;
}

// The capsules of a stroke, in the world.
std::vector<StrokeSegment> capsulesOf(const Stroke& stroke)
{
    const auto at = [&](std::size_t i) {
        return glm::dvec3(double(stroke.points[i][0]), double(stroke.points[i][1]),
                          double(stroke.points[i][2])) /
               1000.0;
    };
    std::vector<StrokeSegment> capsules;
    for (std::size_t i = 0; i < stroke.points.size(); ++i) {
        if (i > 0 && i + 1 == stroke.points.size())
            break;
        StrokeSegment capsule;
        capsule.from = at(i);
        capsule.along = at(std::min(i + 1, stroke.points.size() - 1)) - capsule.from;
        const double squared = glm::dot(capsule.along, capsule.along);
        capsule.perSquaredLength = squared > 0.0 ? 1.0 / squared : 0.0;
        capsule.radius = stroke.radius;
        capsules.push_back(capsule);
    }
    return capsules;
}

bool mayTouch(const Stroke& a, const Stroke& b, double margin)
{
    const auto boxOf = [](const Stroke& stroke) {
        DAabb box;
        for (const StrokeSegment& capsule : capsulesOf(stroke))
            box.add(capsule.box());
        return box;
    };
    const DAabb first = boxOf(a);
    const DAabb second = boxOf(b);
    for (glm::length_t axis = 0; axis < 3; ++axis)
        if (first.low[axis] - margin > second.high[axis] ||
            second.low[axis] - margin > first.high[axis])
            return false;
    return true;
}

// The bearing cells that are within `margin` of a stroke's capsules, and a few more.
void addCellsWithin(const Stroke& stroke, double margin, const std::set<CellNumber>& bearing,
                    std::set<CellNumber>& cells)
{
    constexpr double halfDiagonal = 0.8661 * widestPatch;
    for (const StrokeSegment& capsule : capsulesOf(stroke)) {
        const double reach = capsule.radius + margin;
        DAabb box;
        for (const glm::dvec3& end : {capsule.from, capsule.from + capsule.along}) {
            box.add(end - reach);
            box.add(end + reach);
        }
        forCellsBetween(bearing, box, [&](const CellNumber& cell) {
            const glm::dvec3 corner{double(cell[0]), double(cell[1]), double(cell[2])};
            const glm::dvec3 middle = (corner + 0.5) * widestPatch;
            const glm::dvec3 offset =
                middle - capsule.from - capsule.shareAt(middle) * capsule.along;
            const double near = reach + halfDiagonal;
            if (glm::dot(offset, offset) <= near * near)
                cells.insert(cell);
        });
    }
}

// How far around a stroke those look that come after it [m].
double lookedAround(const Stroke& stroke, std::span<const Stroke> later)
{
    double around = 0.0;
    for (const Stroke& other : later)
        if (other.kind == StrokeKind::smooth && mayTouch(stroke, other, other.radius))
            around = std::max(around, other.radius);
    return around;
}

} // namespace

std::vector<StrokeSegment> capsulesReached(const Stroke& stroke, std::span<const Stroke> later)
{
    std::vector<StrokeSegment> capsules = capsulesOf(stroke);
    if (changesRoots(stroke.kind))
        for (StrokeSegment& capsule : capsules)
            capsule.radius += lookedAround(stroke, later);
    return capsules;
}

void addCellsReached(const Stroke& stroke, std::span<const Stroke> later, double tufts,
                     const std::set<CellNumber>& bearing, std::set<CellNumber>& reached)
{
    double margin = slackOfStrokes;
    if (changesRoots(stroke.kind)) {
        // Tufts look at their middles, and strokes that smooth at what is around a root.
        margin += std::max(3.0 * tufts, lookedAround(stroke, later)) + progressiveReach +
                  LocalRanks::reach;
    }
    addCellsWithin(stroke, margin, bearing, reached);
}

void addCellsTouched(const Stroke& stroke, const std::set<CellNumber>& bearing,
                     std::set<CellNumber>& touched)
{
    addCellsWithin(stroke, slackOfStrokes, bearing, touched);
}

} // namespace sward::bake
