#include "render/sowing/device_sower.h"

#include "field/measure/subtree_bounds.h"
#include "gpu/recording/barrier.h"
#include "render/frame/shader_names.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <tuple>
#include <utility>

namespace sward::render {
namespace {

/// Of a batch.
constexpr std::uint32_t maxUnits = 64;
constexpr std::uint32_t maxRuns = 1U << 16U;

/// Levels of octree cells below a unit's cube: shared::sowCells are there.
constexpr std::uint32_t levelsBelowUnit = 3;

/// A patch for so many stalks, beside one for each octree cell of ordinary units.
constexpr std::uint32_t stalksOfPatch = 64;

/// Share of a batch that is filled by expected candidates: so rarely some do not fit.
constexpr double filledShare = 0.75;

/// Largest number of work-groups of a dispatch everywhere.
constexpr std::uint32_t maxGroups = 65535;

constexpr VkDeviceSize sowAlignment = 16;

VkDeviceSize sowAligned(VkDeviceSize bytes)
{
    return (bytes + sowAlignment - 1) / sowAlignment * sowAlignment;
}

std::uint32_t maxPatchesOf(const DeviceSower::Settings& settings)
{
    return settings.maxCandidates / stalksOfPatch + 512;
}

/// Blades of a batch: ribbons included.
std::uint32_t maxBladesOf(const DeviceSower::Settings& settings)
{
    return 2 * settings.maxCandidates;
}

/// Parts of a buffer, one behind another.
class Parts {
public:
    VkDeviceSize add(VkDeviceSize bytes)
    {
        const VkDeviceSize offset = end_;
        end_ += sowAligned(bytes);
        return offset;
    }
    VkDeviceSize end() const { return end_; }

private:
    VkDeviceSize end_ = 0;
};

/// What a frame's commands read.
struct Jobs {
    explicit Jobs(const DeviceSower::Settings& settings)
        : moves(parts.add(VkDeviceSize(maxPatchesOf(settings)) * sizeof(shared::SowMove)))
    {
    }
    Parts parts;
    VkDeviceSize batch = parts.add(sizeof(shared::SowBatch));
    VkDeviceSize orders = parts.add(maxUnits * sizeof(shared::SowOrder));
    VkDeviceSize runs = parts.add(VkDeviceSize(maxRuns) * sizeof(shared::SowRun));
    VkDeviceSize moves;
};

/// What the passes leave to each other.
struct Scratch {
    explicit Scratch(const DeviceSower::Settings& settings)
        : records(parts.add(settings.maxCandidates * sizeof(shared::SowRecord)))
        , sorted(parts.add(settings.maxCandidates * sizeof(shared::SowRecord)))
        , stalks(parts.add(settings.maxCandidates * sizeof(shared::SowStalk)))
    {
    }
    static constexpr VkDeviceSize words = VkDeviceSize(maxUnits) * shared::sowCells * 4;
    Parts parts;
    VkDeviceSize counts = parts.add(sizeof(shared::SowCounts));
    VkDeviceSize failed = parts.add(maxUnits * 4);
    VkDeviceSize cells = parts.add(words);
    VkDeviceSize cleared = parts.end(); ///< before each batch: all up to here
    VkDeviceSize ends = parts.add(words);
    VkDeviceSize growing = parts.add(words);
    VkDeviceSize records;
    VkDeviceSize sorted;
    VkDeviceSize stalks;
};

/// What the CPU reads: the first part of the scratch memory but the cells, then patches.
struct Results {
    VkDeviceSize counts = 0;
    VkDeviceSize failed = sowAligned(sizeof(shared::SowCounts));
    VkDeviceSize patches = failed + maxUnits * 4;
};

/// Meadow, its species, tones, and ribbons of all species.
struct Constants {
    explicit Constants(const field::Sower& sower)
        : species(parts.add(sower.species().size_bytes()))
        , tones(parts.add(sower.tones().size_bytes()))
    {
        for (const std::vector<shared::SowRibbon>& some : sower.ribbons())
            all.insert(all.end(), some.begin(), some.end());
        ribbons = parts.add(all.size() * sizeof(shared::SowRibbon));
    }
    Parts parts;
    VkDeviceSize meadow = parts.add(sizeof(shared::SowMeadow));
    VkDeviceSize species;
    VkDeviceSize tones;
    VkDeviceSize ribbons = 0;
    std::vector<shared::SowRibbon> all;
};

constexpr VkBufferUsageFlags sowUse = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT |
                                      VK_BUFFER_USAGE_TRANSFER_SRC_BIT |
                                      VK_BUFFER_USAGE_TRANSFER_DST_BIT;

gpu::ComputePipeline batchPass(const gpu::DeviceContext& context,
                               const gpu::ShaderLibrary& shaders, const char* name,
                               const char* shader)
{
    return {context, shaders,
            {.name = name,
             .shader = shader,
             .pushConstantBytes = sizeof(shared::SowBatchPush),
             .isExact = true}};
}

gpu::Buffer constantsOf(const gpu::DeviceContext& context, const field::Sower& sower)
{
    const Constants at(sower);
    gpu::Buffer buffer(context, {.name = "sowing/meadow",
                                 .bytes = at.parts.end(),
                                 .usage = sowUse,
                                 .memory = gpu::MemoryUse::constants});
    std::byte* const bytes = buffer.mapped().data();
    shared::SowMeadow meadow = sower.meadow();
    meadow.species.address = buffer.address() + at.species;
    std::memcpy(bytes + at.meadow, &meadow, sizeof meadow);
    std::memcpy(bytes + at.species, sower.species().data(), sower.species().size_bytes());
    std::memcpy(bytes + at.tones, sower.tones().data(), sower.tones().size_bytes());
    if (!at.all.empty())
        std::memcpy(bytes + at.ribbons, at.all.data(), at.all.size() * sizeof(at.all[0]));
    return buffer;
}

} // namespace

DeviceSower::Settings DeviceSower::Settings::of(std::uint64_t sownBytes,
                                                std::uint32_t framesInFlight)
{
    constexpr std::uint64_t least = 1U << 15U;
    constexpr std::uint64_t most = 1U << 19U;
    return {.framesInFlight = framesInFlight,
            .maxCandidates =
                static_cast<std::uint32_t>(std::clamp(sownBytes / 2048, least, most)),
            .cellBytes = std::clamp<std::uint64_t>(sownBytes / 8, 1U << 22U, 1U << 28U),
            .stagingBytes = std::clamp<std::uint64_t>(sownBytes / 64, 1U << 20U, 1U << 23U)};
}

std::uint64_t DeviceSower::Settings::deviceBytes() const
{
    return cellBytes + Jobs(*this).parts.end() + Scratch(*this).parts.end() +
           std::uint64_t(framesInFlight) * maxBladesOf(*this) * sizeof(shared::PackedBlade);
}

DeviceSower::DeviceSower(const gpu::DeviceContext& context, const gpu::ShaderLibrary& shaders,
                         const field::Sower& sower, const Settings& settings)
    : sower_(&sower)
    , settings_(settings)
    , find_(batchPass(context, shaders, "sow/find", shader::findCandidates))
    , scan_(batchPass(context, shaders, "sow/scan", shader::scanCells))
    , sort_(batchPass(context, shaders, "sow/sort", shader::sortCandidates))
    , grow_(batchPass(context, shaders, "sow/grow", shader::growStalks))
    , lay_(batchPass(context, shaders, "sow/lay", shader::layPatches))
    , placing_(context, shaders,
               {.name = "sow/place",
                .shader = shader::placeBlades,
                .pushConstantBytes = sizeof(shared::SowPlacePush)})
    , cells_(context, settings.cellBytes)
    , constants_(constantsOf(context, sower))
    , jobs_(context,
            {.name = "sowing/jobs", .bytes = Jobs(settings).parts.end(), .usage = sowUse})
    , scratch_(context, {.name = "sowing/scratch",
                         .bytes = Scratch(settings).parts.end(),
                         .usage = sowUse | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT})
{
    for (std::uint32_t i = 0; i < settings.framesInFlight; ++i)
        slots_.push_back(
            {.staging = {context,
                         {.name = "sowing/staging",
                          .bytes = settings.stagingBytes + Jobs(settings).parts.end(),
                          .usage = VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                          .memory = gpu::MemoryUse::upload}},
             .blades = {context,
                        {.name = "sowing/blades",
                         .bytes = maxBladesOf(settings) * sizeof(shared::PackedBlade),
                         .usage = sowUse}},
             .results = {context,
                         {.name = "sowing/results",
                          .bytes = Results().patches +
                                   maxPatchesOf(settings) * sizeof(shared::SowPatch),
                          .usage = sowUse,
                          .memory = gpu::MemoryUse::readback}},
             .units = {}});
}

DeviceSower::Finished DeviceSower::finish(std::uint32_t slot)
{
    Slot& from = slots_[slot];
    Finished finished;
    if (from.units.empty())
        return finished;
    const std::byte* const bytes = from.results.mapped().data();
    const Results at;
    shared::SowCounts counts = {};
    std::memcpy(&counts, bytes + at.counts, sizeof counts);
    std::vector<std::uint32_t> failed(from.units.size());
    std::memcpy(failed.data(), bytes + at.failed, failed.size() * 4);
    std::vector<shared::SowPatch> patches(std::min(counts.patches, maxPatchesOf(settings_)));
    if (!patches.empty())
        std::memcpy(patches.data(), bytes + at.patches, patches.size() * sizeof(patches[0]));
    // Unit by unit, in the order of the CPU's patches.
    std::ranges::sort(patches, {}, [](const shared::SowPatch& one) {
        return std::tuple(one.cell, one.rankLow, one.firstBlade);
    });
    auto first = patches.begin();
    for (std::uint32_t number = 0; number < from.units.size(); ++number) {
        const auto end = std::find_if(first, patches.end(), [&](const shared::SowPatch& one) {
            return one.cell / shared::sowCells != number;
        });
        if (failed[number] != 0)
            finished.refused.push_back(from.units[number].unit);
        else
            finished.grown.push_back(unpacked(from.units[number], {first, end}));
        first = end;
    }
    from.units.clear();
    return finished;
}

/// The patches of a unit as the field's tables have them.
DeviceSower::Grown DeviceSower::unpacked(const Unit& of,
                                         std::span<const shared::SowPatch> patches) const
{
    const field::SowUnit& unit = of.unit;
    constexpr float cellSide = 32.0f;
    constexpr float rounding = 2.4e-7f; ///< of a sum of floats, relative
    Grown grown;
    grown.unit.unit = unit;
    field::SownCell cell;
    cell.cell = unit.cell;
    cell.heightStep = of.heightStep;
    field::SubtreeDescription all;
    for (const shared::SowPatch& from : patches) {
        field::SownPatch part;
        part.level = unit.level;
        const std::uint32_t below = unit.level - field::unitLevel(unit.level);
        glm::vec3 corner;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            std::uint32_t inside = 0;
            for (std::uint32_t bit = 0; bit < levelsBelowUnit; ++bit)
                inside |= (from.cell >> (3 * bit + axis) & 1U) << bit;
            part.place[axis] = (unit.place[axis] << below) + inside;
            corner[glm::length_t(axis)] = cellSide * static_cast<float>(unit.cell[axis]);
        }
        part.count = from.bladeCount;
        part.rankLow = from.rankLow;
        part.rankHigh = from.rankHigh;
        shared::Patch patch = sower_->unpackingOf(cell, part);
        patch.firstBlade = grown.unit.bladeCount;
        patch.parent = shared::noPatch;
        patch.firstChild = shared::noPatch;
        const glm::vec3 margin = rounding * (glm::abs(corner) + cellSide);
        patch.boundsLow = corner + from.boundsLow - margin;
        patch.boundsHigh = corner + from.boundsHigh + margin;
        patch.coneAxis = from.coneAxis;
        patch.coneCosine = from.coneCosine;
        all.addChild({patch.boundsLow, patch.boundsHigh, from.bladeCount, from.coneAxis,
                      from.coneCosine});
        grown.unit.widest = std::max(
            grown.unit.widest, patch.widthLow + static_cast<float>(from.widest) * patch.widthStep);
        grown.unit.bladeCount += from.bladeCount;
        grown.unit.patches.push_back(patch);
        grown.firstBlades.push_back(from.firstBlade);
    }
    if (!patches.empty())
        all.finish(grown.unit.whole);
    grown.unit.whole.parent = shared::noPatch;
    grown.unit.whole.firstChild = shared::noPatch;
    return grown;
}

void DeviceSower::begin(std::uint32_t slot)
{
    slot_ = slot;
    ++batch_;
    staged_ = 0;
    copies_.clear();
    orders_.clear();
    runs_.clear();
    moves_.clear();
    units_.clear();
    candidates_ = 0.0;
}

void DeviceSower::place(const Grown& grown, std::uint32_t first)
{
    for (std::size_t i = 0; i < grown.firstBlades.size(); ++i)
        moves_.push_back({.from = grown.firstBlades[i],
                          .to = first + grown.unit.patches[i].firstBlade,
                          .count = grown.unit.patches[i].bladeCount});
}

DeviceSower::Added DeviceSower::add(const UnitOrder& order)
{
    const double room = filledShare * settings_.maxCandidates;
    if (order.unit.level > field::unitLevel(order.unit.level) + levelsBelowUnit ||
        order.candidates > room || order.pieces.size() > maxRuns ||
        !cells_.fits(*order.cell, settings_.stagingBytes))
        return Added::never;
    if (candidates_ + order.candidates > room || runs_.size() + order.pieces.size() > maxRuns ||
        units_.size() == maxUnits)
        return Added::later;
    SeedCellPool::Use use =
        cells_.use(order.index, *order.cell, batch_, settings_.stagingBytes - staged_);
    if (use.address == 0)
        return Added::later;
    if (!use.bytes.empty())
        stageFor(cells_.buffer(), use.offset, use.bytes);
    const std::uint32_t sideBits =
        sower_->meadow().unitBits + 5 - field::unitLevel(order.unit.level);
    shared::SowOrder own = {};
    own.cell = use.address;
    for (std::size_t axis = 0; axis < 3; ++axis)
        own.low[glm::length_t(axis)] =
            static_cast<std::int32_t>(order.unit.place[axis] << sideBits);
    own.sideBits = sideBits;
    own.level = order.unit.level;
    own.from = order.from;
    own.share = order.share;
    const auto number = static_cast<std::uint32_t>(units_.size());
    for (const std::uint32_t piece : order.pieces)
        runs_.push_back({number, piece});
    orders_.push_back(own);
    units_.push_back(
        {order.unit, 1.0f / sower_->meadowAt(order.cell->around()).heightsPerMetre});
    candidates_ += order.candidates;
    return Added::yes;
}

/// Copies bytes into the frame's mapped memory, and has them copied on.
void DeviceSower::stageFor(const gpu::Buffer& to, VkDeviceSize offset,
                           std::span<const std::byte> bytes)
{
    if (bytes.empty())
        return;
    const VkDeviceSize at = staged_;
    std::memcpy(slots_[slot_].staging.mapped().data() + at, bytes.data(), bytes.size());
    staged_ += sowAligned(bytes.size());
    copies_.push_back({to.get(), {at, offset, bytes.size()}});
}

void DeviceSower::record(const gpu::Recording& commands, const gpu::Buffer& blades,
                         gpu::Timestamps* times)
{
    if (units_.empty() && moves_.empty())
        return;
    const Jobs jobs(settings_);
    const Scratch scratch(settings_);
    const Constants constants(*sower_);
    const VkDeviceAddress job = jobs_.address();
    const VkDeviceAddress own = scratch_.address();
    Slot& slot = slots_[slot_];
    if (!units_.empty()) {
        shared::SowBatch batch = {};
        batch.meadow = constants_.address() + constants.meadow;
        batch.tones.address = constants_.address() + constants.tones;
        batch.ribbons = constants_.address() + constants.ribbons;
        batch.units = job + jobs.orders;
        batch.runs = job + jobs.runs;
        batch.counts = own + scratch.counts;
        batch.failed = own + scratch.failed;
        batch.cells = own + scratch.cells;
        batch.ends = own + scratch.ends;
        batch.growing = own + scratch.growing;
        batch.records = own + scratch.records;
        batch.sorted = own + scratch.sorted;
        batch.stalks = own + scratch.stalks;
        batch.blades = slot.blades.address();
        batch.patches = slot.results.address() + Results().patches;
        batch.runCount = static_cast<std::uint32_t>(runs_.size());
        batch.unitCount = static_cast<std::uint32_t>(units_.size());
        batch.maxRecords = settings_.maxCandidates;
        batch.maxBlades = maxBladesOf(settings_);
        batch.maxPatches = maxPatchesOf(settings_);
        stageFor(jobs_, jobs.batch, std::as_bytes(std::span(&batch, 1)));
        stageFor(jobs_, jobs.orders, std::as_bytes(std::span(orders_)));
        stageFor(jobs_, jobs.runs, std::as_bytes(std::span(runs_)));
    }
    stageFor(jobs_, jobs.moves, std::as_bytes(std::span(moves_)));

    gpu::memoryBarrier(commands, gpu::anyAccess, gpu::anyAccess);
    for (const Copy& copy : copies_)
        commands.vk->CmdCopyBuffer(commands, slot.staging.get(), copy.to, 1, &copy.region);
    if (!units_.empty())
        commands.vk->CmdFillBuffer(commands, scratch_.get(), 0, scratch.cleared, 0);
    gpu::transferToCompute(commands);
    if (!moves_.empty())
        recordPlaces(commands, blades);
    if (!units_.empty())
        recordBatch(commands, times);
    gpu::memoryBarrier(commands, gpu::anyAccess, gpu::anyAccess);
    slot.units = std::exchange(units_, {});
}

/// The blades of the slot's last batch go to their places before the next batch replaces them.
void DeviceSower::recordPlaces(const gpu::Recording& commands, const gpu::Buffer& blades)
{
    placing_.bind(commands);
    placing_.push(commands, shared::SowPlacePush{
                                .moves = jobs_.address() + Jobs(settings_).moves,
                                .from = slots_[slot_].blades.address(),
                                .to = blades.address(),
                                .moveCount = static_cast<std::uint32_t>(moves_.size()),
                                .reserved = 0,
                            });
    commands.vk->CmdDispatch(
        commands, std::min(static_cast<std::uint32_t>(moves_.size()), maxGroups), 1, 1);
    gpu::computeToCompute(commands);
}

void DeviceSower::recordBatch(const gpu::Recording& commands, gpu::Timestamps* times)
{
    const Scratch scratch(settings_);
    const shared::SowBatchPush push{jobs_.address() + Jobs(settings_).batch};
    const auto pass = [&](const char* name, const gpu::ComputePipeline& pipeline,
                          const auto& dispatch) {
        const std::uint32_t scope = times != nullptr ? times->begin(commands, name) : 0;
        pipeline.bind(commands);
        pipeline.push(commands, push);
        dispatch();
        gpu::computeToCompute(commands);
        if (times != nullptr)
            times->end(commands, scope);
    };
    pass("find", find_, [&] {
        commands.vk->CmdDispatch(
            commands, std::min(static_cast<std::uint32_t>(runs_.size()), maxGroups), 1, 1);
    });
    pass("scan", scan_, [&] {
        commands.vk->CmdDispatch(commands, static_cast<std::uint32_t>(units_.size()), 1, 1);
    });
    pass("sort", sort_, [&] {
        commands.vk->CmdDispatchIndirect(commands, scratch_.get(),
                                         scratch.counts + offsetof(shared::SowCounts, sortGroups));
    });
    pass("grow", grow_, [&] {
        commands.vk->CmdDispatchIndirect(commands, scratch_.get(),
                                         scratch.counts + offsetof(shared::SowCounts, growGroups));
    });
    pass("lay", lay_, [&] {
        commands.vk->CmdDispatchIndirect(commands, scratch_.get(),
                                         scratch.counts + offsetof(shared::SowCounts, layGroups));
    });
    gpu::computeToTransfer(commands);
    const gpu::Buffer& results = slots_[slot_].results;
    const VkBufferCopy read{scratch.counts, Results().counts, scratch.cells - scratch.counts};
    commands.vk->CmdCopyBuffer(commands, scratch_.get(), results.get(), 1, &read);
    gpu::anythingToHost(commands);
}

bool DeviceSower::isBusy() const
{
    return std::ranges::any_of(slots_, [](const Slot& slot) { return !slot.units.empty(); });
}

VkDeviceSize DeviceSower::bytes() const
{
    VkDeviceSize sum = cells_.buffer().bytes() + jobs_.bytes() + scratch_.bytes();
    for (const Slot& slot : slots_)
        sum += slot.staging.bytes() + slot.blades.bytes() + slot.results.bytes();
    return sum;
}

} // namespace sward::render
