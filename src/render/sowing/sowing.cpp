#include "render/sowing/sowing.h"

#include "core/expect.h"
#include "shaders/shared/pages.h"
#include "shaders/shared/visibility.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <limits>
#include <utility>

namespace sward::render {
namespace {

/// Maximum change of thinning per frame, and the largest thinning: as Streaming.
constexpr float sowingStep = 1.1f;
constexpr float maxSownThinning = 8.0f;

/// Level-of-detail width for ranking units if level of detail is off [pixels].
constexpr float sowingThreshold = 0.3f;

/// A unit replaces another one that is wanted less by this factor, so that a still eye changes
/// nothing.
constexpr float replacing = 1.19f;

/// An eye that moves less wants the same [m]: a twentieth of the finest unit.
constexpr float ignoredStep = 0.2f;

/// Jobs that wait at once: enough for all threads until the next frame.
constexpr std::size_t maxJobs = 256;

/// Units that a frame grows without threads.
constexpr std::uint32_t unitsOfFrame = 1;

void raiseThreshold(std::span<shared::Eyepoint> seen, float threshold)
{
    for (shared::Eyepoint& view : seen)
        view.lodThreshold = threshold;
}

} // namespace

double bladesPerArea(const field::SeedMeadow& meadow)
{
    double shares = 0.0;
    double blades = 0.0;
    for (const shared::SowSpecies& kind : meadow.species) {
        shares += double(kind.share);
        blades += double(kind.share) * (1.0 + double(kind.ribbons));
    }
    return meadow.density * (shares > 0.0 ? blades / shares : 1.0);
}

Sowing::Sowing(const gpu::DeviceContext& context, const gpu::ShaderLibrary& shaders,
               const field::FieldView& field, std::unique_ptr<SownTables> tables,
               const Settings& settings)
    : settings_(settings)
    , tables_(std::move(tables))
    , choice_(*field.seeds)
    , workers_(field, settings.threads)
    , staged_(context, shaders, settings.framesInFlight)
    , allBlades_(static_cast<std::uint64_t>(double(field.blades.size()) /
                                            std::max(field.seeds->meadow->stored, 1e-12)))
    , nearestMissing_(std::numeric_limits<float>::infinity())
{
    // A job counts by the shared::PackedBlade that it brings.
    settings_.frameBytes = std::max<VkDeviceSize>(settings_.frameBytes, 1);
}

void Sowing::choose(std::span<shared::Eyepoint> seen)
{
    expect(!seen.empty(), "someone looks");
    const float own = seen.front().lodThreshold;
    const float threshold = own > 0.0f ? own : sowingThreshold;
    const std::span<const shared::Eyepoint> ahead = motion_.ahead(seen);

    const bool hasChanged = copied_ > 0;
    copied_ = 0;
    for (bool again = true; again;) {
        again = false;
        const bool isNews = takeResults();
        if (!settings_.waits && !isNews && !hasChanged && !hasMoved(seen, ahead))
            break;
        bring(seen, ahead, threshold);
        if (settings_.waits && missing_ > 0 && !isFull_ && copied_ < settings_.frameBytes) {
            workers_.finish();
            again = true;
        }
    }
    if (settings_.threads == 0 && !settings_.waits)
        for (std::uint32_t i = 0; i < unitsOfFrame && workers_.run(); ++i) {
        }

    // The views draw no more than what is there.
    const float wanted = std::clamp(missingScore_, 1.0f, maxSownThinning);
    if (thinning_ == 0.0f || settings_.waits)
        thinning_ = wanted;
    else
        thinning_ = std::clamp(wanted, thinning_ / sowingStep, thinning_ * sowingStep);
    if (own > 0.0f)
        raiseThreshold(seen, own * thinning_);
    isSettled_ = copied_ == 0 && (missing_ == 0 || isFull_) && thinning_ == wanted;
}

/// Chooses anew, and changes the tables.
void Sowing::bring(std::span<const shared::Eyepoint> seen, std::span<const shared::Eyepoint> ahead,
                   float threshold)
{
    isFull_ = false;
    forgetBare();
    choice_.find(seen, ahead, threshold, wanted_);
    for (auto& [unit, present] : present_)
        present.score = choice_.scoreOf(unit, seen, ahead, threshold);
    Edit edit;
    takeIn(edit, settings_.waits);
    if (!edit.patches.empty()) {
        edit.patches = united(std::move(edit.patches));
        edit.entries = united(std::move(edit.entries));
        edit.firstEntries = united(std::move(edit.firstEntries));
        staged_.add(edit, tables_->tables());
        std::erase_if(ready_, [&](const auto& one) { return present_.contains(one.first); });
    }
    ask();
    missingScore_ = missingScore(seen, threshold);
}

/// Whether an eye has moved far enough since it was last asked to want something else.
bool Sowing::hasMoved(std::span<const shared::Eyepoint> seen,
                      std::span<const shared::Eyepoint> ahead)
{
    std::vector<shared::Eyepoint> now(seen.begin(), seen.end());
    now.insert(now.end(), ahead.begin(), ahead.end());
    const auto isNear = [](const shared::Eyepoint& a, const shared::Eyepoint& b) {
        return glm::distance(a.eye, b.eye) < ignoredStep && a.pixelsPerUnit == b.pixelsPerUnit &&
               a.lodThreshold == b.lodThreshold && a.lodWidth == b.lodWidth &&
               a.cullMask == b.cullMask && a.drawDistance == b.drawDistance &&
               a.sparseFrom == b.sparseFrom;
    };
    if (std::ranges::equal(now, looked_, isNear))
        return false;
    looked_ = std::move(now);
    return true;
}

/// Returns whether there were any.
bool Sowing::takeResults()
{
    std::vector<SowWorkers::Result> results = workers_.take();
    for (SowWorkers::Result& result : results) {
        choice_.know(result.cell, result.cubes);
        if (!result.unit)
            continue;
        const field::SowUnit unit = result.unit->unit;
        if (result.unit->patches.empty())
            present_[unit] = {};
        else
            ready_[unit] = std::move(*result.unit);
    }
    return !results.empty();
}

/// Brings wanted units, the most wanted first. What is wanted no longer is forgotten.
void Sowing::takeIn(Edit& edit, bool takesAll)
{
    missing_ = 0;
    bool isInOrder = true;
    for (const SowChoice::Wanted& one : wanted_) {
        if (!one.isCell && present_.contains(one.unit))
            continue;
        const auto grown = one.isCell ? ready_.end() : ready_.find(one.unit);
        ++missing_;
        // Places depend on the order, and pictures of one camera shall be the same in every run.
        isInOrder = isInOrder && grown != ready_.end();
        if (grown == ready_.end() || (takesAll && !isInOrder) || copied_ >= settings_.frameBytes ||
            isFull_)
            continue;
        std::optional<SownTables::Place> place = tables_->add(grown->second, edit);
        while (!place && makeRoom(one.score, edit))
            place = tables_->add(grown->second, edit);
        if (!place) {
            isFull_ = true;
            continue;
        }
        --missing_;
        present_[one.unit] = {*place, one.score};
        copied_ += grown->second.blades.size() * sizeof(shared::PackedBlade);
    }
    if (ready_.size() > 2 * maxJobs)
        std::erase_if(ready_, [&](const auto& one) {
            return !present_.contains(one.first) &&
                   std::ranges::find(wanted_, one.first, &SowChoice::Wanted::unit) == wanted_.end();
        });
}

/// Removes the unit that is wanted least, if it is wanted less than `score`.
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
    // What this edit has brought stays.
    present_.erase(least);
    return true;
}

/// Asks for what is wanted, not there and not grown.
void Sowing::ask()
{
    std::vector<SowWorkers::Job> jobs;
    for (const SowChoice::Wanted& one : wanted_) {
        if (jobs.size() >= maxJobs || isFull_)
            break;
        if (one.isCell)
            jobs.push_back({choice_.indexOf(one.unit.cell), std::nullopt});
        else if (!present_.contains(one.unit) && !ready_.contains(one.unit))
            jobs.push_back({choice_.indexOf(one.unit.cell), one.unit});
    }
    workers_.want(std::move(jobs));
}

/// The highest score of what these eyes want and is not there; 0 if nothing is missing.
float Sowing::missingScore(std::span<const shared::Eyepoint> seen, float threshold)
{
    nearestMissing_ = std::numeric_limits<float>::infinity();
    float most = 0.0f;
    for (const SowChoice::Wanted& one : wanted_) {
        if (!one.isCell && present_.contains(one.unit))
            continue;
        const float score = one.isCell ? one.score : choice_.scoreOf(one.unit, seen, {}, threshold);
        if (score <= 1.0f)
            continue;
        most = std::max(most, score);
        const Aabb box = field::boxOf(one.unit);
        for (const shared::Eyepoint& view : seen)
            nearestMissing_ =
                std::min(nearestMissing_, shared::boxDistance(view.eye, box.low, box.high));
    }
    return most;
}

/// Units that bear nothing are known; those far away may be asked for again.
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
}

std::uint64_t Sowing::residentBlades() const
{
    return std::uint64_t(tables_->storedBlades()) + tables_->sownBlades();
}

std::uint64_t Sowing::visiblePatches(const shared::Eyepoint& view) const
{
    const FieldTables tables = tables_->tables();
    std::uint64_t sum = tables_->storedPatches();
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

} // namespace sward::render
