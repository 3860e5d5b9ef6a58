#include "bake/seeds/grow_field.h"

#include "bake/patches/patch_tree.h"
#include "bake/settings/threads.h"
#include "core/error.h"
#include "core/math/spread_bits.h"
#include "field/seeds/sow_unit.h"

#include <glm/common.hpp>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <map>
#include <utility>

namespace sward::bake {
namespace {

// A cell of the octree inside of a 32 m cell.
struct OctreeCell {
    std::vector<std::uint32_t> parts; // sown patches, in order of rank
    std::vector<std::uint64_t> children;
};

constexpr std::uint32_t levelShift = 56;
constexpr std::uint64_t mortonMask = (1ULL << levelShift) - 1;

std::uint64_t octreeKey(const field::SownPatch& patch)
{
    return std::uint64_t(patch.level) << levelShift |
           mortonCode(patch.place[0], patch.place[1], patch.place[2]);
}

// Lays the patches of a sown cell out level by level. An octree cell with several patches has them
// one below the other. One without blades of its own gets the first patch of those below it, by
// rank, so that every patch has blades.
class CellLayout {
public:
    CellLayout(const field::SownCell& sown, const field::Sower& sower,
               std::span<const field::Species> species, const CellNumber& cell, double widening)
        : sown_(sown)
        , sower_(sower)
        , species_(species)
        , widening_(widening)
    {
        tree_.cell = cell;
        for (std::uint32_t i = 0; i < sown.patches.size(); ++i)
            cellAt(octreeKey(sown.patches[i])).parts.push_back(i);
        // Finer cells have greater keys.
        for (auto one = cells_.rbegin(); one != cells_.rend(); ++one)
            fill(one->second);
    }

    CellTree build()
    {
        layOut();
        describe();
        return std::move(tree_);
    }

private:
    // Also makes the cells around it.
    OctreeCell& cellAt(std::uint64_t key)
    {
        const auto [found, isNew] = cells_.try_emplace(key);
        if (isNew && key >> levelShift != 0) {
            const std::uint64_t parent =
                ((key >> levelShift) - 1) << levelShift | (key & mortonMask) >> 3U;
            cellAt(parent).children.push_back(key);
        }
        return found->second;
    }

    float firstRank(std::uint64_t key) const
    {
        return sown_.patches[cells_.at(key).parts.front()].rankLow;
    }

    // Cells below it have patches.
    void fill(OctreeCell& cell)
    {
        if (!cell.parts.empty())
            return;
        const auto child = std::min_element(
            cell.children.begin(), cell.children.end(), [&](std::uint64_t a, std::uint64_t b) {
                return std::pair(firstRank(a), a) < std::pair(firstRank(b), b);
            });
        OctreeCell& below = cells_.at(*child);
        cell.parts.push_back(below.parts.front());
        below.parts.erase(below.parts.begin());
        if (below.parts.empty() && below.children.empty())
            cell.children.erase(child);
        else
            fill(below);
    }

    void layOut()
    {
        struct Pending {
            std::uint64_t key;
            std::uint32_t part;
            std::uint32_t parent;
            std::uint32_t depth;
        };
        std::deque<Pending> queue{{0, 0, shared::noPatch, 0}};
        std::uint32_t nextChild = 1;
        tree_.blades.reserve(sown_.blades.size());
        tree_.keys.reserve(sown_.keys.size());
        while (!queue.empty()) {
            const Pending pending = queue.front();
            queue.pop_front();
            OctreeCell& cell = cells_.at(pending.key);
            const auto index = static_cast<std::uint32_t>(tree_.patches.size());
            const field::SownPatch& own = sown_.patches[cell.parts[pending.part]];
            shared::Patch patch = sower_.unpackingOf(sown_, own);
            patch.widthStep *= static_cast<float>(widening_);
            const auto from = static_cast<std::ptrdiff_t>(own.first);
            const auto to = from + static_cast<std::ptrdiff_t>(own.count);
            patch.firstBlade = static_cast<std::uint32_t>(tree_.blades.size());
            tree_.blades.insert(tree_.blades.end(), sown_.blades.begin() + from,
                                sown_.blades.begin() + to);
            tree_.keys.insert(tree_.keys.end(), sown_.keys.begin() + from, sown_.keys.begin() + to);
            patch.parent = pending.parent;
            patch.level = pending.depth;
            if (pending.part + 1 < cell.parts.size()) {
                queue.push_back({pending.key, pending.part + 1, index, pending.depth + 1});
                patch.childCount = 1;
            } else {
                std::sort(cell.children.begin(), cell.children.end());
                for (const std::uint64_t child : cell.children)
                    queue.push_back({child, 0, index, pending.depth + 1});
                patch.childCount = static_cast<std::uint32_t>(cell.children.size());
            }
            patch.firstChild = patch.childCount == 0 ? shared::noPatch : nextChild;
            nextChild += patch.childCount;
            tree_.patches.push_back(patch);
        }
    }

    // Bounds and cones, from the leaves upwards.
    void describe()
    {
        std::vector<SubtreeDescription> subtrees(tree_.patches.size());
        std::vector<GrownBlade> grown;
        for (std::size_t i = tree_.patches.size(); i-- > 0;) {
            shared::Patch& patch = tree_.patches[i];
            grown.clear();
            field::addGrown(species_,
                            std::span(tree_.blades).subspan(patch.firstBlade, patch.bladeCount),
                            patch, grown);
            subtrees[i].addOwn(grown);
            tree_.summary = subtrees[i].finish(patch);
            subtrees[i] = {};
            if (i > 0)
                subtrees[patch.parent].addChild(tree_.summary);
        }
    }

    const field::SownCell& sown_;
    const field::Sower& sower_;
    std::span<const field::Species> species_;
    double widening_;
    std::map<std::uint64_t, OctreeCell> cells_;
    CellTree tree_;
};

} // namespace

CellGrower::CellGrower(const field::SeedMeadow& meadow, std::span<const field::Species> species,
                       const glm::dvec3& origin, const Growth& growth)
    : sower_(meadow, species, origin)
    , species_(species)
    , growth_(growth)
    , firstCell_(glm::floor(origin / widestPatch))
{
}

CellTree CellGrower::grow(const field::SeedCell& cell, const std::string& place) const
{
    const field::SownCell sown = sower_.sow(cell, growth_.region);
    if ((blades_ += sown.blades.size()) > growth_.maxBlades)
        fail(ErrorKind::input, "{}: more than --max-blades {} grow in this region", place,
             growth_.maxBlades);
    if (sown.blades.empty())
        return {};
    CellNumber number;
    for (std::size_t axis = 0; axis < 3; ++axis)
        number[axis] = static_cast<std::int64_t>(firstCell_[glm::length_t(axis)]) + sown.cell[axis];
    return CellLayout(sown, sower_, species_, number, growth_.widening).build();
}

std::vector<CellTree> growSeeds(const field::SeedsView& seeds,
                                std::span<const field::Species> species, const glm::dvec3& origin,
                                const Growth& growth, const std::string& place, Progress& progress)
{
    const CellGrower grower(*seeds.meadow, species, origin, growth);
    std::vector<std::size_t> touched;
    for (std::size_t i = 0; i < seeds.cells.size(); ++i)
        if (growth.region.mayTouch(seeds.cells[i].cell))
            touched.push_back(i);
    std::vector<CellTree> trees(touched.size());
    progress.begin("grow", touched.size());
    tbb::parallel_for(std::size_t(0), touched.size(), [&](std::size_t i) {
        progress.throwIfCancelled();
        trees[i] = grower.grow(field::readSeedCell(seeds, touched[i], place), place);
        progress.advance(1);
    });
    std::erase_if(trees, [](const CellTree& tree) { return tree.blades.empty(); });
    return trees;
}

namespace {

bool isEverywhere(const field::SowRegion& region)
{
    bool holdsAll = !(region.radius < field::SowRegion::unbounded);
    for (glm::length_t axis = 0; axis < 3; ++axis)
        holdsAll = holdsAll && !(region.low[axis] > -field::SowRegion::unbounded) &&
                   !(region.high[axis] < field::SowRegion::unbounded);
    return holdsAll;
}

// The stored blades tell how many grow everywhere, before any does.
void refuseTooMany(const field::FieldView& seeded, const Growth& growth, const std::string& place)
{
    constexpr double surely = 1.1;
    const double stored = seeded.seeds->meadow->stored;
    if (!isEverywhere(growth.region) || stored <= 0.0 || seeded.blades.size() < 10'000)
        return;
    const double all = double(seeded.blades.size()) / stored * double(growth.region.share);
    if (all > surely * double(growth.maxBlades))
        fail(ErrorKind::input,
             "{}: about {:.3g} blades grow everywhere, more than --max-blades {}; --around, "
             "--region or a smaller --share grows fewer",
             place, all, growth.maxBlades);
}

} // namespace

field::Field growField(const field::FieldView& seeded, const Growth& growth, int threads,
                       const std::string& place, Progress& progress)
{
    requireUsage(seeded.seeds != nullptr, "{}: the field has no seeds; bake it with --seeds always",
                 place);
    refuseTooMany(seeded, growth, place);
    field::Field grown;
    grown.origin = seeded.origin;
    grown.species.assign(seeded.species.begin(), seeded.species.end());
    grown.ground = *seeded.ground;
    grown.defaults = *seeded.defaults;
    grown.provenance = *seeded.provenance;
    grown.copyright = *seeded.copyright;
    withThreads(threadCount(threads), [&] {
        joinCells(growSeeds(*seeded.seeds, seeded.species, seeded.origin, growth, place, progress),
                  grown);
    });
    return grown;
}

} // namespace sward::bake
