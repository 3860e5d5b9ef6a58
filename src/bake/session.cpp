#include "bake/session.h"

#include "bake/all_cells.h"
#include "bake/field_header.h"
#include "bake/paint/stroke_grid.h"
#include "bake/patches/patch_tree.h"
#include "bake/patches/split_cells.h"
#include "bake/sample/progressive_order.h"
#include "bake/threads.h"
#include "bake/whole_plan.h"
#include "core/floor.h"
#include "terrain/query/surface_query.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

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

} // namespace

Session::Session(const terrain::GroundMesh& ground, const BakeSettings& settings, int threads,
                 Diagnostics& diagnostics, Progress& progress, const field::FieldView* baked)
    : ground_(ground)
    , settings_(settings)
    , threads_(threadCount(threads))
{
    validate(settings_);
    withThreads(threads_, [&] {
        report_ = reportOf(ground_, settings_, threads_);
        features_ = featuresOf(ground_, settings_);
        std::optional<terrain::SurfaceQuery> rays;
        if (baked == nullptr && needsRays(ground_, settings_))
            rays.emplace(ground_);
        plan_ = planWhole({ground_, features_, rays ? &*rays : nullptr}, settings_, diagnostics,
                          progress);
        report_.bladeScale = plan_.plan.scale;
        margin_ = tileMargin(ground_, settings_, plan_);
        triangles_.emplace(ground_);
        for (const std::vector<CellNumber>& cells : dealTiles(ground_, 1))
            bearing_.insert(cells.begin(), cells.end());
        part_ = partOf(ground_, {});
        hasReused_ = baked != nullptr && reuse(*baked, diagnostics);
        if (hasReused_)
            return;
        if (needsTiles(settings_, plan_, {}))
            rays.reset(); // each tile builds its own
        const auto take = [&](TileResult&& tile) {
            for (CellTree& cell : tile.cells)
                cells_.insert_or_assign(cell.cell, std::move(cell));
        };
        bakeAllCells({ground_, features_, rays ? &*rays : nullptr}, settings_, plan_, {}, take,
                     progress);
    });
}

// Takes the blades of a field that was baked alike.
bool Session::reuse(const field::FieldView& baked, Diagnostics& diagnostics)
{
    const auto refuse = [&](const char* why) {
        diagnostics.warn("the field's blades are not used, but baked anew: {}", why);
        return false;
    };
    if (baked.keys.size() != baked.blades.size())
        return refuse("it does not tell where its blades come from");
    if (baked.origin != ground_.origin || *baked.provenance != provenanceOf(settings_, report_))
        return refuse("it was baked of other ground, with other options or strokes, or by another "
                      "version of the program");
    for (CellTree& cell : splitCells(baked))
        cells_.insert_or_assign(cell.cell, std::move(cell));
    return true;
}

// The cells that a stroke changes, with `later` strokes after it.
void Session::addCells(const Stroke& stroke, std::span<const Stroke> later,
                       std::set<CellNumber>& reached) const
{
    double margin = slackOfStrokes;
    if (changesRoots(stroke.kind)) {
        // Tufts look at their middles, and strokes that smooth at what is around a root.
        double around = 0.0;
        for (const SpeciesTraits& species : settings_.meadow.species)
            around = std::max(around, 3.0 * species.tuftSpacing * plan_.plan.scale);
        for (const Stroke& other : later)
            if (other.kind == StrokeKind::smooth && mayTouch(stroke, other, other.radius))
                around = std::max(around, other.radius);
        margin += around + progressiveReach + LocalRanks::reach;
    }
    constexpr double halfDiagonal = 0.8661 * widestPatch;
    for (const StrokeSegment& capsule : capsulesOf(stroke)) {
        const double reach = capsule.radius + margin;
        const auto take = [&](const CellNumber& cell) {
            const glm::dvec3 corner{double(cell[0]), double(cell[1]), double(cell[2])};
            const glm::dvec3 middle = (corner + 0.5) * widestPatch;
            const glm::dvec3 offset =
                middle - capsule.from - capsule.shareAt(middle) * capsule.along;
            const double near = reach + halfDiagonal;
            if (glm::dot(offset, offset) <= near * near)
                reached.insert(cell);
        };
        CellNumber first;
        CellNumber last;
        double count = 1.0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double from = capsule.from[int(axis)];
            const double to = from + capsule.along[int(axis)];
            first[axis] = floorOf((std::min(from, to) - reach) / widestPatch);
            last[axis] = floorOf((std::max(from, to) + reach) / widestPatch);
            count *= double(last[axis] - first[axis] + 1);
        }
        if (count > double(bearing_.size())) {
            std::for_each(bearing_.begin(), bearing_.end(), take);
            continue;
        }
        for (std::int64_t x = first[0]; x <= last[0]; ++x)
            for (std::int64_t y = first[1]; y <= last[1]; ++y)
                for (std::int64_t z = first[2]; z <= last[2]; ++z)
                    if (bearing_.count({x, y, z}) != 0)
                        take({x, y, z});
    }
}

// The cells that differ between the strokes of the session and the next ones. Strokes that both
// begin or end with count as unchanged.
std::set<CellNumber> Session::cellsReached(const Strokes& next) const
{
    const std::vector<Stroke>& old = settings_.strokes.list;
    const auto differing =
        std::mismatch(old.begin(), old.end(), next.list.begin(), next.list.end());
    auto oldEnd = old.end();
    auto nextEnd = next.list.end();
    while (oldEnd != differing.first && nextEnd != differing.second &&
           *std::prev(oldEnd) == *std::prev(nextEnd)) {
        --oldEnd;
        --nextEnd;
    }
    const std::span<const Stroke> later(oldEnd, old.end());
    std::set<CellNumber> reached;
    for (auto stroke = differing.first; stroke != oldEnd; ++stroke)
        addCells(*stroke, later, reached);
    for (auto stroke = differing.second; stroke != nextEnd; ++stroke)
        addCells(*stroke, later, reached);
    return reached;
}

Session::Change Session::apply(Strokes strokes, Progress& progress)
{
    const std::set<CellNumber> reached = cellsReached(strokes);
    Change change;
    change.cells.assign(reached.begin(), reached.end());
    BakeSettings next = settings_;
    next.strokes = std::move(strokes);
    TileResult tile;
    if (!reached.empty())
        withThreads(threads_, [&] {
            // Strokes may widen what rays look at: see reachOf().
            const double margin = std::max(margin_, tileMargin(ground_, next, plan_));
            const std::vector<std::uint32_t> near = triangles_->near(change.cells, margin);
            refillPart(ground_, near, part_);
            const terrain::SurfaceFeatures features = partOf(ground_, features_, near, margin);
            const TileRegion region(ground_.origin, change.cells);
            tile = bakeTile({part_, features}, next, plan_, &region, progress);
        });
    for (const CellNumber& cell : change.cells)
        cells_.erase(cell);
    for (CellTree& cell : tile.cells) {
        change.blades += cell.blades.size();
        cells_.insert_or_assign(cell.cell, std::move(cell));
    }
    settings_.strokes = std::move(next.strokes);
    return change;
}

std::uint64_t Session::bladeCount() const
{
    std::uint64_t blades = 0;
    for (const auto& [number, cell] : cells_)
        blades += cell.blades.size();
    return blades;
}

field::Delta Session::deltaOf(std::span<const CellNumber> cells) const
{
    field::Delta delta;
    delta.origin = ground_.origin;
    for (const CellNumber& number : cells) {
        field::CellChange& change = delta.cells.emplace_back();
        change.cell = number;
        const auto found = cells_.find(number);
        if (found == cells_.end())
            continue;
        change.patches = found->second.patches;
        change.blades = found->second.blades;
        change.keys = found->second.keys;
    }
    return delta;
}

field::Field Session::field() const
{
    field::Field field = fieldWithoutBlades(ground_, settings_, plan_, report_);
    std::vector<CellTree> cells;
    cells.reserve(cells_.size());
    for (const auto& [number, cell] : cells_)
        cells.push_back(cell);
    withThreads(threads_, [&] { joinCells(std::move(cells), field); });
    return field;
}

} // namespace sward::bake
