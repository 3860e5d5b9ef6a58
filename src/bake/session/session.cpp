#include "bake/session/session.h"

#include "bake/patches/patch_tree.h"
#include "bake/patches/split_cells.h"
#include "bake/seeds/seed_bake.h"
#include "bake/seeds/seeded_field.h"
#include "bake/session/cell_triangles.h"
#include "bake/session/cells_between.h"
#include "bake/session/ground_changes.h"
#include "bake/session/seed_edits.h"
#include "bake/session/stroke_reach.h"
#include "bake/settings/threads.h"
#include "bake/tiles/bake_tile.h"
#include "bake/whole/all_cells.h"
#include "bake/whole/field_header.h"
#include "bake/whole/whole_plan.h"
#include "core/error.h"
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
    // The strokes that differ between those of the session and the next ones, and the unchanged
    // ones after them.
    struct Differing {
        std::span<const Stroke> before;
        std::span<const Stroke> after;
        std::span<const Stroke> later;
    };
    Differing differing(const Strokes& next) const;
    std::set<CellNumber> cellsReached(const Strokes& next) const;
    void beginSeeded(const field::FieldView* baked, Diagnostics& diagnostics, Progress& progress);
    SeedEdits::Source seedSource(const Ground& ground) const;
    Change take(SeedEdits::Change&& changed);
    Change applySeeded(Strokes&& next, Progress& progress);
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
    std::optional<SeedEdits> seeds; // of settings that write them
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
        if (writesSeeds(first, settings)) {
            beginSeeded(baked, diagnostics, progress);
            return;
        }
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

// The same for settings that write seeds.
void Session::Parts::beginSeeded(const field::FieldView* baked, Diagnostics& diagnostics,
                                 Progress& progress)
{
    plan = planWhole({mesh(), surface.features, nullptr}, fullSettings(settings), diagnostics,
                     progress);
    planSeeds(mesh(), settings, plan);
    surface.report.bladeScale = plan.plan.scale;
    hasReused = baked != nullptr && reuse(*baked, diagnostics);
    if (hasReused) {
        seeds.emplace(*baked->seeds);
        return;
    }
    Diagnostics ignored; // the same
    const field::Field field =
        bakeSeededField(mesh(), settings, threads, {}, ignored, progress).field;
    for (CellTree& cell : splitCells(field::viewOf(field)))
        trees.insert_or_assign(cell.cell, std::move(cell));
    seeds.emplace(field.seeds->view);
}

SeedEdits::Source Session::Parts::seedSource(const Ground& ground) const
{
    return {{*ground.mesh, ground.features}, *ground.triangles, ground.bearing, settings, plan};
}

Session::Change Session::Parts::take(SeedEdits::Change&& changed)
{
    return replaceCells({changed.cells.begin(), changed.cells.end()}, std::move(changed.trees));
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
    if ((baked.seeds != nullptr) != plan.seeds.has_value() ||
        (plan.seeds &&
         field::seedMeadowText(*baked.seeds->meadow) != field::seedMeadowText(*plan.seeds)))
        return refuse("its seeds are others");
    for (CellTree& cell : splitCells(baked))
        trees.insert_or_assign(cell.cell, std::move(cell));
    return true;
}

// Strokes that both begin or end with count as unchanged.
Session::Parts::Differing Session::Parts::differing(const Strokes& next) const
{
    const std::vector<Stroke>& old = settings.strokes.list;
    const auto [first, second] =
        std::mismatch(old.begin(), old.end(), next.list.begin(), next.list.end(), paintAlike);
    auto oldEnd = old.end();
    auto nextEnd = next.list.end();
    while (oldEnd != first && nextEnd != second &&
           paintAlike(*std::prev(oldEnd), *std::prev(nextEnd))) {
        --oldEnd;
        --nextEnd;
    }
    return {{first, oldEnd}, {second, nextEnd}, {oldEnd, old.end()}};
}

// The cells that differ between the strokes of the session and the next ones.
std::set<CellNumber> Session::Parts::cellsReached(const Strokes& next) const
{
    const Differing strokes = differing(next);
    const double tufts = tuftSpacing(settings.meadow, plan.plan.scale);
    std::set<CellNumber> reached;
    for (const std::span<const Stroke> list : {strokes.before, strokes.after})
        for (const Stroke& stroke : list)
            addCellsReached(stroke, strokes.later, tufts, surface.bearing, reached);
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
    const auto marginOf = [&](const terrain::GroundMesh& ground) {
        return seeds ? seedMargin(ground, settings, plan) : tileMargin(ground, settings, plan);
    };
    const double margin = std::max(marginOf(mesh()), marginOf(*next.mesh));
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

// apply() of settings that write seeds.
Session::Change Session::Parts::applySeeded(Strokes&& next, Progress& progress)
{
    const Differing strokes = differing(next);
    std::vector<Stroke> others(strokes.before.begin(), strokes.before.end());
    others.insert(others.end(), strokes.after.begin(), strokes.after.end());
    others.insert(others.end(), strokes.later.begin(), strokes.later.end());
    std::vector<StrokeSegment> capsules;
    for (const std::span<const Stroke> list : {strokes.before, strokes.after})
        for (const Stroke& stroke : list) {
            const std::vector<StrokeSegment> own = capsulesReached(stroke, others);
            capsules.insert(capsules.end(), own.begin(), own.end());
        }
    SeedEdits::Change changed;
    withThreads(threads,
                [&] { changed = seeds->apply(seedSource(surface), capsules, next, progress); });
    settings.strokes = std::move(next);
    return take(std::move(changed));
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
    if (parts.seeds)
        return parts.applySeeded(std::move(strokes), progress);
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
        if (parts.seeds)
            baked = parts.seeds->remake(parts.seedSource(next), changed, progress).trees;
        else
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

bool Session::hasSeeds() const
{
    return parts_->seeds.has_value();
}

const std::map<field::CellIndex, CellTree>& Session::cells() const
{
    return parts_->trees;
}

std::uint64_t Session::bladeCount() const
{
    return parts_->bladeCount();
}

void requireBlades(std::uint64_t blades, std::uint64_t before, std::uint64_t most)
{
    if (blades <= std::max(most, before))
        return;
    if (before > most)
        fail(ErrorKind::input,
             "{} blades after the change, more than {} at the start, which are more than "
             "--max-blades {}",
             blades, before, most);
    fail(ErrorKind::input, "{} blades after the change, more than --max-blades {}", blades, most);
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
    if (parts_->seeds)
        delta.seeds = parts_->seeds->cells(cells, delta.origin);
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
    withThreads(parts.threads, [&] {
        joinCells(std::move(cells), field);
        if (parts.seeds)
            field.seeds = std::make_shared<const field::SharedSeeds>(parts.seeds->seeds());
    });
    return field;
}

} // namespace sward::bake
