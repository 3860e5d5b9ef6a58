#include "bake/session/seed_edits.h"

#include "bake/filter/root_filter.h"
#include "bake/paint/box_tree.h"
#include "bake/paint/painted_parts.h"
#include "bake/seeds/grow_field.h"
#include "bake/seeds/seed_bake.h"
#include "bake/seeds/seed_cells.h"
#include "bake/seeds/seed_pieces.h"
#include "bake/seeds/seed_sites.h"
#include "bake/seeds/seeded_field.h"
#include "bake/session/cells_between.h"
#include "bake/whole/field_header.h"
#include "terrain/query/surface_query.h"
#include "terrain/topology/surface_features.h"

#include <glm/vec3.hpp>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>
#include <utility>

namespace sward::bake {
namespace {

using SharedCell = std::shared_ptr<const field::SeedCell>;

// For what is rounded on the way from a stroke to a root [m].
constexpr double slackOfCapsules = 0.01;

// Cells that are made at once of another ground.
constexpr std::size_t cellsOfRemake = 64;

SeedCellNumber seedCellOf(const glm::dvec3& origin, const CellNumber& cell)
{
    const CellNumber first = worldCell(origin, {0, 0, 0});
    SeedCellNumber number;
    for (std::size_t axis = 0; axis < 3; ++axis)
        number[axis] = static_cast<std::int32_t>(cell[axis] - first[axis]);
    return number;
}

// The entries of one cell in a list that is sorted by cells.
template <typename T>
std::span<const T> entriesOfCell(const std::vector<T>& list, const SeedCellNumber& cell)
{
    const auto first = std::lower_bound(
        list.begin(), list.end(), cell,
        [](const T& one, const SeedCellNumber& number) { return one.cell < number; });
    auto last = first;
    while (last != list.end() && last->cell == cell)
        ++last;
    return {first, last};
}

template <typename T>
bool areSame(const std::vector<T>& a, const std::vector<T>& b)
{
    return a.size() == b.size() &&
           (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

bool areSame(const field::SeedCell& a, const field::SeedCell& b)
{
    return areSame(a.vertices, b.vertices) && areSame(a.pieces, b.pieces) &&
           areSame(a.clumps, b.clumps) && areSame(a.conditions, b.conditions) &&
           areSame(a.words, b.words);
}

// Capsules of strokes, in a tree.
class Capsules {
public:
    Capsules(std::span<const StrokeSegment> inWorld, const glm::dvec3& origin)
        : list_(inWorld.begin(), inWorld.end())
        , tree_(boxesOf(list_, origin))
    {
    }

    bool touch(const DAabb& box) const
    {
        bool isTouched = false;
        tree_.visit(box, [&](std::size_t index) {
            isTouched = isTouched || doesTouch(list_[index], box, slackOfCapsules);
        });
        return isTouched;
    }

private:
    static std::vector<DAabb> boxesOf(std::vector<StrokeSegment>& list, const glm::dvec3& origin)
    {
        std::vector<DAabb> boxes;
        for (StrokeSegment& one : list) {
            one.from -= origin;
            DAabb& box = boxes.emplace_back(one.box());
            box.low -= slackOfCapsules;
            box.high += slackOfCapsules;
        }
        return boxes;
    }

    std::vector<StrokeSegment> list_;
    BoxTree tree_;
};

// The bearing cells of which parts may touch a capsule.
std::set<CellNumber> cellsNear(std::span<const StrokeSegment> capsules,
                               const std::set<CellNumber>& bearing)
{
    std::set<CellNumber> cells;
    for (const StrokeSegment& capsule : capsules) {
        DAabb around = capsule.box();
        around.low -= widestPart + slackOfCapsules;
        around.high += widestPart + slackOfCapsules;
        forCellsBetween(bearing, around, [&](const CellNumber& cell) { cells.insert(cell); });
    }
    return cells;
}

} // namespace

// What makes the seeds of a few cells, with the ground around them.
struct SeedEdits::Workplace {
    Workplace(const Source& source, const std::set<CellNumber>& wanted)
        : cells(wanted)
        , settings(source.settings)
        , meadow(*source.plan.seeds)
        , units(meadow.unitBits)
    {
        settings.strokes = {};
        const double scale = source.plan.plan.scale;
        const terrain::GroundMesh& whole = source.ground.ground;
        const double margin = seedMargin(whole, settings, source.plan);
        const std::vector<CellNumber> own(cells.begin(), cells.end());
        const std::vector<std::uint32_t> near = source.triangles.near(own, margin);
        ground = partOf(whole, near);
        features = partOf(whole, source.ground.features, near, margin);
        if (needsRays(ground, settings))
            rays.emplace(ground);
        const terrain::SurfaceQuery* const query = rays ? &*rays : nullptr;
        filter.emplace(ground, settings, query, &features, scale);
        sites.emplace(ground, settings, scale, meadow, *filter, query, features);
        const TileRegion region(whole.origin, own);
        places = seedPlacesOf(ground, settings, meadow, &region);
        maker.emplace(ground, settings, meadow, units, *sites, places.centreCount);
    }

    std::set<CellNumber> cells;
    BakeSettings settings; // without strokes
    field::SeedMeadow meadow;
    SeedUnits units;
    terrain::GroundMesh ground;
    terrain::SurfaceFeatures features;
    std::optional<terrain::SurfaceQuery> rays;
    std::optional<RootFilter> filter;
    std::optional<SeedSites> sites;
    SeedPlaces places;
    std::optional<SeedCells> maker;
};

SeedEdits::SeedEdits(const field::SeedsView& seeds)
{
    baked_.meadow = *seeds.meadow;
    baked_.cells.assign(seeds.cells.begin(), seeds.cells.end());
    baked_.data.assign(seeds.data.begin(), seeds.data.end());
}

SeedEdits::SeedEdits(SeedEdits&&) noexcept = default;
SeedEdits::~SeedEdits() = default;

SharedCell SeedEdits::cellAt(const SeedCellNumber& cell) const
{
    if (const auto found = changed_.find(cell); found != changed_.end())
        return found->second;
    const auto entry =
        std::lower_bound(baked_.cells.begin(), baked_.cells.end(), cell,
                         [](const field::SeedEntry& one, const SeedCellNumber& number) {
                             return one.cell < number;
                         });
    if (entry != baked_.cells.end() && entry->cell == cell)
        return std::make_shared<const field::SeedCell>(
            field::readSeedCell(field::viewOf(baked_),
                                static_cast<std::size_t>(entry - baked_.cells.begin()), "seeds"));
    field::SeedCell bare;
    bare.cell = cell;
    return std::make_shared<const field::SeedCell>(std::move(bare));
}

SeedEdits::Change SeedEdits::apply(const Source& source, std::span<const StrokeSegment> capsules,
                                   const Strokes& next, Progress& progress)
{
    const glm::dvec3& origin = source.ground.ground.origin;
    const std::set<CellNumber> reached = cellsNear(capsules, source.bearing);
    if (reached.empty())
        return {};
    if (!workplace_ || !std::includes(workplace_->cells.begin(), workplace_->cells.end(),
                                      reached.begin(), reached.end()))
        workplace_ = std::make_unique<Workplace>(source, reached);
    Workplace& place = *workplace_;
    place.sites->repaint(next);

    Growth growth;
    growth.region.share = static_cast<float>(place.meadow.stored);
    growth.widening = place.meadow.storedWidening;
    const std::vector<field::Species> species = fieldSpecies(place.settings.meadow);
    const CellGrower grower(place.meadow, species, origin, growth);
    const Capsules touching(capsules, origin);
    struct Made {
        SharedCell cell;
        CellTree tree;
    };
    const std::vector<CellNumber> numbers(reached.begin(), reached.end());
    std::vector<Made> made(numbers.size());
    progress.begin("seeds", numbers.size());
    tbb::parallel_for(std::size_t(0), numbers.size(), [&](std::size_t i) {
        progress.throwIfCancelled();
        const SeedCellNumber number = seedCellOf(origin, numbers[i]);
        const std::span<const SeedPlaces::Part> parts = entriesOfCell(place.places.parts, number);
        const auto isTouched = [&](const SeedPlaces::Part& part) {
            return touching.touch(boxOfPart(place.ground, part.part));
        };
        if (std::any_of(parts.begin(), parts.end(), isTouched)) {
            const SharedCell before = cellAt(number);
            const SeedCells::Former former{*before,
                                           [&](const DAabb& box) { return touching.touch(box); }};
            field::SeedCell cell =
                place.maker->make(parts, entriesOfCell(place.places.centres, number),
                                  before->pieces.empty() ? nullptr : &former);
            if (!areSame(cell, *before)) {
                if (!cell.pieces.empty())
                    made[i].tree = grower.grow(cell, "seeds");
                made[i].cell = std::make_shared<const field::SeedCell>(std::move(cell));
            }
        }
        progress.advance(1);
    });
    progress.throwIfCancelled();
    Change change;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        if (!made[i].cell)
            continue;
        change.cells.push_back(numbers[i]);
        changed_[made[i].cell->cell] = std::move(made[i].cell);
        if (!made[i].tree.blades.empty())
            change.trees.push_back(std::move(made[i].tree));
    }
    return change;
}

SeedEdits::Change SeedEdits::remake(const Source& source, const std::set<CellNumber>& cells,
                                    Progress& progress)
{
    const terrain::GroundMesh& whole = source.ground.ground;
    const double margin = seedMargin(whole, source.settings, source.plan);
    Change change;
    std::map<SeedCellNumber, SharedCell> made;
    for (auto next = cells.begin(); next != cells.end();) {
        std::vector<CellNumber> own;
        for (; next != cells.end() && own.size() < cellsOfRemake; ++next)
            own.push_back(*next);
        const std::vector<std::uint32_t> near = source.triangles.near(own, margin);
        const terrain::GroundMesh part = partOf(whole, near);
        const terrain::SurfaceFeatures features =
            partOf(whole, source.ground.features, near, margin);
        const TileRegion region(whole.origin, own);
        TileResult tile =
            bakeSeededTile({part, features}, source.settings, source.plan, &region, progress);
        for (const CellNumber& cell : own) {
            field::SeedCell bare;
            bare.cell = seedCellOf(whole.origin, cell);
            made[bare.cell] = std::make_shared<const field::SeedCell>(std::move(bare));
        }
        for (std::size_t i = 0; i < tile.seeds.cells.size(); ++i)
            made[tile.seeds.cells[i].cell] = std::make_shared<const field::SeedCell>(
                field::readSeedCell(field::viewOf(tile.seeds), i, "seeds"));
        std::move(tile.cells.begin(), tile.cells.end(), std::back_inserter(change.trees));
    }
    workplace_.reset();
    change.cells.assign(cells.begin(), cells.end());
    for (auto& [number, cell] : made)
        changed_[number] = std::move(cell);
    return change;
}

std::vector<SharedCell> SeedEdits::cells(std::span<const CellNumber> numbers,
                                         const glm::dvec3& origin) const
{
    std::vector<SharedCell> list;
    for (const CellNumber& number : numbers)
        list.push_back(cellAt(seedCellOf(origin, number)));
    return list;
}

field::Seeds SeedEdits::seeds() const
{
    std::vector<SharedCell> cells;
    for (const auto& [number, cell] : changed_)
        if (!cell->pieces.empty())
            cells.push_back(cell);
    std::vector<UninitializedVector<std::byte>> packed(cells.size());
    tbb::parallel_for(std::size_t(0), cells.size(), [&](std::size_t i) {
        packed[i] = field::packSeedCell(*cells[i], baked_.meadow.isMixed);
    });
    field::Seeds all;
    all.meadow = baked_.meadow;
    std::size_t next = 0;
    const auto addChanged = [&] {
        field::addSeedCell(all, field::entryOf(*cells[next]), packed[next]);
        ++next;
    };
    for (const field::SeedEntry& entry : baked_.cells) {
        while (next < cells.size() && cells[next]->cell < entry.cell)
            addChanged();
        if (!changed_.contains(entry.cell))
            field::addSeedCell(
                all, entry,
                std::span<const std::byte>(baked_.data).subspan(entry.offset, entry.bytes));
    }
    while (next < cells.size())
        addChanged();
    return all;
}

} // namespace sward::bake
