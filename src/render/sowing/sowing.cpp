#include "render/sowing/sowing.h"

#include "core/error.h"
#include "core/expect.h"
#include "core/stopwatch.h"
#include "field/seeds/changed_cubes.h"
#include "render/streaming/thinning.h"
#include "shaders/shared/pages.h"
#include "shaders/shared/visibility.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace sward::render {
namespace {

/// Blades that come in a frame, and in one that waits for them [bytes].
constexpr VkDeviceSize frameBytes = VkDeviceSize(4) << 20;
constexpr VkDeviceSize waitingBytes = VkDeviceSize(64) << 20;

/// A unit replaces another one that is wanted less by this factor, so that a still eye changes
/// nothing.
constexpr float replacing = 1.19f;

/// An eye that moves less wants the same [m]: a twentieth of the finest unit.
constexpr float ignoredStep = 0.2f;

/// Likewise for what depends on the distance of an eye that flies towards the field.
constexpr float ignoredPart = 0.01f;

/// Jobs that wait at once: enough for all threads until the next frame.
constexpr std::size_t maxJobs = 256;

/// What a frame without threads takes for orders [s], and a cell more.
constexpr double ownSeconds = 0.5e-3;

} // namespace

Sowing::Sowing(const gpu::DeviceContext& context, const gpu::ShaderLibrary& shaders,
               const field::FieldView& field, std::unique_ptr<SownTables> tables,
               std::unique_ptr<StoredCells> stored, const Settings& settings)
    : settings_(settings)
    , tables_(std::move(tables))
    , stored_(std::move(stored))
    , choice_(*field.seeds)
    , workers_(field, settings.threads)
    , staged_(context, shaders, settings.framesInFlight)
    , device_(settings.device && !settings.waits
                  ? std::make_unique<DeviceSower>(context, shaders, workers_.sower(),
                                                  *settings.device)
                  : nullptr)
    , allBlades_(static_cast<std::uint64_t>(double(field.blades.size()) /
                                            std::max(field.seeds->meadow->stored, 1e-12)))
    , nearestMissing_(std::numeric_limits<float>::infinity())
{
}

bool Sowing::isThere(const field::SowUnit& unit) const
{
    const auto found = present_.find(unit);
    return found != present_.end() && !found->second.isStale;
}

void Sowing::apply(const field::Delta& delta, const StagedEdits::Cover& cover)
{
    requireUsage(stored_ != nullptr, "the sown field is not editable");
    Edit edit;
    const auto makesRoom = [&] { return makeRoom(std::numeric_limits<float>::infinity(), edit); };
    for (const field::CellChange& change : delta.cells)
        stored_->replace(change, *tables_, edit, makesRoom);
    stored_->retire(*tables_, edit);
    stage(edit, cover);
    replace(delta.seeds);
}

/// Has the next frame record changes of the tables.
void Sowing::stage(Edit& edit, const StagedEdits::Cover& cover)
{
    edit.patches = united(std::move(edit.patches));
    edit.entries = united(std::move(edit.entries));
    edit.firstEntries = united(std::move(edit.firstEntries));
    staged_.add(edit, tables_->tables(), cover);
}

void Sowing::replace(std::span<const std::shared_ptr<const field::SeedCell>> cells)
{
    const std::uint32_t unitBits = workers_.sower().meadow().unitBits;
    for (const std::shared_ptr<const field::SeedCell>& cell : cells) {
        const std::size_t index = choice_.add(cell->cell);
        const field::UnitCell::Cubes changed =
            field::changedCubes(*workers_.contentOf(index), *cell, unitBits);
        workers_.replace(index, cell);
        choice_.know(cell->cell, field::cubesOf(*cell, unitBits));
        const auto isChanged = [&](const field::SowUnit& unit) {
            return unit.cell == cell->cell && field::bears(changed, unit);
        };
        std::erase_if(ready_, [&](const auto& one) { return isChanged(one.first); });
        // Orders have the cell as it was.
        std::erase_if(orders_, [&](const auto& one) { return one.first.cell == cell->cell; });
        for (auto& [unit, isStale] : growing_)
            isStale = isStale || isChanged(unit);
        if (device_)
            device_->forgetCell(index);
        for (auto& [unit, present] : present_)
            present.isStale = present.isStale || isChanged(unit);
    }
    if (!cells.empty())
        looked_.clear();
}

std::vector<std::uint32_t> Sowing::placesOf(const field::FieldView& field) const
{
    return stored_ ? stored_->placesOf(field) : std::vector<std::uint32_t>();
}

void Sowing::choose(std::span<shared::Eyepoint> seen, std::uint32_t slot)
{
    expect(!seen.empty(), "a frame has views");
    const float threshold = seen.front().lodThreshold;
    eyes_.assign(seen.begin(), seen.end());
    const std::span<const shared::Eyepoint> ahead = motion_.ahead(seen);
    eyes_.insert(eyes_.end(), ahead.begin(), ahead.end());
    if (threshold <= 0.0f)
        setThreshold(eyes_, rankingThreshold);

    const bool hadMore = copied_ > 0;
    copied_ = 0;
    const bool hasLanded = takeBatch(slot);
    if (settings_.waits) {
        for (bool isDone = false; !isDone;) {
            takeResults();
            bring(seen.size());
            isDone = missing_ == 0 || isFull_ || copied_ >= waitingBytes;
            if (!isDone)
                workers_.finish();
        }
    } else if (takeResults() || hasLanded || hadMore || haveMoved()) {
        bring(seen.size());
    }
    landed_.clear();
    if (device_)
        order();
    if (settings_.threads == 0 && !settings_.waits) {
        // Orders of a known cell take some microseconds.
        double seconds = 0.0;
        for (Stopwatch watch; seconds < ownSeconds && workers_.run();)
            seconds = device_ ? seconds + watch.lap() : ownSeconds;
    }

    const float wanted = std::clamp(missingScore_, 1.0f, maxThinning);
    thinning_ = nextThinning(settings_.waits ? 0.0f : thinning_, wanted);
    if (threshold > 0.0f)
        setThreshold(seen, threshold * thinning_);
    const bool isEnough = device_ && !hasAsked_ && orders_.empty() && growing_.empty();
    isSettled_ = copied_ == 0 && (missing_ == 0 || isFull_ || isEnough) && thinning_ == wanted;
}

/// Whether an eye has moved so far since the last choice that it may want other units.
bool Sowing::haveMoved() const
{
    const auto wantsTheSame = [](const shared::Eyepoint& a, const shared::Eyepoint& b) {
        return glm::distance(a.eye, b.eye) < ignoredStep && a.pixelsPerUnit == b.pixelsPerUnit &&
               a.lodThreshold == b.lodThreshold && a.lodWidth == b.lodWidth &&
               a.cullMask == b.cullMask && a.drawDistance == b.drawDistance &&
               std::abs(a.sparseFrom - b.sparseFrom) <= ignoredPart * b.sparseFrom;
    };
    return !std::ranges::equal(eyes_, looked_, wantsTheSame);
}

/// Chooses units for the eyes, of which the first `views` are those of views; changes the tables,
/// and asks for what is missing.
void Sowing::bring(std::size_t views)
{
    looked_ = eyes_;
    isFull_ = false;
    forgetBare();
    choice_.find(eyes_, wanted_);
    for (auto& [unit, present] : present_)
        present.score = choice_.scoreOf(unit, eyes_);
    Edit edit;
    dropStale(edit);
    takeIn(edit);
    if (!edit.patches.empty()) {
        stage(edit, {});
        std::erase_if(ready_, [&](const auto& one) { return isThere(one.first); });
    }
    ask();
    findMissing(std::span(eyes_).first(views));
}

/// Removes stale units that no eye wants, or in which nothing bears any more.
void Sowing::dropStale(Edit& edit)
{
    std::erase_if(present_, [&](const auto& one) {
        const Present& present = one.second;
        if (!present.isStale || (present.score > 1.0f && choice_.mayBear(one.first)))
            return false;
        if (present.place.bladeCount > 0)
            tables_->remove(present.place, edit);
        return true;
    });
}

/// Takes what the workers have grown. Returns false if there was nothing.
bool Sowing::takeResults()
{
    std::vector<SowWorkers::Result> results = workers_.take();
    for (SowWorkers::Result& result : results) {
        if (result.version != workers_.versionOf(choice_.indexOf(result.cell)))
            continue;
        if (!choice_.knows(result.cell))
            choice_.know(result.cell, result.cubes);
        // A unit may be asked for again while a worker has its order in hand.
        if (result.order && !isKnown(result.order->unit))
            orders_[result.order->unit] = std::move(*result.order);
        if (!result.unit)
            continue;
        const field::SowUnit unit = result.unit->unit;
        if (result.unit->patches.empty() && !present_.contains(unit))
            present_[unit] = {};
        else
            ready_[unit] = std::move(*result.unit);
    }
    return !results.empty();
}

/// Takes what the device has grown in the batch of a slot, and begins the next one. Returns false if
/// there was nothing.
bool Sowing::takeBatch(std::uint32_t slot)
{
    if (!device_)
        return false;
    DeviceSower::Finished finished = device_->finish(slot);
    device_->begin(slot);
    for (DeviceSower::Grown& one : finished.grown) {
        const field::SowUnit unit = one.unit.unit;
        const auto growing = growing_.find(unit);
        const bool isStale = growing->second;
        growing_.erase(growing);
        if (isStale)
            continue;
        if (one.unit.patches.empty() && !present_.contains(unit))
            present_[unit] = {};
        else
            landed_[unit] = std::move(one);
    }
    for (const field::SowUnit& unit : finished.refused) {
        growing_.erase(unit);
        refused_.insert(unit);
    }
    return !finished.grown.empty() || !finished.refused.empty();
}

/// Orders units from the device, the most wanted first.
void Sowing::order()
{
    if (isFull_) {
        orders_.clear();
        return;
    }
    for (const SowChoice::Wanted& one : wanted_) {
        if (orders_.empty())
            return;
        const auto found = one.isCell ? orders_.end() : orders_.find(one.unit);
        if (found == orders_.end())
            continue;
        const DeviceSower::Added added = device_->add(found->second);
        if (added == DeviceSower::Added::later)
            return;
        if (added == DeviceSower::Added::yes)
            growing_[one.unit] = false;
        else
            refused_.insert(one.unit);
        orders_.erase(found);
    }
    // What is left is not wanted any more.
    orders_.clear();
}

/// Whether a unit is there, or on its way.
bool Sowing::isKnown(const field::SowUnit& unit) const
{
    return isThere(unit) || ready_.contains(unit) || orders_.contains(unit) ||
           growing_.contains(unit) || landed_.contains(unit);
}

/// The score up to which a unit would not get a place.
float Sowing::replaceable() const
{
    constexpr std::uint32_t enough = 1U << 17U;
    const FieldTables tables = tables_->tables();
    if (tables.bladeRoom - tables.bladeCount > enough)
        return 0.0f;
    float least = std::numeric_limits<float>::infinity();
    for (const auto& [unit, present] : present_)
        if (present.place.bladeCount > 0)
            least = std::min(least, present.score);
    return least * replacing;
}

/// A place for a unit, for which others may have to go.
std::optional<SownTables::Place> Sowing::placeFor(const field::UnitPatches& unit, float score,
                                                  Edit& edit)
{
    std::optional<SownTables::Place> place = tables_->add(unit, edit);
    while (!place && makeRoom(score, edit))
        place = tables_->add(unit, edit);
    return place;
}

/// Puts grown units into the tables, the most wanted first. While a frame waits, a unit comes after
/// all that are wanted more: the places of blades depend on the order, and pictures of one camera
/// shall be the same in every run.
void Sowing::takeIn(Edit& edit)
{
    const VkDeviceSize most = settings_.waits ? waitingBytes : frameBytes;
    missing_ = 0;
    bool isInOrder = true;
    for (const SowChoice::Wanted& one : wanted_) {
        if (!one.isCell && isThere(one.unit))
            continue;
        const auto landed = one.isCell ? landed_.end() : landed_.find(one.unit);
        const auto grown = one.isCell ? ready_.end() : ready_.find(one.unit);
        ++missing_;
        isInOrder = isInOrder && grown != ready_.end();
        if (isFull_ || (landed == landed_.end() &&
                        (grown == ready_.end() || (settings_.waits && !isInOrder) || copied_ >= most)))
            continue;
        if (const auto stale = present_.find(one.unit); stale != present_.end()) {
            if (stale->second.place.bladeCount > 0)
                tables_->remove(stale->second.place, edit);
            present_.erase(stale);
        }
        const bool hasLanded = landed != landed_.end();
        const field::UnitPatches& unit = hasLanded ? landed->second.unit : grown->second;
        if (unit.patches.empty()) {
            present_[one.unit] = {};
            --missing_;
            continue;
        }
        const std::optional<SownTables::Place> place = placeFor(unit, one.score, edit);
        if (!place) {
            isFull_ = true;
            continue;
        }
        --missing_;
        present_[one.unit] = {*place, one.score};
        if (hasLanded) {
            device_->place(landed->second, place->blades.first);
        } else {
            edit.blades.push_back({place->blades.first, grown->second.blades});
            copied_ += grown->second.blades.size() * sizeof(shared::PackedBlade);
        }
    }
    // Forgets grown units that no eye wants any more.
    if (ready_.size() > 2 * maxJobs)
        std::erase_if(ready_, [&](const auto& one) {
            return !isThere(one.first) &&
                   std::ranges::find(wanted_, one.first, &SowChoice::Wanted::unit) == wanted_.end();
        });
}

/// Removes the unit that is wanted least, if that is wanted less than `score`. Units come in
/// falling order of scores, so none is removed that the same edit has brought.
bool Sowing::makeRoom(float score, Edit& edit)
{
    auto least = present_.end();
    for (auto one = present_.begin(); one != present_.end(); ++one)
        if (one->second.place.bladeCount > 0 &&
            (least == present_.end() || one->second.score < least->second.score))
            least = one;
    if (least == present_.end() || least->second.score * replacing >= score)
        return false;
    tables_->remove(least->second.place, edit);
    present_.erase(least);
    return true;
}

/// Gives the workers what is wanted and neither in the tables nor grown.
void Sowing::ask()
{
    std::vector<SowWorkers::Job> jobs;
    const float enough = device_ ? replaceable() : 0.0f;
    for (const SowChoice::Wanted& one : wanted_) {
        if (jobs.size() >= maxJobs || isFull_ || one.score <= enough)
            break;
        if (one.isCell)
            jobs.push_back({choice_.indexOf(one.unit.cell), std::nullopt});
        else if (!isKnown(one.unit))
            jobs.push_back({choice_.indexOf(one.unit.cell), one.unit,
                            device_ != nullptr && !refused_.contains(one.unit)});
    }
    hasAsked_ = !jobs.empty();
    workers_.want(std::move(jobs));
}

/// Finds the highest score, and the nearest place, of what the views draw and is not there.
void Sowing::findMissing(std::span<const shared::Eyepoint> views)
{
    nearestMissing_ = std::numeric_limits<float>::infinity();
    missingScore_ = 0.0f;
    for (const SowChoice::Wanted& one : wanted_) {
        if (!one.isCell && present_.contains(one.unit))
            continue;
        const float score = one.isCell ? one.score : choice_.scoreOf(one.unit, views);
        if (score <= 1.0f)
            continue;
        missingScore_ = std::max(missingScore_, score);
        const Aabb box = field::boxOf(one.unit);
        for (const shared::Eyepoint& view : views)
            nearestMissing_ =
                std::min(nearestMissing_, shared::boxDistance(view.eye, box.low, box.high));
    }
}

/// Forgets far units that bear nothing, once there are many; eyes may ask for them again.
void Sowing::forgetBare()
{
    constexpr std::size_t maxPresent = 1U << 16U;
    if (present_.size() > maxPresent)
        std::erase_if(present_, [](const auto& one) {
            return one.second.place.bladeCount == 0 && one.second.score < 1.0f;
        });
}

void Sowing::record(const gpu::Recording& commands, const BakedBlades& baked,
                    std::span<const BladeStates* const> states, std::uint32_t settledAt,
                    std::uint32_t slot)
{
    staged_.record(commands, baked, states, settledAt, slot);
    if (device_)
        device_->record(commands, baked.blades());
}

std::uint64_t Sowing::residentBlades() const
{
    return std::uint64_t(tables_->storedBlades()) + tables_->sownBlades();
}

SownTables::Resident Sowing::residentAt(const field::SowUnit& unit,
                                    const SownTables::Place& place) const
{
    return {unit, tables_->tables().patches.subspan(place.patches.first, place.patches.count)};
}

std::vector<SownTables::Resident> Sowing::residents() const
{
    std::vector<SownTables::Resident> found;
    for (const auto& [unit, present] : present_)
        if (present.place.bladeCount > 0)
            found.push_back(residentAt(unit, present.place));
    return found;
}

std::optional<SownTables::Resident> Sowing::residentOf(const field::SowUnit& unit) const
{
    const auto found = present_.find(unit);
    if (found == present_.end() || found->second.place.bladeCount == 0)
        return std::nullopt;
    return residentAt(unit, found->second.place);
}

field::GrownUnit Sowing::grownAgain(const field::SowUnit& unit)
{
    return workers_.grow({choice_.indexOf(unit.cell), unit});
}

std::uint64_t Sowing::visiblePatches(const shared::Eyepoint& view) const
{
    const FieldTables tables = tables_->tables();
    std::uint64_t sum = tables_->storedPatches() + (stored_ ? stored_->patchCount() : 0);
    for (const auto& [unit, present] : present_) {
        if (present.place.bladeCount == 0)
            continue;
        const std::uint32_t root = present.place.root;
        if (!shared::patchCulled(view, tables.patches[root], tables.subtrees[root].widest))
            sum += present.place.patches.count;
    }
    return sum;
}

StreamingStats Sowing::stats() const
{
    constexpr std::uint64_t page = shared::pageBlades;
    const FieldTables tables = tables_->tables();
    return {.pages = allBlades_ / page,
            .places = tables.bladeRoom / page,
            .residentPages = residentBlades() / page,
            .residentBlades = residentBlades(),
            .wantedPages = wanted_.size(),
            .missingPages = missing_,
            .nearestMissing = nearestMissing_,
            .copiedBytes = copied_,
            .thinning = std::max(thinning_, 1.0f),
            .isSettled = isSettled_};
}

VkDeviceSize Sowing::bytes() const
{
    return staged_.bytes() + (device_ ? device_->bytes() : 0);
}

} // namespace sward::render
