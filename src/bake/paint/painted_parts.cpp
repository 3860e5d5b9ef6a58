#include "bake/paint/painted_parts.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <tuple>

namespace sward::bake {
namespace {

// The segments that a painting knows, each once.
std::vector<StrokeSegment> segmentsOf(const Painting& painting)
{
    std::vector<StrokeSegment> all;
    for (const StrokeGrid* const grid :
         {&painting.density(), &painting.species(), &painting.look()})
        all.insert(all.end(), grid->segments().begin(), grid->segments().end());
    const auto key = [](const StrokeSegment& one) {
        return std::tie(one.stroke, one.from.x, one.from.y, one.from.z, one.along.x, one.along.y,
                        one.along.z);
    };
    std::sort(all.begin(), all.end(),
              [&](const StrokeSegment& a, const StrokeSegment& b) { return key(a) < key(b); });
    all.erase(std::unique(
                  all.begin(), all.end(),
                  [&](const StrokeSegment& a, const StrokeSegment& b) { return key(a) == key(b); }),
              all.end());
    return all;
}

BoxTree boxesOf(const std::vector<StrokeSegment>& segments)
{
    std::vector<DAabb> boxes;
    boxes.reserve(segments.size());
    for (const StrokeSegment& segment : segments)
        boxes.push_back(segment.box());
    return BoxTree(std::move(boxes));
}

void add(const Stroke& stroke, PaintedPart& part)
{
    switch (stroke.kind) {
    case StrokeKind::add:
    case StrokeKind::set:
    case StrokeKind::smooth:
        // Where they raise the density, blades grow as on full ground.
        part.density = true;
        part.look = true;
        if (stroke.kind != StrokeKind::smooth)
            part.highest = std::max(part.highest, stroke.value);
        break;
    case StrokeKind::erase:
        part.density = true;
        return;
    case StrokeKind::clear:
        part.density = true;
        part.species = true;
        part.look = true;
        break;
    case StrokeKind::species:
        part.species = true;
        part.look = true;
        break;
    case StrokeKind::height:
        part.tallest = std::max(part.tallest, stroke.value);
        part.look = true;
        break;
    case StrokeKind::dryness:
    case StrokeKind::trodden:
        part.look = true;
        break;
    }
    part.finest = std::min(part.finest, stroke.radius);
}

} // namespace

bool doesTouch(const StrokeSegment& capsule, const DAabb& box, double more)
{
    const glm::dvec3 middle = 0.5 * (box.low + box.high);
    const glm::dvec3 offset = middle - capsule.from - capsule.shareAt(middle) * capsule.along;
    const double near = capsule.radius + more + 0.5 * glm::length(box.high - box.low);
    return glm::dot(offset, offset) <= near * near;
}

PaintedParts::PaintedParts(const Painting& painting, const Strokes& strokes)
    : strokes_(&strokes)
    , segments_(segmentsOf(painting))
    , boxes_(boxesOf(segments_))
{
}

PaintedPart PaintedParts::in(const DAabb& box) const
{
    // For what is rounded on the way from a box to a root [m].
    constexpr double slack = 1e-3;
    PaintedPart part;
    boxes_.visit(box, [&](std::size_t index) {
        if (doesTouch(segments_[index], box, slack))
            add(strokes_->list[segments_[index].stroke], part);
    });
    return part;
}

} // namespace sward::bake
