#include "render/viewer/blade_dump.h"

#include "gpu/context/check.h"
#include "gpu/memory/readback.h"
#include "shaders/shared/frame.h"
#include "shaders/shared/passes.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace sward::render {
namespace {

/// The place and pose of a blade in world space.
FieldRenderer::BladeRecord recordOf(const field::FieldView& field,
                                    const std::vector<shared::Organ>& organs,
                                    const shared::Blade& blade, const shared::BladeState& state)
{
    const shared::Species& look = field.species[blade.species].look;
    shared::PosedBlade posed = shared::posedBlade(blade, state);
    if (const std::uint32_t number = shared::ribbonNumber(look, blade); number > 0)
        posed = shared::ribbonOf(field::viewOf(organs), look, posed, number);
    FieldRenderer::BladeRecord record;
    record.root = field.origin + glm::dvec3(posed.v0);
    record.v1 = field.origin + glm::dvec3(posed.v1);
    record.v2 = field.origin + glm::dvec3(posed.v2);
    record.up = blade.up;
    record.eta = state.eta;
    return record;
}

/// A blade that has never been moved stands upright.
shared::BladeState stateOf(std::uint32_t turn, float eta)
{
    return {turn == shared::unsettledTurn ? 0 : turn, eta};
}

/// Reads the elements of a buffer that belong to some blades.
template <typename T>
std::vector<T> readPart(const gpu::DeviceContext& context, const gpu::Buffer& buffer,
                        BladePart part)
{
    const std::vector<std::byte> bytes =
        gpu::readBuffer(context, buffer, part.first * sizeof(T), part.count * sizeof(T));
    std::vector<T> elements(part.count);
    if (part.count > 0)
        std::memcpy(elements.data(), bytes.data(), bytes.size());
    return elements;
}

template <typename T>
void append(std::vector<T>& elements, const std::vector<T>& more)
{
    elements.insert(elements.end(), more.begin(), more.end());
}

// The blades of a patch, which are in memory at `parts`, and their states; empty without all parts.
std::vector<FieldRenderer::BladeRecord>
readParts(const gpu::DeviceContext& context, const PlacedField& blades,
          const field::FieldView& field, const shared::Patch& cell,
          std::span<const shared::PackedBlade> packed, std::span<const BladePart> parts)
{
    std::vector<std::uint32_t> turns;
    std::vector<float> etas;
    std::vector<std::uint32_t> cullResults;
    for (const BladePart& part : parts) {
        append(turns, readPart<std::uint32_t>(context, blades.states().states(), part));
        if (blades.states().hasEtas())
            append(etas, readPart<float>(context, blades.states().etas(), part));
        if (blades.cullResults().bytes() > 0)
            append(cullResults, readPart<std::uint32_t>(context, blades.cullResults(), part));
    }
    if (turns.size() < cell.bladeCount)
        return {};
    etas.resize(cell.bladeCount, 0.0f);
    cullResults.resize(cell.bladeCount, shared::cullResultPatch);
    const std::vector<shared::Organ> organs = field::organTable(field.species);
    std::vector<FieldRenderer::BladeRecord> records(cell.bladeCount);
    for (std::uint32_t i = 0; i < cell.bladeCount; ++i) {
        records[i] = recordOf(field, organs, shared::unpackBlade(packed[i], cell),
                              stateOf(turns[i], etas[i]));
        records[i].cullResult = cullResults[i];
    }
    return records;
}

} // namespace

std::vector<FieldRenderer::BladeRecord> readBlades(const gpu::DeviceContext& context,
                                                   const PlacedField& blades,
                                                   const field::FieldView& field,
                                                   std::span<const std::uint32_t> places)
{
    gpu::check(context.vk.DeviceWaitIdle(context.device), "vkDeviceWaitIdle");
    const auto turns = gpu::readBufferAs<std::uint32_t>(context, blades.states().states());
    std::vector<float> etas(turns.size(), 0.0f);
    if (blades.states().hasEtas())
        etas = gpu::readBufferAs<float>(context, blades.states().etas());
    const VisibleBlades& list = blades.list(0);
    const auto visible = gpu::readBufferAs<shared::VisibleBlade>(context, list.visible());
    const auto rounds = gpu::readBufferAs<shared::WalkLevel>(context, list.rounds());
    std::vector<std::uint32_t> cullResults;
    if (blades.cullResults().bytes() > 0)
        cullResults = gpu::readBufferAs<std::uint32_t>(context, blades.cullResults());

    // Pose each blade of each patch.
    const std::vector<shared::Organ> organs = field::organTable(field.species);
    std::vector<FieldRenderer::BladeRecord> records(field.blades.size());
    std::vector<std::size_t> recordAt(turns.size());
    const auto write = [&](std::size_t index, std::size_t place, std::uint64_t id,
                           const shared::Blade& blade) {
        recordAt[place] = index;
        FieldRenderer::BladeRecord& record = records[index];
        record = recordOf(field, organs, blade, stateOf(turns[place], etas[place]));
        record.id = id;
        record.cullResult = cullResults.empty() ? shared::cullResultPatch : cullResults[place];
    };
    for (const shared::Patch& cell : field.patches) {
        for (std::uint32_t i = 0; i < cell.bladeCount; ++i) {
            const std::size_t index = cell.firstBlade + i;
            write(index, places.empty() ? index : places[index], field.idOf(index),
                  shared::unpackBlade(field.blades[index], cell));
        }
    }
    if (Sowing* const sowing = blades.sowing(); sowing != nullptr)
        for (const SownTables::Resident& resident : sowing->residents()) {
            const field::GrownUnit grown = sowing->grownAgain(resident.unit);
            const std::size_t first = records.size();
            records.resize(first + grown.blades.size());
            for (std::size_t p = 0; p < grown.patches.size(); ++p) {
                const shared::Patch& cell = grown.patches[p];
                for (std::uint32_t i = 0; i < cell.bladeCount; ++i) {
                    const std::size_t index = cell.firstBlade + i;
                    write(first + index, resident.patches[p].firstBlade + i,
                          field::bladeId(grown.keys[index]),
                          shared::unpackBlade(grown.blades[index], cell));
                }
            }
        }

    // The list has the drawn width of each blade. The cull results, if kept, say which listed
    // blades other grass hides.
    const auto drawn = [&](const shared::VisibleBlade& blade) {
        if (!cullResults.empty() && cullResults[blade.blade] != shared::cullResultDrawn)
            return;
        FieldRenderer::BladeRecord& record = records[recordAt[blade.blade]];
        record.lodWidth = shared::widthFactorOf(blade);
        record.cullResult = shared::cullResultDrawn;
    };
    const std::size_t first = std::min<std::size_t>(rounds[0].count, visible.size());
    const std::size_t late =
        std::min<std::size_t>(rounds[list.roundCount()].count, visible.size() - first);
    std::for_each_n(visible.begin(), first, drawn);
    std::for_each_n(visible.rbegin(), late, drawn);
    return records;
}

std::vector<FieldRenderer::BladeRecord>
readPatch(const gpu::DeviceContext& context, const PlacedField& blades,
          const field::FieldView& field, std::uint32_t patch, std::span<const BladePart> parts)
{
    const shared::Patch& cell = field.patches[patch];
    std::vector<FieldRenderer::BladeRecord> records =
        readParts(context, blades, field, cell,
                  field.blades.subspan(cell.firstBlade, cell.bladeCount), parts);
    for (std::size_t i = 0; i < records.size(); ++i)
        records[i].id = field.idOf(cell.firstBlade + i);
    return records;
}

SownDump readSown(const gpu::DeviceContext& context, const PlacedField& blades,
                  const field::FieldView& field, const shared::Patch& cell)
{
    const BladePart part{cell.firstBlade, cell.bladeCount};
    const auto packed = readPart<shared::PackedBlade>(context, blades.blades().blades(), part);
    SownDump dump;
    for (const shared::PackedBlade& bits : packed)
        dump.blades.push_back(shared::unpackBlade(bits, cell));
    dump.records = readParts(context, blades, field, cell, packed, {&part, 1});
    return dump;
}

} // namespace sward::render
