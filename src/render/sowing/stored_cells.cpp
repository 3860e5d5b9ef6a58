#include "render/sowing/stored_cells.h"

#include "core/error.h"
#include "field/seeds/sow_unit.h"
#include "render/field/key_table.h"
#include "render/field/patch_tree.h"
#include "shaders/shared/passes.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace sward::render {
namespace {

/// A cell as a unit: its patches with blades, side by side.
field::UnitPatches unitOf(std::span<const shared::Patch> patches,
                          std::span<const shared::PackedBlade> blades)
{
    field::UnitPatches unit;
    for (const shared::Patch& patch : patches) {
        if (patch.bladeCount == 0)
            continue;
        shared::Patch& own = unit.patches.emplace_back(patch);
        own.firstChild = shared::noPatch;
        own.childCount = 0;
    }
    std::ranges::sort(unit.patches, {}, &shared::Patch::firstBlade);
    unit.bladeCount = static_cast<std::uint32_t>(blades.size());
    unit.whole = patches.front();
    unit.widest = subtreesOf(patches).front().widest;
    return unit;
}

} // namespace

StoredCells::StoredCells(const field::FieldView& field, SownTables& tables)
{
    requireUsage(field.keys.size() == field.blades.size(), "an editable field has keys");
    Edit ignored; // all is uploaded at once
    for (const field::FieldCell& cell : field::cellsOf(field)) {
        const field::CellContent content = field::contentOf(field, cell);
        if (!content.blades.empty())
            replace({cell.cell, content.patches, content.blades, content.keys}, tables, ignored,
                    [] { return false; });
    }
}

std::unique_ptr<SownTables> StoredCells::tablesFor(const SownTables::Room& sown,
                                                   const field::FieldView& field,
                                                   std::uint32_t walkStart)
{
    constexpr std::uint32_t more = 1U << 16U;
    const auto blades = static_cast<std::uint32_t>(field.blades.size());
    const auto patches = static_cast<std::uint32_t>(field.patches.size());
    const SownTables::Room room{.blades = sown.blades + blades + blades / 4 +
                                          patches * shared::nonEmptyPatchStride + more,
                                .patches = sown.patches + patches + patches / 4 + more / 64,
                                .units = sown.units + patches + more / 64};
    field::FieldView bare = field;
    bare.patches = {};
    bare.blades = {};
    bare.keys = {};
    return std::make_unique<SownTables>(bare, room, walkStart);
}

void StoredCells::replace(const field::CellChange& change, SownTables& tables, Edit& edit,
                          const std::function<bool()>& makeRoom)
{
    const auto known = cells_.find(change.cell);
    const Cell former = known == cells_.end() ? Cell() : known->second;
    if (change.blades.empty()) {
        if (known != cells_.end())
            cells_.erase(known);
    } else {
        const field::UnitPatches unit = unitOf(change.patches, change.blades);
        const std::size_t firstTime = edit.times.size();
        std::optional<SownTables::Place> place = tables.add(unit, edit);
        while (!place && makeRoom())
            place = tables.add(unit, edit);
        if (!place)
            fail(ErrorKind::runtime,
                 "no room for the {} stored blades of the 32 m cell ({}, {}, {})",
                 change.blades.size(), change.cell[0], change.cell[1], change.cell[2]);
        edit.blades.push_back({place->blades.first, change.blades});
        Cell& now = cells_[change.cell];
        now = {*place, unit.patches, {change.keys.begin(), change.keys.end()}};
        addSources(former, now, edit, firstTime);
    }
    patchCount_ += (change.blades.empty() ? 0 : cells_[change.cell].patches.size());
    patchCount_ -= former.patches.size();
    if (!former.keys.empty())
        retired_.push_back(former.place);
}

/// The states of blades that stay, and the times of their patches.
void StoredCells::addSources(const Cell& former, const Cell& now, Edit& edit,
                             std::size_t firstTime) const
{
    const KeyTable known(former.keys);
    std::vector<std::uint32_t> patchOf(former.keys.size());
    for (std::uint32_t p = 0; p < former.patches.size(); ++p)
        for (std::uint32_t i = 0; i < former.patches[p].bladeCount; ++i)
            patchOf[former.patches[p].firstBlade + i] = p;
    for (std::size_t p = 0; p < now.patches.size(); ++p) {
        shared::PatchSource& time = edit.times[firstTime + p];
        time.keepsCount = shared::countsAll;
        for (std::uint32_t i = 0; i < now.patches[p].bladeCount; ++i) {
            const std::uint32_t blade = now.patches[p].firstBlade + i;
            shared::BladeSource source{.place = now.place.blades.first + blade,
                                       .from = shared::noSource,
                                       .fromPatch = shared::noPatch,
                                       .indexInPatch = 0};
            if (const std::uint32_t from = known.find(now.keys[blade], 0);
                from != shared::noSource) {
                source.from = former.place.blades.first + from;
                source.fromPatch = former.place.patches.first + patchOf[from];
                source.indexInPatch = from - former.patches[patchOf[from]].firstBlade;
                if (time.from == shared::noPatch)
                    time.from = source.fromPatch;
            }
            edit.sources.push_back(source);
        }
    }
}

void StoredCells::retire(SownTables& tables, Edit& edit)
{
    for (const SownTables::Place& place : retired_)
        tables.remove(place, edit);
    retired_.clear();
}

std::vector<std::uint32_t> StoredCells::placesOf(const field::FieldView& field) const
{
    std::vector<std::uint32_t> places(field.blades.size());
    for (const field::FieldCell& cell : field::cellsOf(field)) {
        const field::CellContent content = field::contentOf(field, cell);
        if (content.blades.empty())
            continue;
        const auto known = cells_.find(cell.cell);
        requireUsage(known != cells_.end() && known->second.keys.size() == content.blades.size(),
                     "the renderer's field has other blades in the 32 m cell ({}, {}, {})",
                     cell.cell[0], cell.cell[1], cell.cell[2]);
        for (std::size_t p = 0; p < cell.patches.size(); ++p) {
            const shared::Patch& patch = field.patches[cell.patches[p]];
            for (std::uint32_t i = 0; i < patch.bladeCount; ++i)
                places[patch.firstBlade + i] =
                    known->second.place.blades.first + content.patches[p].firstBlade + i;
        }
    }
    return places;
}

std::vector<shared::PackedBlade> StoredCells::placed(const field::FieldView& field) const
{
    const std::vector<std::uint32_t> places = placesOf(field);
    std::vector<shared::PackedBlade> blades;
    for (std::size_t i = 0; i < places.size(); ++i) {
        if (places[i] >= blades.size())
            blades.resize(places[i] + 1);
        blades[places[i]] = field.blades[i];
    }
    return blades;
}

} // namespace sward::render
