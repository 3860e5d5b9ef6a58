#include "render/field/top_tree.h"

#include "core/expect.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace sward::render {
namespace {

constexpr std::uint32_t rootPlace = 0;
constexpr int topShift = 63; ///< a cell this wide contains all

/// Places that a table gains at least.
constexpr std::uint32_t minRoom = 1024;

shared::Patch emptyPatch()
{
    shared::Patch patch = {};
    patch.coneAxis = {0.0f, 1.0f, 0.0f};
    patch.coneCosine = -1.0f;
    patch.parent = shared::noPatch;
    patch.firstChild = shared::noPatch;
    return patch;
}

constexpr shared::Subtree emptySubtree{.blades = 0, .widest = 0.0f, .rankBelow = 1.0f};

field::CellIndex shifted(field::CellIndex cell, int shift)
{
    for (std::int64_t& axis : cell)
        axis >>= shift;
    return cell;
}

/// The cosine of the sum of two angles in [0, π]; −1 from π on.
float cosineOfAngles(float a, float b)
{
    if (a <= -b)
        return -1.0f;
    return a * b - std::sqrt(std::max((1.0f - a * a) * (1.0f - b * b), 0.0f));
}

} // namespace

bool TopTree::Wide::contains(const field::CellIndex& cell) const
{
    return shift == topShift || shifted(cell, shift) == number;
}

TopTree::TopTree(std::size_t cells)
    : top_(static_cast<std::uint32_t>(4 * cells) + minRoom)
{
    patches_.resize(top_, emptyPatch());
    subtrees_.resize(top_, emptySubtree);
    // The root, and the patch that is always empty.
    freeTop_.give({noBlades + 1, top_ - noBlades - 1});
}

std::uint32_t TopTree::find(const field::CellIndex& cell) const
{
    const auto found = placeOf_.find(cell);
    return found == placeOf_.end() ? shared::noPatch : found->second;
}

const field::CellIndex* TopTree::cellAt(std::uint32_t place) const
{
    const auto found = cellAt_.find(place);
    return found == cellAt_.end() ? nullptr : &found->second;
}

void TopTree::own(std::uint32_t place, const field::CellIndex& cell)
{
    cellAt_[place] = cell;
    placeOf_[cell] = place;
}

std::uint32_t TopTree::add(const field::CellIndex& cell)
{
    if (const std::uint32_t known = find(cell); known != shared::noPatch)
        return known;
    std::uint32_t place = rootPlace;
    if (!placeOf_.empty()) {
        // Go down to the smallest wide cell around it.
        for (;;) {
            const auto wide = wide_.find(place);
            if (wide == wide_.end() || !wide->second.contains(cell)) {
                place = split(place, cell);
                break;
            }
            const shared::Patch& patch = patches_[place];
            const field::CellIndex octant = shifted(cell, wide->second.shift - 1);
            std::uint32_t next = shared::noPatch;
            for (std::uint32_t child = patch.firstChild;
                 child < patch.firstChild + patch.childCount; ++child) {
                const auto inner = wide_.find(child);
                const field::CellIndex inside =
                    inner == wide_.end() ? shifted(cellAt_.at(child), wide->second.shift - 1)
                                         : shifted(inner->second.number,
                                                   wide->second.shift - 1 - inner->second.shift);
                if (inside == octant)
                    next = child;
            }
            if (next == shared::noPatch) {
                place = addChild(place);
                break;
            }
            place = next;
        }
    }
    own(place, cell);
    movedFrom_[place] = shared::noPatch;
    change(place);
    stale_.insert(place);
    return place;
}

std::uint32_t TopTree::addChild(std::uint32_t parent)
{
    const PlaceRange former{patches_[parent].firstChild, patches_[parent].childCount};
    const PlaceRange group = takeTop(former.count + 1);
    for (std::uint32_t i = 0; i < former.count; ++i)
        move(former.first + i, group.first + i);
    giveTop(former);
    patches_[parent].firstChild = group.first;
    patches_[parent].childCount = group.count;
    change(parent);
    const std::uint32_t added = group.end() - 1;
    patches_[added] = emptyPatch();
    patches_[added].parent = parent;
    return added;
}

std::uint32_t TopTree::split(std::uint32_t place, const field::CellIndex& cell)
{
    const auto inner = wide_.find(place);
    const Wide low = inner == wide_.end() ? Wide{cellAt_.at(place), 0} : inner->second;
    Wide wide{low.number, low.shift};
    while (!wide.contains(cell)) {
        ++wide.shift;
        wide.number = shifted(low.number, wide.shift - low.shift);
    }
    const PlaceRange group = takeTop(2);
    const std::uint32_t parent = patches_[place].parent;
    move(place, group.first);
    patches_[place] = emptyPatch();
    patches_[place].parent = parent;
    patches_[place].firstChild = group.first;
    patches_[place].childCount = group.count;
    subtrees_[place] = emptySubtree;
    wide_[place] = wide;
    movedFrom_[place] = shared::noPatch;
    change(place);
    patches_[group.first].parent = place;
    const std::uint32_t added = group.first + 1;
    patches_[added] = emptyPatch();
    patches_[added].parent = place;
    return added;
}

void TopTree::move(std::uint32_t from, std::uint32_t to)
{
    patches_[to] = patches_[from];
    subtrees_[to] = subtrees_[from];
    for (std::uint32_t i = 0; i < patches_[to].childCount; ++i)
        patches_[patches_[to].firstChild + i].parent = to;
    if (auto wide = wide_.extract(from); !wide.empty()) {
        wide.key() = to;
        wide_.insert(std::move(wide));
    } else {
        const field::CellIndex cell = cellAt_.at(from);
        cellAt_.erase(from);
        own(to, cell);
    }
    if (stale_.erase(from) > 0)
        stale_.insert(to);
    const std::uint32_t source = before(from);
    movedFrom_.erase(from);
    movedFrom_[to] = source;
    change(to);
}

PlaceRange TopTree::takeTop(std::uint32_t count)
{
    if (const auto range = freeTop_.take(count))
        return *range;
    isMixed_ = true;
    return take(count);
}

void TopTree::giveTop(PlaceRange range)
{
    for (std::uint32_t place = range.first; place < range.end(); ++place) {
        patches_[place] = emptyPatch();
        subtrees_[place] = emptySubtree;
        movedFrom_.erase(place);
        change(place);
    }
    (range.first < top_ ? freeTop_ : freeBelow_).give(range);
}

PlaceRange TopTree::take(std::uint32_t count)
{
    if (count == 0)
        return {};
    if (const auto range = freeBelow_.take(count))
        return *range;
    const auto size = static_cast<std::uint32_t>(patches_.size());
    resize(size + std::max({count, size / 4, minRoom}));
    return *freeBelow_.take(count);
}

void TopTree::resize(std::uint32_t places)
{
    const auto size = static_cast<std::uint32_t>(patches_.size());
    patches_.resize(places, emptyPatch());
    subtrees_.resize(places, emptySubtree);
    freeBelow_.give({size, places - size});
    // What is uploaded has no undefined places.
    for (std::uint32_t place = size; place < places; ++place)
        change(place);
}

void TopTree::give(PlaceRange range)
{
    for (std::uint32_t place = range.first; place < range.end(); ++place) {
        patches_[place] = emptyPatch();
        subtrees_[place] = emptySubtree;
        change(place);
    }
    freeBelow_.give(range);
}

void TopTree::set(std::uint32_t place, const shared::Patch& patch, const shared::Subtree& subtree)
{
    patches_[place] = patch;
    subtrees_[place] = subtree;
    change(place);
    if (cellAt_.contains(place))
        stale_.insert(place);
}

void TopTree::refresh()
{
    std::set<std::pair<int, std::uint32_t>> above; // by shift: children before parents
    for (const std::uint32_t place : stale_)
        for (std::uint32_t node = patches_[place].parent; node != shared::noPatch;
             node = patches_[node].parent)
            if (!above.emplace(wide_.at(node).shift, node).second)
                break;
    stale_.clear();
    for (const auto& [shift, node] : above)
        gather(node);
}

/// A wide patch from its children.
void TopTree::gather(std::uint32_t place)
{
    shared::Patch& patch = patches_[place];
    shared::Subtree subtree = emptySubtree;
    glm::vec3 low = patch.boundsLow;
    glm::vec3 high = patch.boundsHigh;
    glm::vec3 axis(0.0f);
    for (std::uint32_t i = 0; i < patch.childCount; ++i) {
        const shared::Patch& child = patches_[patch.firstChild + i];
        const shared::Subtree& below = subtrees_[patch.firstChild + i];
        if (below.blades == 0)
            continue;
        low = subtree.blades == 0 ? child.boundsLow : glm::min(low, child.boundsLow);
        high = subtree.blades == 0 ? child.boundsHigh : glm::max(high, child.boundsHigh);
        axis += static_cast<float>(below.blades) * child.coneAxis;
        subtree.blades += below.blades;
        subtree.widest = std::max(subtree.widest, below.widest);
        subtree.rankBelow = std::min(
            {subtree.rankBelow, below.rankBelow, child.bladeCount > 0 ? child.rankLow : 1.0f});
    }
    patch.boundsLow = low;
    patch.boundsHigh = high;
    patch.coneAxis = {0.0f, 1.0f, 0.0f};
    patch.coneCosine = -1.0f;
    if (const float length = glm::length(axis);
        length > 1e-3f * float(subtree.blades) && subtree.blades > 0) {
        patch.coneAxis = axis / length;
        float cosine = 1.0f;
        for (std::uint32_t i = 0; i < patch.childCount; ++i)
            if (subtrees_[patch.firstChild + i].blades > 0) {
                const shared::Patch& child = patches_[patch.firstChild + i];
                const float between =
                    std::clamp(glm::dot(patch.coneAxis, child.coneAxis), -1.0f, 1.0f);
                cosine = std::min(cosine, cosineOfAngles(between, child.coneCosine));
            }
        patch.coneCosine = std::max(cosine - 1e-5f, -1.0f);
    }
    subtrees_[place] = subtree;
    change(place);
}

std::vector<PlaceRange> TopTree::takeChanged()
{
    std::vector<PlaceRange> ranges;
    for (const std::uint32_t place : changed_) {
        if (ranges.empty() || ranges.back().end() != place)
            ranges.push_back({place, 0});
        ++ranges.back().count;
    }
    changed_.clear();
    return ranges;
}

std::vector<shared::PatchSource> TopTree::moved() const
{
    std::vector<shared::PatchSource> moved;
    for (const auto& [to, from] : movedFrom_)
        moved.push_back({.patchIndex = to, .from = from, .keepsCount = from != shared::noPatch});
    return moved;
}

std::uint32_t TopTree::before(std::uint32_t place) const
{
    const auto found = movedFrom_.find(place);
    return found == movedFrom_.end() ? place : found->second;
}

std::uint32_t TopTree::usedEnd() const
{
    const auto size = static_cast<std::uint32_t>(patches_.size());
    const std::uint32_t end = size == top_ ? top_ : freeBelow_.usedEnd(size);
    return end == top_ ? topEnd() : end;
}

std::uint32_t TopTree::topEnd() const
{
    return freeTop_.usedEnd(top_);
}

} // namespace sward::render
