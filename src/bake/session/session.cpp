#include "bake/session/session.h"

#include "bake/patches/patch_tree.h"
#include "bake/patches/split_cells.h"
#include "bake/session/cell_triangles.h"
#include "bake/session/cells_between.h"
#include "bake/session/ground_changes.h"
#include "bake/session/stroke_reach.h"
#include "bake/settings/threads.h"
#include "bake/tiles/bake_tile.h"
#include "bake/whole/all_cells.h"
#include "bake/whole/field_header.h"
#include "bake/whole/whole_plan.h"
#include "terrain/query/surface_query.h"
#include "terrain/topology/surface_features.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <set>
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

// Whether two strokes differ in their names at most.
bool paintAlike(const Stroke& a, const Stroke& b)
{
    if (a.name == b.name)
        return a == b;
    Stroke renamed = a;
    renamed.name = b.name;
    return renamed == b;
}

// Strokes of fewer are looked at among the triangles near them.
constexpr std::size_t fewStrokes = 64;

} // namespace

// Members of a session.
struct Session::Parts {
    // A ground with what the session finds on it once.
    struct Ground {
        const terrain::GroundMesh* mesh = nullptr;
        Report report; // of the input
        terrain::SurfaceFeatures features;
        std::optional<CellTriangles> triangles;
        std::set<CellNumber> bearing; // all cells that may have blades
        terrain::GroundMesh part;     // around the cells that were baked last
    };

    Parts(const terrain::GroundMesh& first, const BakeSettings& given, int wantedThreads,
          Diagnostics& diagnostics, Progress& progress, const field::FieldView* baked);

    const terrain::GroundMesh& mesh() const { return *surface.mesh; }
    Ground groundOf(const terrain::GroundMesh& other) const;
    bool reuse(const field::FieldView& baked, Diagnostics& diagnostics);
    std::set<CellNumber> cellsReached(const Strokes& next) const;
    std::set<CellNumber> cellsChanged(const Ground& next) const;
    std::vector<CellTree> bakeAgain(Ground& ground, const BakeSettings& wanted,
                                    const std::set<CellNumber>& cells, Progress& progress) const;
    Change replaceCells(const std::set<CellNumber>& cells, std::vector<CellTree>&& baked);
    std::uint64_t bladeCount() const;

    BakeSettings settings;
    int threads;
    Ground surface;
    BakePlan plan;
    std::map<CellNumber, CellTree> trees;
    bool hasReused = false;
};

Session::Parts::Parts(const terrain::GroundMesh& first, const BakeSettings& given,
                      int wantedThreads, Diagnostics& diagnostics, Progress& progress,
                      const field::FieldView* baked)
    : settings(given)
    , threads(threadCount(wantedThreads))
{
    validate(settings);
    withThreads(threads, [&] {
        surface = groundOf(first);
        std::optional<terrain::SurfaceQuery> rays;
        if (baked == nullptr && needsRays(first, settings) &&
            !hasManyTriangles(first, settings, {}))
            rays.emplace(first);
        const terrain::SurfaceFeatures& features = surface.features;
        plan =
            planWhole({first, features, rays ? &*rays : nullptr}, settings, diagnostics, progress);
        surface.report.bladeScale = plan.plan.scale;
        hasReused = baked != nullptr && reuse(*baked, diagnostics);
        if (hasReused)
            return;
        if (needsTiles(first, settings, plan, {}))
            rays.reset(); // each tile builds its own
        const auto take = [&](TileResult&& tile) {
            for (CellTree& cell : tile.cells)
                trees.insert_or_assign(cell.cell, std::move(cell));
        };
        bakeAllCells({first, features, rays ? &*rays : nullptr}, settings, plan, {}, take,
                     progress);
    });
}

Session::Parts::Ground Session::Parts::groundOf(const terrain::GroundMesh& other) const
{
    Ground ground;
    ground.mesh = &other;
    ground.report = reportOf(other, settings, threads);
    ground.report.bladeScale = plan.plan.scale;
    ground.features = featuresOf(other, settings);
    ground.triangles.emplace(other);
    for (const std::vector<CellNumber>& cells : dealTiles(other, 1))
        ground.bearing.insert(cells.begin(), cells.end());
    ground.part = partOf(other, {});
    return ground;
}

// Takes the blades of a field that was baked alike.
bool Session::Parts::reuse(const field::FieldView& baked, Diagnostics& diagnostics)
{
    const auto refuse = [&](const char* why) {
        diagnostics.warn("the field's blades are not used, but baked anew: {}", why);
        return false;
    };
    if (baked.keys.size() != baked.blades.size())
        return refuse("it does not tell where its blades come from");
    if (baked.origin != mesh().origin ||
        *baked.provenance != provenanceOf(settings, surface.report))
        return refuse("it was baked of other ground, with other options or strokes, or by another "
                      "version of the program");
    for (CellTree& cell : splitCells(baked))
        trees.insert_or_assign(cell.cell, std::move(cell));
    return true;
}

// The cells that differ between the strokes of the session and the next ones. Strokes that both
// begin or end with count as unchanged.
std::set<CellNumber> Session::Parts::cellsReached(const Strokes& next) const
{
    const std::vector<Stroke>& old = settings.strokes.list;
    const auto differing =
        std::mismatch(old.begin(), old.end(), next.list.begin(), next.list.end(), paintAlike);
    auto oldEnd = old.end();
    auto nextEnd = next.list.end();
    while (oldEnd != differing.first && nextEnd != differing.second &&
           paintAlike(*std::prev(oldEnd), *std::prev(nextEnd))) {
        --oldEnd;
        --nextEnd;
    }
    const std::span<const Stroke> later(oldEnd, old.end());
    const double tufts = tuftSpacing(settings.meadow, plan.plan.scale);
    std::set<CellNumber> reached;
    for (auto stroke = differing.first; stroke != oldEnd; ++stroke)
        addCellsReached(*stroke, later, tufts, surface.bearing, reached);
    for (auto stroke = differing.second; stroke != nextEnd; ++stroke)
        addCellsReached(*stroke, later, tufts, surface.bearing, reached);
    return reached;
}

// The cells that differ between the ground of the session and the next one.
std::set<CellNumber> Session::Parts::cellsChanged(const Ground& next) const
{
    std::set<CellNumber> either = surface.bearing;
    either.insert(next.bearing.begin(), next.bearing.end());
    const GroundChanges changes =
        groundChanges({mesh(), surface.features}, {*next.mesh, next.features});
    if (changes.isEverywhere)
        return either;
    const double margin =
        std::max(tileMargin(mesh(), settings, plan), tileMargin(*next.mesh, settings, plan));
    std::set<CellNumber> changed;
    for (const Aabb& box : changes.boxes) {
        const DAabb around{next.mesh->origin + glm::dvec3(box.low) - margin,
                           next.mesh->origin + glm::dvec3(box.high) + margin};
        forCellsBetween(either, around, [&](const CellNumber& cell) { changed.insert(cell); });
    }
    return changed;
}

// Bakes cells of a ground, in tiles of bounded memory.
std::vector<CellTree> Session::Parts::bakeAgain(Ground& ground, const BakeSettings& wanted,
                                                const std::set<CellNumber>& cells,
                                                Progress& progress) const
{
    std::vector<CellTree> baked;
    const double perCell = double(bladeCount()) / double(std::max<std::size_t>(trees.size(), 1));
    const auto together =
        static_cast<std::size_t>(std::max(TileLimits{}.inTile / std::max(perCell, 1.0), 1.0));
    const double margin = tileMargin(*ground.mesh, wanted, plan);
    for (auto next = cells.begin(); next != cells.end();) {
        std::vector<CellNumber> own;
        for (; next != cells.end() && own.size() < together; ++next)
            own.push_back(*next);
        const std::vector<std::uint32_t> near = ground.triangles->near(own, margin);
        refillPart(*ground.mesh, near, ground.part);
        const terrain::SurfaceFeatures features =
            partOf(*ground.mesh, ground.features, near, margin);
        const TileRegion region(ground.mesh->origin, own);
        TileResult tile = bakeTile({ground.part, features}, wanted, plan, &region, progress);
        std::move(tile.cells.begin(), tile.cells.end(), std::back_inserter(baked));
    }
    return baked;
}

// Takes what was baked instead of these cells.
Session::Change Session::Parts::replaceCells(const std::set<CellNumber>& cells,
                                             std::vector<CellTree>&& baked)
{
    Change change;
    change.cells.assign(cells.begin(), cells.end());
    for (const CellNumber& cell : cells)
        trees.erase(cell);
    for (CellTree& cell : baked) {
        change.blades += cell.blades.size();
        trees.insert_or_assign(cell.cell, std::move(cell));
    }
    return change;
}

Session::Session(const terrain::GroundMesh& ground, const BakeSettings& settings, int threads,
                 Diagnostics& diagnostics, Progress& progress, const field::FieldView* baked)
    : parts_(std::make_unique<Parts>(ground, settings, threads, diagnostics, progress, baked))
{
}

Session::Session(Session&&) noexcept = default;
Session::~Session() = default;

Session::Change Session::apply(Strokes strokes, Progress& progress)
{
    Parts& parts = *parts_;
    const std::set<CellNumber> reached = parts.cellsReached(strokes);
    BakeSettings next = parts.settings;
    next.strokes = std::move(strokes);
    std::vector<CellTree> baked;
    if (!reached.empty())
        withThreads(parts.threads,
                    [&] { baked = parts.bakeAgain(parts.surface, next, reached, progress); });
    parts.settings.strokes = std::move(next.strokes);
    return parts.replaceCells(reached, std::move(baked));
}

Session::Change Session::replaceGround(const terrain::GroundMesh& ground, Progress& progress)
{
    Parts& parts = *parts_;
    Parts::Ground next;
    std::set<CellNumber> changed;
    std::vector<CellTree> baked;
    withThreads(parts.threads, [&] {
        next = parts.groundOf(ground);
        changed = parts.cellsChanged(next);
        baked = parts.bakeAgain(next, parts.settings, changed, progress);
    });
    parts.surface = std::move(next);
    return parts.replaceCells(changed, std::move(baked));
}

std::vector<StrokeContact> Session::contacts(std::size_t first) const
{
    const Parts& parts = *parts_;
    const std::span<const Stroke> strokes =
        std::span<const Stroke>(parts.settings.strokes.list).subspan(first);
    if (strokes.size() > fewStrokes)
        return contactsOf(ground(), sides(), strokes);
    std::set<CellNumber> cells;
    for (const Stroke& stroke : strokes)
        addCellsTouched(stroke, parts.surface.bearing, cells);
    const std::vector<std::uint32_t> near =
        parts.surface.triangles->near({cells.begin(), cells.end()}, 0.0);
    return contactsOf(ground(), sides(), strokes, near);
}

Sides Session::sides() const
{
    return parts_->settings.sides;
}

const Strokes& Session::strokes() const
{
    return parts_->settings.strokes;
}

const BakePlan& Session::plan() const
{
    return parts_->plan;
}

const terrain::GroundMesh& Session::ground() const
{
    return parts_->mesh();
}

bool Session::hasReused() const
{
    return parts_->hasReused;
}

const std::map<field::CellIndex, CellTree>& Session::cells() const
{
    return parts_->trees;
}

std::uint64_t Session::bladeCount() const
{
    return parts_->bladeCount();
}

std::uint64_t Session::Parts::bladeCount() const
{
    std::uint64_t blades = 0;
    for (const auto& [number, cell] : trees)
        blades += cell.blades.size();
    return blades;
}

field::Delta Session::deltaOf(std::span<const field::CellIndex> cells) const
{
    field::Delta delta;
    delta.origin = ground().origin;
    for (const field::CellIndex& number : cells) {
        field::CellChange& change = delta.cells.emplace_back();
        change.cell = number;
        const auto found = parts_->trees.find(number);
        if (found == parts_->trees.end())
            continue;
        change.patches = found->second.patches;
        change.blades = found->second.blades;
        change.keys = found->second.keys;
    }
    return delta;
}

field::Field Session::field() const
{
    const Parts& parts = *parts_;
    field::Field field =
        fieldWithoutBlades(ground(), parts.settings, parts.plan, parts.surface.report);
    std::vector<CellTree> cells;
    cells.reserve(parts.trees.size());
    for (const auto& [number, cell] : parts.trees)
        cells.push_back(cell);
    withThreads(parts.threads, [&] { joinCells(std::move(cells), field); });
    return field;
}

} // namespace sward::bake
