#include "bake/session.h"

#include "bake/all_cells.h"
#include "bake/cells_between.h"
#include "bake/field_header.h"
#include "bake/ground_changes.h"
#include "bake/patches/patch_tree.h"
#include "bake/patches/split_cells.h"
#include "bake/stroke_reach.h"
#include "bake/threads.h"
#include "bake/whole_plan.h"
#include "terrain/query/surface_query.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace sward::bake {
namespace {

// Largest spacing of tufts [m]; 0: none grow.
double tuftSpacing(const Meadow& meadow, double scale)
{
    double widest = 0.0;
    for (const SpeciesTraits& species : meadow.species)
        widest = std::max(widest, species.tuftSpacing * scale);
    return widest;
}

} // namespace

Session::Session(const terrain::GroundMesh& ground, const BakeSettings& settings, int threads,
                 Diagnostics& diagnostics, Progress& progress, const field::FieldView* baked)
    : settings_(settings)
    , threads_(threadCount(threads))
{
    validate(settings_);
    withThreads(threads_, [&] {
        ground_ = groundOf(ground);
        std::optional<terrain::SurfaceQuery> rays;
        if (baked == nullptr && needsRays(ground, settings_))
            rays.emplace(ground);
        const terrain::SurfaceFeatures& features = ground_.features;
        plan_ = planWhole({ground, features, rays ? &*rays : nullptr}, settings_, diagnostics,
                          progress);
        ground_.report.bladeScale = plan_.plan.scale;
        hasReused_ = baked != nullptr && reuse(*baked, diagnostics);
        if (hasReused_)
            return;
        if (needsTiles(settings_, plan_, {}))
            rays.reset(); // each tile builds its own
        const auto take = [&](TileResult&& tile) {
            for (CellTree& cell : tile.cells)
                cells_.insert_or_assign(cell.cell, std::move(cell));
        };
        bakeAllCells({ground, features, rays ? &*rays : nullptr}, settings_, plan_, {}, take,
                     progress);
    });
}

Session::Ground Session::groundOf(const terrain::GroundMesh& mesh) const
{
    Ground ground;
    ground.mesh = &mesh;
    ground.report = reportOf(mesh, settings_, threads_);
    ground.report.bladeScale = plan_.plan.scale;
    ground.features = featuresOf(mesh, settings_);
    ground.triangles.emplace(mesh);
    for (const std::vector<CellNumber>& cells : dealTiles(mesh, 1))
        ground.bearing.insert(cells.begin(), cells.end());
    ground.part = partOf(mesh, {});
    return ground;
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
    if (baked.origin != ground().origin ||
        *baked.provenance != provenanceOf(settings_, ground_.report))
        return refuse("it was baked of other ground, with other options or strokes, or by another "
                      "version of the program");
    for (CellTree& cell : splitCells(baked))
        cells_.insert_or_assign(cell.cell, std::move(cell));
    return true;
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
    const double tufts = tuftSpacing(settings_.meadow, plan_.plan.scale);
    std::set<CellNumber> reached;
    for (auto stroke = differing.first; stroke != oldEnd; ++stroke)
        addCellsReached(*stroke, later, tufts, ground_.bearing, reached);
    for (auto stroke = differing.second; stroke != nextEnd; ++stroke)
        addCellsReached(*stroke, later, tufts, ground_.bearing, reached);
    return reached;
}

// The cells that differ between the ground of the session and the next one.
std::set<CellNumber> Session::cellsChanged(const Ground& next) const
{
    std::set<CellNumber> either = ground_.bearing;
    either.insert(next.bearing.begin(), next.bearing.end());
    const GroundChanges changes =
        groundChanges({ground(), ground_.features}, {*next.mesh, next.features});
    if (changes.isEverywhere)
        return either;
    const double margin =
        std::max(tileMargin(ground(), settings_, plan_), tileMargin(*next.mesh, settings_, plan_));
    std::set<CellNumber> changed;
    for (const Aabb& box : changes.boxes) {
        const DAabb around{next.mesh->origin + glm::dvec3(box.low) - margin,
                           next.mesh->origin + glm::dvec3(box.high) + margin};
        forCellsBetween(either, around, [&](const CellNumber& cell) { changed.insert(cell); });
    }
    return changed;
}

// Bakes cells of a ground, in tiles of bounded memory.
std::vector<CellTree> Session::bakeAgain(Ground& ground, const BakeSettings& settings,
                                         const std::set<CellNumber>& cells,
                                         Progress& progress) const
{
    std::vector<CellTree> baked;
    const double perCell = double(bladeCount()) / double(std::max<std::size_t>(cells_.size(), 1));
    const auto together =
        static_cast<std::size_t>(std::max(TileLimits{}.inTile / std::max(perCell, 1.0), 1.0));
    const double margin = tileMargin(*ground.mesh, settings, plan_);
    for (auto next = cells.begin(); next != cells.end();) {
        std::vector<CellNumber> own;
        for (; next != cells.end() && own.size() < together; ++next)
            own.push_back(*next);
        const std::vector<std::uint32_t> near = ground.triangles->near(own, margin);
        refillPart(*ground.mesh, near, ground.part);
        const terrain::SurfaceFeatures features =
            partOf(*ground.mesh, ground.features, near, margin);
        const TileRegion region(ground.mesh->origin, own);
        TileResult tile = bakeTile({ground.part, features}, settings, plan_, &region, progress);
        std::move(tile.cells.begin(), tile.cells.end(), std::back_inserter(baked));
    }
    return baked;
}

// Takes what was baked instead of these cells.
Session::Change Session::replaceCells(const std::set<CellNumber>& cells,
                                      std::vector<CellTree>&& baked)
{
    Change change;
    change.cells.assign(cells.begin(), cells.end());
    for (const CellNumber& cell : cells)
        cells_.erase(cell);
    for (CellTree& cell : baked) {
        change.blades += cell.blades.size();
        cells_.insert_or_assign(cell.cell, std::move(cell));
    }
    return change;
}

Session::Change Session::apply(Strokes strokes, Progress& progress)
{
    const std::set<CellNumber> reached = cellsReached(strokes);
    BakeSettings next = settings_;
    next.strokes = std::move(strokes);
    std::vector<CellTree> baked;
    if (!reached.empty())
        withThreads(threads_, [&] { baked = bakeAgain(ground_, next, reached, progress); });
    settings_.strokes = std::move(next.strokes);
    return replaceCells(reached, std::move(baked));
}

Session::Change Session::replaceGround(const terrain::GroundMesh& ground, Progress& progress)
{
    Ground next;
    std::set<CellNumber> changed;
    std::vector<CellTree> baked;
    withThreads(threads_, [&] {
        next = groundOf(ground);
        changed = cellsChanged(next);
        baked = bakeAgain(next, settings_, changed, progress);
    });
    ground_ = std::move(next);
    return replaceCells(changed, std::move(baked));
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
    delta.origin = ground().origin;
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
    field::Field field = fieldWithoutBlades(ground(), settings_, plan_, ground_.report);
    std::vector<CellTree> cells;
    cells.reserve(cells_.size());
    for (const auto& [number, cell] : cells_)
        cells.push_back(cell);
    withThreads(threads_, [&] { joinCells(std::move(cells), field); });
    return field;
}

} // namespace sward::bake
