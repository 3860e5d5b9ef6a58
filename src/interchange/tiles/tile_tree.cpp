#include "interchange/tiles/tile_tree.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>

namespace sward::interchange {
namespace {

// Cells of the patch tree, and so cubes of tiles, lie on multiples of this [m].
constexpr double cellSize = 32.0;

// The part of a tile that a place lies in: one bit for each axis.
std::size_t partOf(const glm::dvec3& place, const glm::dvec3& middle)
{
    return (place.x >= middle.x ? 1U : 0U) | (place.y >= middle.y ? 2U : 0U) |
           (place.z >= middle.z ? 4U : 0U);
}

// A box that holds the roots of a patch's own blades.
DAabb rootsOf(const shared::Patch& patch)
{
    const glm::vec3 high = glm::min(patch.rootLow + 65535.0f * patch.rootStep, patch.boundsHigh);
    DAabb box;
    box.add(glm::dvec3(patch.rootLow));
    box.add(glm::dvec3(glm::max(high, patch.rootLow)));
    return box;
}

float rankOf(const shared::Patch& patch, std::size_t number)
{
    return patch.rankLow +
           (patch.rankHigh - patch.rankLow) * (float(number) + 0.5f) / float(patch.bladeCount);
}

} // namespace

glm::dvec3 tilePlace(const glm::dvec3& place)
{
    return {place.x, -place.z, place.y};
}

glm::dvec3 fieldPlace(const glm::dvec3& place)
{
    return {place.x, place.z, -place.y};
}

DAabb rootBounds(const field::FieldView& field)
{
    DAabb bounds;
    for (const shared::Patch& patch : field.patches)
        if (patch.bladeCount > 0)
            bounds.add(rootsOf(patch));
    return bounds;
}

TileTree::TileTree(const field::FieldView& field, const EarthBend* bend)
    : field_(field)
    , bend_(bend)
    , own_(field.patches.size())
    , below_(field.patches.size())
    , counts_(field.patches.size())
{
    for (std::size_t p = field.patches.size(); p-- > 0;) {
        const shared::Patch& patch = field.patches[p];
        if (patch.bladeCount > 0) {
            own_[p] = boxOf(patch);
            below_[p].add(own_[p]);
        }
        counts_[p] += patch.bladeCount;
        if (p > 0 && !below_[p].isEmpty()) {
            below_[patch.parent].add(below_[p]);
            counts_[patch.parent] += counts_[p];
        }
    }
}

glm::dvec3 TileTree::placeOf(const glm::vec3& root) const
{
    const glm::dvec3 place(root);
    return tilePlace(bend_ != nullptr ? bend_->moved(place) : place);
}

DAabb TileTree::boxOf(const shared::Patch& patch) const
{
    const DAabb flat = rootsOf(patch);
    const DAabb bent = bend_ != nullptr ? bend_->moved(flat) : flat;
    DAabb box;
    box.add(tilePlace(bent.low));
    box.add(tilePlace(bent.high));
    return box;
}

Tile TileTree::root() const
{
    Tile tile;
    tile.size = cellSize;
    if (below_.empty() || below_[0].isEmpty())
        return tile;
    tile.low = glm::floor(below_[0].low / cellSize) * cellSize;
    const glm::dvec3 extent = below_[0].high - tile.low;
    while (tile.size <= std::max({extent.x, extent.y, extent.z}))
        tile.size *= 2.0;
    tile.subtrees.push_back(0);
    return tile;
}

bool TileTree::holds(const Tile& tile, std::size_t blade, const shared::Patch& patch) const
{
    const glm::dvec3 place =
        placeOf(shared::unpackBlade(field_.blades[blade], patch).root) - tile.low;
    return place.x >= 0.0 && place.y >= 0.0 && place.z >= 0.0 && place.x < tile.size &&
           place.y < tile.size && place.z < tile.size;
}

std::uint64_t TileTree::bladesIn(const Tile& tile) const
{
    std::uint64_t count = 0;
    for (const std::uint32_t p : tile.subtrees)
        count += counts_[p];
    for (const std::uint32_t p : tile.partial) {
        const shared::Patch& patch = field_.patches[p];
        for (std::size_t i = 0; i < patch.bladeCount; ++i)
            if (holds(tile, patch.firstBlade + i, patch))
                ++count;
    }
    return count;
}

// A patch belongs to a part with all below it, or its own blades are shared out among the parts and
// its children are looked at one by one.
void TileTree::distribute(std::uint32_t p, std::array<Tile, 8>& parts,
                          const glm::dvec3& middle) const
{
    if (below_[p].isEmpty())
        return;
    const std::size_t first = partOf(below_[p].low, middle);
    if (first == partOf(below_[p].high, middle)) {
        parts[first].subtrees.push_back(p);
        return;
    }
    const shared::Patch& patch = field_.patches[p];
    if (patch.bladeCount > 0) {
        const std::size_t low = partOf(own_[p].low, middle);
        const std::size_t high = partOf(own_[p].high, middle);
        for (std::size_t part = 0; part < parts.size(); ++part)
            if ((part & low) == low && (part | high) == high)
                parts[part].partial.push_back(p);
    }
    for (std::uint32_t child = 0; child < patch.childCount; ++child)
        distribute(patch.firstChild + child, parts, middle);
}

std::vector<Tile> TileTree::childrenOf(const Tile& tile) const
{
    const double half = 0.5 * tile.size;
    const glm::dvec3 middle = tile.low + half;
    std::array<Tile, 8> parts;
    for (std::size_t part = 0; part < parts.size(); ++part) {
        parts[part].number.level = tile.number.level + 1;
        parts[part].size = half;
        parts[part].low = tile.low;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto bit = static_cast<std::uint32_t>(part >> axis & 1U);
            parts[part].number.at[axis] = 2 * tile.number.at[axis] + bit;
            parts[part].low[static_cast<int>(axis)] += bit != 0 ? half : 0.0;
        }
    }
    for (const std::uint32_t p : tile.subtrees)
        distribute(p, parts, middle);
    for (const std::uint32_t p : tile.partial) {
        const std::size_t low = partOf(own_[p].low, middle);
        const std::size_t high = partOf(own_[p].high, middle);
        for (std::size_t part = 0; part < parts.size(); ++part)
            if ((part & low) == low && (part | high) == high)
                parts[part].partial.push_back(p);
    }
    std::vector<Tile> children;
    for (Tile& part : parts)
        if (!part.subtrees.empty() || !part.partial.empty())
            children.push_back(std::move(part));
    return children;
}

void TileTree::addOwn(const Tile& tile, std::uint32_t p, bool isWhole, float share,
                      const glm::dvec3& place, const std::string& source,
                      std::vector<Instance>& instances) const
{
    const shared::Patch& patch = field_.patches[p];
    for (std::size_t i = 0; i < patch.bladeCount && rankOf(patch, i) < share; ++i) {
        const std::size_t blade = patch.firstBlade + i;
        if (field_.isRibbon(blade) || (!isWhole && !holds(tile, blade, patch)))
            continue;
        Instance& instance = instances.emplace_back(instanceOf(field_, p, blade, place, source));
        if (bend_ == nullptr)
            continue;
        const glm::dvec3 root(instance.blade.root);
        instance.place = glm::vec3(bend_->moved(root) - place);
        instance.rotation = glm::quat(bend_->turn(root)) * instance.rotation;
    }
}

void TileTree::addSubtree(const Tile& tile, std::uint32_t p, float share, const glm::dvec3& place,
                          const std::string& source, std::vector<Instance>& instances) const
{
    const shared::Patch& patch = field_.patches[p];
    // Patches below have higher ranks.
    if (patch.bladeCount > 0 && patch.rankLow >= share)
        return;
    addOwn(tile, p, true, share, place, source, instances);
    for (std::uint32_t child = 0; child < patch.childCount; ++child)
        addSubtree(tile, patch.firstChild + child, share, place, source, instances);
}

std::vector<Instance> TileTree::instancesIn(const Tile& tile, float share, const glm::dvec3& place,
                                            const std::string& source) const
{
    std::vector<Instance> instances;
    for (const std::uint32_t p : tile.partial)
        addOwn(tile, p, false, share, place, source, instances);
    for (const std::uint32_t p : tile.subtrees)
        addSubtree(tile, p, share, place, source, instances);
    return instances;
}

} // namespace sward::interchange
