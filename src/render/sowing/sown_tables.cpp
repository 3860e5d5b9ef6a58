#include "render/sowing/sown_tables.h"

#include "core/expect.h"
#include "render/field/patch_tree.h"
#include "shaders/shared/passes.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace sward::render {
namespace {

constexpr std::uint32_t placesTogether = shared::nonEmptyPatchStride;

/// Blades of a sown patch and of a unit, for the size of tables: fewer need more patches.
constexpr std::uint64_t bladesOfPatch = 160;
constexpr std::uint64_t bladesOfUnit = 4096;
constexpr std::uint32_t minUnits = 1024;

std::uint32_t sownStrides(std::size_t blades)
{
    return static_cast<std::uint32_t>((blades + placesTogether - 1) / placesTogether);
}

shared::Patch bareRoot()
{
    shared::Patch patch = {};
    patch.parent = shared::noPatch;
    patch.firstChild = shared::noPatch;
    patch.coneCosine = -1.0f;
    return patch;
}

constexpr shared::Subtree bareBelow{.blades = 0, .widest = 0.0f, .rankBelow = 1.0f};

/// Number of the first patches of a tree that together make whole levels, at most `most` or all.
std::uint32_t firstLevels(std::span<const shared::Patch> patches, std::uint32_t most,
                          std::uint32_t& levelsBelow)
{
    std::uint32_t count = 0;
    levelsBelow = 0;
    std::uint32_t level = 0;
    for (std::uint32_t p = 0; p < patches.size(); ++p) {
        if (patches[p].level == level)
            continue;
        level = patches[p].level;
        if (p <= most) {
            count = p;
            levelsBelow = 0;
        }
        ++levelsBelow;
    }
    if (patches.size() <= most || count == 0) {
        levelsBelow = 0;
        return static_cast<std::uint32_t>(patches.size());
    }
    return count;
}

} // namespace

SownTables::Room SownTables::Room::of(std::uint64_t blades)
{
    return {.blades = static_cast<std::uint32_t>(blades),
            .patches = static_cast<std::uint32_t>(blades / bladesOfPatch) + minUnits,
            .units = static_cast<std::uint32_t>(blades / bladesOfUnit) + minUnits};
}

SownTables::SownTables(const field::FieldView& stored, const Room& room, std::uint32_t walkStart)
    : unitRoots_(room.units)
    , patchRoom_(room.patches)
    , storedBlades_(static_cast<std::uint32_t>(stored.blades.size()))
{
    const std::uint32_t shift = firstStored();
    const auto storedCount = static_cast<std::uint32_t>(stored.patches.size());
    patches_.assign(std::size_t(shift) + storedCount + room.patches, bareRoot());
    subtrees_.assign(patches_.size(), bareBelow);
    const std::vector<shared::Subtree> subtrees = subtreesOf(stored.patches);
    std::copy(subtrees.begin(), subtrees.end(), subtrees_.begin() + shift);
    std::vector<std::uint32_t> ofBlades;
    for (std::uint32_t p = 0; p < storedCount; ++p) {
        shared::Patch& patch = patches_[shift + p];
        patch = stored.patches[p];
        if (patch.parent != shared::noPatch)
            patch.parent += shift;
        if (patch.firstChild != shared::noPatch)
            patch.firstChild += shift;
        if (patch.bladeCount > 0)
            ofBlades.push_back(shift + p);
    }
    std::ranges::sort(ofBlades, {}, [&](std::uint32_t p) { return patches_[p].firstBlade; });
    storedNonEmpty_ = static_cast<std::uint32_t>(ofBlades.size());

    // A search for the blade at a place begins with the first patch that ends behind it.
    const std::uint32_t storedStrides = sownStrides(storedBlades_);
    entries_ = ofBlades;
    entries_.resize(entries_.size() + room.patches, unitRoots_);
    firstEntries_.resize(std::size_t(storedStrides) + sownStrides(room.blades), 0);
    std::uint32_t entry = 0;
    for (std::uint32_t i = 0; i < storedStrides; ++i) {
        while (patches_[entries_[entry]].firstBlade + patches_[entries_[entry]].bladeCount <=
               i * placesTogether)
            ++entry;
        firstEntries_[i] = entry;
    }
    freePatches_.give({shift + storedCount, room.patches});
    freeEntries_.give({storedNonEmpty_, room.patches});
    freeStrides_.give({storedStrides, sownStrides(room.blades)});
    for (std::uint32_t root = unitRoots_; root-- > 0;)
        freeRoots_.push_back(root);
    for (std::uint32_t i = 0; i < storedNonEmpty_ + room.patches; ++i)
        sizes_.add(shared::maxPatchBlades);

    // The patches of units come in the second step.
    std::uint32_t levelsBelow = 0;
    walkStarts_ = shift + firstLevels(stored.patches, walkStart, levelsBelow);
    walkSteps_ = 1 + std::max(levelsBelow, 1U);
}

FieldTables SownTables::tables() const
{
    return {.patches = patches_,
            .subtrees = subtrees_,
            .entries = entries_,
            .firstEntries = firstEntries_,
            .entryEnd = static_cast<std::uint32_t>(entries_.size()),
            .bladeCount = storedBlades_ + sownBlades_,
            .bladeRoom = static_cast<std::uint32_t>(firstEntries_.size()) * placesTogether,
            .nonEmptyPatches = storedNonEmpty_ + patchRoom_,
            .sizes = &sizes_,
            .walkStarts = walkStarts_,
            .walkSteps = walkSteps_,
            .maxWalkSteps = walkSteps_};
}

std::optional<SownTables::Place> SownTables::add(const field::UnitPatches& unit, Edit& edit)
{
    expect(!unit.patches.empty(), "a unit with blades");
    if (freeRoots_.empty())
        return std::nullopt;
    const auto count = static_cast<std::uint32_t>(unit.patches.size());
    const std::optional<PlaceRange> strides = freeStrides_.take(sownStrides(unit.bladeCount));
    if (!strides)
        return std::nullopt;
    const std::optional<PlaceRange> patches = freePatches_.take(count);
    if (!patches) {
        freeStrides_.give(*strides);
        return std::nullopt;
    }
    // There are as many entries as patches, but their free ranges may be shorter.
    const std::optional<PlaceRange> entries = freeEntries_.take(count);
    if (!entries) {
        freeStrides_.give(*strides);
        freePatches_.give(*patches);
        return std::nullopt;
    }
    Place place;
    place.root = freeRoots_.back();
    freeRoots_.pop_back();
    place.patches = *patches;
    place.entries = *entries;
    place.blades = {strides->first * placesTogether, strides->count * placesTogether};
    place.bladeCount = unit.bladeCount;

    shared::Subtree all{.blades = place.bladeCount, .widest = unit.widest, .rankBelow = 1.0f};
    for (std::uint32_t i = 0; i < count; ++i) {
        shared::Patch& patch = patches_[patches->first + i];
        patch = unit.patches[i];
        patch.firstBlade += place.blades.first;
        patch.parent = place.root;
        patch.level = 1;
        subtrees_[patches->first + i] = {.blades = patch.bladeCount,
                                         .widest = patch.widthLow + 63.0f * patch.widthStep,
                                         .rankBelow = 1.0f};
        all.rankBelow = std::min(all.rankBelow, patch.rankLow);
        entries_[entries->first + i] = patches->first + i;
        edit.times.push_back({.patchIndex = patches->first + i,
                              .from = shared::noPatch,
                              .keepsCount = shared::countsNone});
    }
    shared::Patch& root = patches_[place.root];
    root = unit.whole;
    root.bladeCount = 0;
    root.firstChild = patches->first;
    root.childCount = count;
    root.level = 0;
    subtrees_[place.root] = all;
    for (std::uint32_t i = 0, entry = 0; i < strides->count; ++i) {
        while (unit.patches[entry].firstBlade + unit.patches[entry].bladeCount <=
               i * placesTogether)
            ++entry;
        firstEntries_[strides->first + i] = entries->first + entry;
    }
    sownBlades_ += place.bladeCount;
    edit.patches.push_back({place.root, 1});
    edit.patches.push_back(*patches);
    edit.entries.push_back(*entries);
    edit.firstEntries.push_back(*strides);
    return place;
}

void SownTables::remove(const Place& place, Edit& edit)
{
    patches_[place.root] = bareRoot();
    subtrees_[place.root] = bareBelow;
    freeRoots_.push_back(place.root);
    for (std::uint32_t entry = place.entries.first; entry < place.entries.end(); ++entry)
        entries_[entry] = unitRoots_;
    edit.patches.push_back({place.root, 1});
    edit.entries.push_back(place.entries);
    freePatches_.give(place.patches);
    freeEntries_.give(place.entries);
    freeStrides_.give({place.blades.first / placesTogether, place.blades.count / placesTogether});
    sownBlades_ -= place.bladeCount;
}

} // namespace sward::render
