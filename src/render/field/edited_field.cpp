#include "render/field/edited_field.h"

#include "core/error.h"
#include "field/verify.h"
#include "render/field/key_table.h"
#include "render/field/patch_tree.h"
#include "shaders/shared/passes.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <utility>

namespace sward::render {
namespace {

constexpr std::uint32_t stride = shared::nonEmptyPatchStride;

std::uint32_t stridesOf(std::size_t blades)
{
    return static_cast<std::uint32_t>((blades + stride - 1) / stride);
}

/// A table of `size` places after it has become too small for `more`.
std::uint32_t grown(std::uint32_t size, std::uint32_t more)
{
    constexpr std::uint32_t minRoom = 1024;
    return size + std::max({more, size / 4, minRoom});
}

/// Levels of a cell's patches.
std::uint32_t levelsOf(std::span<const shared::Patch> patches)
{
    std::vector<std::uint32_t> level(patches.size(), 1);
    std::uint32_t levels = 0;
    for (std::size_t p = 0; p < patches.size(); ++p) {
        if (p > 0)
            level[p] = level[patches[p].parent] + 1;
        levels = std::max(levels, level[p]);
    }
    return levels;
}

/// Throws Error{input} that names the cell unless all indices have a target.
void checkCell(const field::CellChange& change)
{
    const std::string place = fmt::format("the change of the 32 m cell ({}, {}, {})",
                                          change.cell[0], change.cell[1], change.cell[2]);
    if (change.keys.size() != change.blades.size())
        fail(ErrorKind::input, "{}: {} keys for {} blades", place, change.keys.size(),
             change.blades.size());
    field::verifyTree(change.patches, change.blades.size(), place);
    if (levelsOf(change.patches) > EditedField::maxCellLevels)
        fail(ErrorKind::input, "{}: its patches have more than {} levels", place,
             EditedField::maxCellLevels);
}

} // namespace

void checkDelta(const field::Delta& delta, const glm::dvec3& origin)
{
    if (delta.origin != origin)
        fail(ErrorKind::input,
             "a change of a field with the origin ({}, {}, {}); that of this one is ({}, {}, {})",
             delta.origin.x, delta.origin.y, delta.origin.z, origin.x, origin.y, origin.z);
    for (const field::CellChange& change : delta.cells) {
        checkCell(change);
        if (&change != delta.cells.data() && !((&change - 1)->cell < change.cell))
            fail(ErrorKind::input, "the changed cells are not sorted: ({}, {}, {})", change.cell[0],
                 change.cell[1], change.cell[2]);
    }
}

EditedField::EditedField(const field::FieldView& field, std::uint32_t walkStart,
                         std::uint32_t maxBlades)
    : origin_(field.origin)
    , walkStart_(walkStart)
    , maxBlades_(maxBlades)
    , top_(field::cellsOf(field).size())
{
    requireUsage(field.keys.size() == field.blades.size(), "an editable field has keys");
    field::Delta whole{.origin = field.origin, .cells = {}, .storage = {}};
    for (const field::FieldCell& cell : field::cellsOf(field)) {
        const field::CellContent content = field::contentOf(field, cell);
        whole.cells = {{cell.cell, content.patches, content.blades, content.keys}};
        apply(whole);
    }
}

Edit EditedField::apply(const field::Delta& delta)
{
    check(delta);
    Edit edit;
    for (const field::CellChange& change : delta.cells)
        if (!change.patches.empty())
            top_.add(change.cell);
    std::map<std::uint32_t, shared::PatchSource> times;
    for (const shared::PatchSource& moved : top_.moved()) {
        times[moved.patchIndex] = moved;
        followMove(moved, edit);
    }
    std::vector<Cell> former;
    for (const field::CellChange& change : delta.cells) {
        if (top_.find(change.cell) == shared::noPatch)
            continue;
        Cell& cell = cells_[change.cell];
        former.push_back(std::exchange(cell, Cell{}));
        cell.keys.assign(change.keys.begin(), change.keys.end());
        cell.below = top_.take(
            static_cast<std::uint32_t>(std::max<std::size_t>(change.patches.size(), 1) - 1));
        cell.blades = takeBlades(static_cast<std::uint32_t>(change.blades.size()));
        const std::size_t first = edit.sources.size();
        addSources(change, former.back(), edit);
        for (const shared::Patch& patch : change.patches) {
            const auto index = static_cast<std::uint32_t>(&patch - change.patches.data());
            const std::uint32_t place = slotOf(top_.find(change.cell), cell, index);
            shared::PatchSource& time = times[place];
            time = {.patchIndex = place, .from = shared::noPatch, .keepsCount = 0};
            for (std::uint32_t i = 0; i < patch.bladeCount && time.from == shared::noPatch; ++i)
                time.from = edit.sources[first + patch.firstBlade + i].fromPatch;
        }
        forgetPatches(change.cell, former.back());
        putPatches(change, cell);
        putEntries(change, cell, edit);
        if (!change.blades.empty())
            edit.blades.push_back({cell.blades.first, change.blades});
        bladeCount_ += static_cast<std::uint32_t>(change.blades.size());
    }
    // What is freed now is used from the next edit on: states move from it to new places.
    for (const Cell& cell : former)
        free(cell, edit);
    top_.refresh();
    top_.clearMoved();
    edit.patches = top_.takeChanged();
    for (const auto& [place, time] : times)
        edit.times.push_back(time);
    edit.entries = united(std::move(edit.entries));
    edit.firstEntries = united(std::move(edit.firstEntries));
    return edit;
}

/// The entry of a cell's own patch names its new place.
void EditedField::followMove(const shared::PatchSource& moved, Edit& edit)
{
    const field::CellIndex* const cell = top_.cellAt(moved.patchIndex);
    if (cell == nullptr || top_.patches()[moved.patchIndex].bladeCount == 0)
        return;
    const std::uint32_t entry = cells_.at(*cell).entries.first;
    entries_[entry] = moved.patchIndex;
    edit.entries.push_back({entry, 1});
}

void EditedField::check(const field::Delta& delta) const
{
    checkDelta(delta, origin_);
    std::uint64_t places = bladeRoom();
    for (const field::CellChange& change : delta.cells)
        places += std::uint64_t(stridesOf(change.blades.size())) * stride;
    if (places > maxBlades_)
        fail(ErrorKind::unsupported, "the changed field needs {} places of blades; there are {}",
             places, maxBlades_);
}

std::uint32_t EditedField::slotOf(std::uint32_t own, const Cell& cell, std::uint32_t patch)
{
    return patch == 0 ? own : cell.below.first + patch - 1;
}

/// Finds for each new blade the former one of the same key. Ribbons share the key of their stalk,
/// which they follow.
void EditedField::addSources(const field::CellChange& change, const Cell& former, Edit& edit) const
{
    const std::uint32_t own = top_.find(change.cell);
    const KeyTable known(former.keys);
    // The patch of each former blade.
    std::vector<std::uint32_t> patchOf(former.keys.size());
    for (std::uint32_t p = 0; p <= former.below.count; ++p) {
        const shared::Patch& patch = top_.patches()[slotOf(own, former, p)];
        for (std::uint32_t i = 0; i < patch.bladeCount; ++i)
            patchOf[patch.firstBlade - former.blades.first + i] = slotOf(own, former, p);
    }
    const Cell& now = cells_.at(change.cell);
    std::uint32_t repeated = 0;
    for (std::uint32_t i = 0; i < change.keys.size(); ++i) {
        repeated = i > 0 && sameKey(change.keys[i], change.keys[i - 1]) ? repeated + 1 : 0;
        shared::BladeSource source{.place = now.blades.first + i,
                                   .from = shared::noSource,
                                   .fromPatch = shared::noPatch,
                                   .indexInPatch = 0};
        if (const std::uint32_t from = known.find(change.keys[i], repeated);
            from != shared::noSource) {
            source.from = former.blades.first + from;
            source.fromPatch = top_.before(patchOf[from]);
            source.indexInPatch = source.from - top_.patches()[patchOf[from]].firstBlade;
        }
        edit.sources.push_back(source);
    }
}

void EditedField::forgetPatches(const field::CellIndex& index, const Cell& cell)
{
    bladeCount_ -= static_cast<std::uint32_t>(cell.keys.size());
    for (std::uint32_t p = 0; p <= cell.below.count; ++p)
        if (const std::uint32_t blades =
                top_.patches()[slotOf(top_.find(index), cell, p)].bladeCount;
            blades > 0) {
            sizes_.remove(blades);
            --nonEmptyPatches_;
        }
}

void EditedField::putPatches(const field::CellChange& change, const Cell& cell)
{
    const std::uint32_t own = top_.find(change.cell);
    if (change.patches.empty()) {
        // Its bounds stay.
        shared::Patch bare = top_.patches()[own];
        bare.bladeCount = 0;
        bare.childCount = 0;
        bare.firstChild = shared::noPatch;
        top_.set(own, bare, {.blades = 0, .widest = 0.0f, .rankBelow = 1.0f});
        return;
    }
    const std::vector<shared::Subtree> subtrees = subtreesOf(change.patches);
    const std::uint32_t parent = top_.patches()[own].parent;
    for (std::uint32_t p = 0; p < change.patches.size(); ++p) {
        shared::Patch patch = change.patches[p];
        patch.firstBlade += cell.blades.first;
        patch.parent = p == 0 ? parent : slotOf(own, cell, patch.parent);
        if (patch.childCount > 0)
            patch.firstChild = slotOf(own, cell, patch.firstChild);
        top_.set(slotOf(own, cell, p), patch, subtrees[p]);
        if (patch.bladeCount > 0) {
            sizes_.add(patch.bladeCount);
            ++nonEmptyPatches_;
        }
    }
    levels_ = std::max(levels_, levelsOf(change.patches));
}

void EditedField::putEntries(const field::CellChange& change, Cell& cell, Edit& edit)
{
    std::vector<std::uint32_t> patches;
    for (std::uint32_t p = 0; p < change.patches.size(); ++p)
        if (change.patches[p].bladeCount > 0)
            patches.push_back(p);
    if (patches.empty())
        return;
    const auto count = static_cast<std::uint32_t>(patches.size());
    std::optional<PlaceRange> range = freeEntries_.take(count);
    if (!range) {
        const auto size = static_cast<std::uint32_t>(entries_.size());
        entries_.resize(grown(size, count), TopTree::noBlades);
        const PlaceRange more{size, static_cast<std::uint32_t>(entries_.size()) - size};
        freeEntries_.give(more);
        edit.entries.push_back(more);
        range = freeEntries_.take(count);
    }
    cell.entries = *range;
    edit.entries.push_back(*range);
    const std::uint32_t own = top_.find(change.cell);
    for (std::uint32_t i = 0; i < count; ++i)
        entries_[range->first + i] = slotOf(own, cell, patches[i]);

    // A search for the blade at a place begins with the first patch that ends behind it.
    std::uint32_t place = 0;
    const PlaceRange strides{cell.blades.first / stride, cell.blades.count / stride};
    for (std::uint32_t i = 0; i < strides.count; ++i) {
        const auto end = [&] {
            const shared::Patch& patch = change.patches[patches[place]];
            return patch.firstBlade + patch.bladeCount;
        };
        while (end() <= i * stride)
            ++place;
        firstEntries_[strides.first + i] = range->first + place;
    }
    edit.firstEntries.push_back(strides);
}

PlaceRange EditedField::takeBlades(std::uint32_t count)
{
    if (count == 0)
        return {};
    const std::uint32_t strides = stridesOf(count);
    std::optional<PlaceRange> range = freeStrides_.take(strides);
    if (!range) {
        const auto size = static_cast<std::uint32_t>(firstEntries_.size());
        const std::uint32_t room =
            std::max(std::min(grown(size, strides), maxBlades_ / stride), size + strides);
        firstEntries_.resize(room, 0);
        freeStrides_.give({size, room - size});
        range = freeStrides_.take(strides);
    }
    return {range->first * stride, range->count * stride};
}

void EditedField::free(const Cell& cell, Edit& edit)
{
    top_.give(cell.below);
    freeStrides_.give({cell.blades.first / stride, cell.blades.count / stride});
    for (std::uint32_t place = cell.entries.first; place < cell.entries.end(); ++place)
        entries_[place] = TopTree::noBlades;
    if (cell.entries.count > 0)
        edit.entries.push_back(cell.entries);
    freeEntries_.give(cell.entries);
}

std::uint32_t EditedField::entryEnd() const
{
    return freeEntries_.usedEnd(static_cast<std::uint32_t>(entries_.size()));
}

std::uint32_t EditedField::bladeRoom() const
{
    return static_cast<std::uint32_t>(firstEntries_.size()) * stride;
}

bool EditedField::walksLevels() const
{
    return !top_.isMixed() && top_.usedEnd() > walkStart_;
}

FieldTables EditedField::tables() const
{
    return {.patches = patches(),
            .subtrees = subtrees(),
            .entries = entries(),
            .firstEntries = firstEntries(),
            .entryEnd = entryEnd(),
            .bladeCount = bladeCount(),
            .bladeRoom = bladeRoom(),
            .nonEmptyPatches = nonEmptyPatches_,
            .sizes = &sizes_,
            .walkStarts = walkStarts(),
            .walkSteps = walkSteps(),
            .maxWalkSteps = maxCellLevels + 1};
}

std::uint32_t EditedField::walkStarts() const
{
    return walksLevels() ? top_.topEnd() : top_.usedEnd();
}

std::uint32_t EditedField::walkSteps() const
{
    return walksLevels() ? std::max(levels_, 1u) : 1;
}

std::vector<std::uint32_t> EditedField::placesOf(const field::FieldView& field) const
{
    std::vector<std::uint32_t> places(field.blades.size());
    for (const field::FieldCell& cell : field::cellsOf(field)) {
        const auto known = cells_.find(cell.cell);
        requireUsage(known != cells_.end() && cell.patches.size() == known->second.below.count + 1,
                     "the renderer's field has other patches in the 32 m cell ({}, {}, {})",
                     cell.cell[0], cell.cell[1], cell.cell[2]);
        const std::uint32_t own = top_.find(cell.cell);
        for (std::uint32_t p = 0; p < cell.patches.size(); ++p) {
            const shared::Patch& wanted = field.patches[cell.patches[p]];
            const shared::Patch& patch = top_.patches()[slotOf(own, known->second, p)];
            requireUsage(wanted.bladeCount == patch.bladeCount,
                         "patch {} has {} blades; that of the renderer {}", cell.patches[p],
                         wanted.bladeCount, patch.bladeCount);
            for (std::uint32_t i = 0; i < patch.bladeCount; ++i)
                places[wanted.firstBlade + i] = patch.firstBlade + i;
        }
    }
    return places;
}

std::vector<shared::PackedBlade> EditedField::placed(const field::FieldView& field) const
{
    std::vector<shared::PackedBlade> blades(bladeRoom());
    const std::vector<std::uint32_t> places = placesOf(field);
    for (std::size_t i = 0; i < places.size(); ++i)
        blades[places[i]] = field.blades[i];
    return blades;
}

} // namespace sward::render
