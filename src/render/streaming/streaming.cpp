#include "render/streaming/streaming.h"

#include "core/expect.h"
#include "gpu/recording/barrier.h"
#include "render/frame/shader_names.h"
#include "render/streaming/thinning.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <span>

namespace sward::render {
namespace {

using shared::pageBlades;

constexpr VkDeviceSize pageBytes = pageBlades * sizeof(shared::PackedBlade);

/// Nodes of the patch tree visited per frame for one eye, besides those for the pages that come:
/// less than 0.1 ms.
constexpr std::uint32_t nodesPerFrame = 512;

/// The least for each of many eyes.
constexpr std::uint32_t minNodes = 64;

/// Batches for the copy queue: one being filled, one in flight, one that has arrived.
constexpr std::uint32_t queuedBatches = 3;

std::uint32_t pagesPerFrame(const Streaming::Settings& settings)
{
    return static_cast<std::uint32_t>(std::max<VkDeviceSize>(settings.frameBytes / pageBytes, 1));
}

std::uint32_t batchesOf(const Streaming::Settings& settings)
{
    return std::max(settings.framesInFlight, queuedBatches);
}

/// At most as many pages leave as arrive; with a queue all batches may arrive together.
VkDeviceSize maxChanges(const Streaming::Settings& settings)
{
    return VkDeviceSize(pagesPerFrame(settings)) * (batchesOf(settings) + 1);
}

} // namespace

Streaming::Streaming(const gpu::DeviceContext& context, const gpu::ShaderLibrary& shaders,
                     const field::FieldView& field, const BakedBlades& blades,
                     const Settings& settings)
    : blades_(blades)
    , settings_(settings)
    , residency_(field, blades.placeCount() / pageBlades)
    , census_(residency_.tree())
    , reader_(field, settings.waitsForDisk)
    , copies_(context, blades.blades(), pagesPerFrame(settings) * pageBytes, batchesOf(settings),
              settings.usesCopyQueue)
    , change_(context, shaders,
              {.name = "change pages",
               .shader = shader::changePages,
               .pushConstantBytes = sizeof(shared::PagePush)})
    , frames_(settings.framesInFlight)
    , coming_(copies_.batches())
{
    for (InFlight& frame : frames_)
        frame.changes =
            gpu::Buffer(context, {.name = "frame/page changes",
                                  .bytes = maxChanges(settings) * sizeof(shared::PageChange),
                                  .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                                  .memory = gpu::MemoryUse::upload});
    for (auto& pages : coming_)
        pages.reserve(pagesPerFrame(settings));
    left_.reserve(blades.placeCount() / pageBlades);
}

void Streaming::choose(std::span<shared::Eyepoint> seen, std::uint32_t slot)
{
    expect(slot < frames_.size(), "the slot is one of the frames in flight");
    expect(!seen.empty(), "someone looks");
    InFlight& frame = frames_[slot];
    done_ = std::max(done_, frame.number);
    frame.number = ++frame_;
    frame.count = 0;
    copied_ = 0;

    // Choose by what is drawn now, and by where the eyes will be.
    const float threshold = seen.front().lodThreshold;
    if (thinning_ > 0.0f)
        setThreshold(seen, threshold * thinning_);
    const std::span<const shared::Eyepoint> ahead = motion_.ahead(seen);
    const auto eyes = static_cast<std::uint32_t>(seen.size() + ahead.size());

    // The place of a page that has left is free once no frame reads it.
    const auto stillRead =
        std::ranges::find_if(left_, [this](const Left& left) { return left.frame > done_; });
    std::for_each(left_.begin(), stillRead,
                  [this](const Left& left) { residency_.free(left.gone); });
    left_.erase(left_.begin(), stillRead);
    residency_.look(seen, ahead, threshold > 0.0f ? threshold : rankingThreshold,
                    std::max(nodesPerFrame / eyes, minNodes));

    reader_.begin();

    // Request pages, then mark those as resident that have arrived: none leaves in the same frame.
    if (!copies_.hasQueue()) {
        copies_.begin(slot);
        fill(frame, slot);
        takeIn(frame, slot);
    } else {
        const auto idle =
            std::ranges::find_if(coming_, [](const auto& pages) { return pages.empty(); });
        const auto filled = static_cast<std::uint32_t>(idle - coming_.begin());
        if (idle != coming_.end()) {
            copies_.begin(filled);
            fill(frame, filled);
            if (!idle->empty())
                copies_.submit(filled);
        }
        for (std::uint32_t batch = 0; batch < copies_.batches(); ++batch)
            if (batch != filled && !coming_[batch].empty() && copies_.isDone(batch))
                takeIn(frame, batch);
    }
    residency_.finish();
    frame.resident = residency_.tree().blades();

    const float wanted = residency_.thinning();
    thinning_ = nextThinning(thinning_, wanted);
    setThreshold(seen, threshold * thinning_);
    const bool isOnItsWay = std::ranges::any_of(coming_, [](const auto& p) { return !p.empty(); });
    isSettled_ = frame.count == 0 && left_.empty() && !isOnItsWay && thinning_ == wanted &&
                 residency_.isAllThere();
}

void Streaming::note(InFlight& frame, const shared::PageChange& change)
{
    const auto changes = frame.changes.mappedAs<shared::PageChange>();
    expect(frame.count < changes.size(), "there is room for a frame's changes");
    changes[frame.count++] = change;
}

void Streaming::takeIn(InFlight& frame, std::uint32_t batch)
{
    for (const std::uint32_t page : coming_[batch])
        note(frame, residency_.arrive(page));
    coming_[batch].clear();
}

void Streaming::fill(InFlight& frame, std::uint32_t batch)
{
    // All that a frame may bring is used as long as pages are missing; in a flight a few frames
    // after the first of them, so that no frame takes much longer than those before.
    const std::uint32_t all = pagesPerFrame(settings_);
    const bool isHasty = residency_.freePlaces() > 0 || residency_.isAfterCut();
    const std::uint32_t most = isHasty ? all : std::clamp(nextPages_, (all + 4) / 5, all);
    fillWithin(frame, batch, most);
    const auto came = static_cast<std::uint32_t>(coming_[batch].size());
    nextPages_ = came < most ? 0 : most + (all + 15) / 16;
}

void Streaming::fillWithin(InFlight& frame, std::uint32_t batch, std::uint32_t most)
{
    std::uint32_t unread = 0;
    std::uint32_t waiting = 0;
    while (coming_[batch].size() < most && unread < most) {
        const std::optional<Residency::Wanted> wanted = residency_.next();
        if (!wanted)
            return;
        if (!reader_.isReadable(wanted->page)) {
            residency_.postpone(*wanted);
            ++unread;
            continue;
        }
        if (residency_.freePlaces() == 0 && !makeRoom(frame, *wanted, ++waiting))
            return;
        if (residency_.freePlaces() > 0)
            copy(batch, wanted->page);
        else
            residency_.postpone(*wanted);
    }
}

/// Evicts a page for the `waiting`-th wanted one without a place; false if there is none.
bool Streaming::makeRoom(InFlight& frame, const Residency::Wanted& wanted, std::uint32_t waiting)
{
    // The copy queue may overtake frames that still read the page; places that others have left
    // become free in a later frame.
    const bool isLater = copies_.hasQueue();
    if (isLater && waiting <= left_.size())
        return true;
    if (frame.count == pagesPerFrame(settings_)) {
        residency_.postpone(wanted);
        return false;
    }
    const std::optional<Residency::Gone> gone = residency_.leave(wanted);
    if (!gone)
        return false;
    note(frame, gone->change);
    if (isLater)
        left_.push_back({*gone, frame.number});
    else
        residency_.free(*gone);
    return true;
}

void Streaming::copy(std::uint32_t batch, std::uint32_t page)
{
    const std::optional<std::uint32_t> place = residency_.take(page);
    expect(place.has_value(), "a place is free");
    const std::span<const std::byte> bytes = reader_.bytes(page);
    const auto room = copies_.add(batch, *place * pageBytes, bytes.size());
    expect(room.size() == bytes.size(), "the batch has room");
    std::memcpy(room.data(), bytes.data(), bytes.size());
    copied_ += bytes.size();
    coming_[batch].push_back(page);
}

void Streaming::record(const gpu::Recording& commands, std::uint32_t slot, std::uint32_t settledAt,
                       std::span<const BladeStates* const> states) const noexcept
{
    const InFlight& frame = frames_[slot];
    if (!copies_.hasQueue())
        copies_.record(commands, slot);
    if (frame.count == 0)
        return;
    change_.bind(commands);
    shared::PagePush push{.changes = frame.changes.address(),
                          .pages = blades_.pages(),
                          .states = 0,
                          .etas = 0,
                          .patches = blades_.patches(),
                          .subtrees = blades_.tree().subtrees(),
                          .patchTimes = 0,
                          .patchCounts = 0,
                          .nonEmptyPatches = blades_.nonEmptyPatches(),
                          .firstNonEmptyPatches = blades_.firstNonEmptyPatches(),
                          .nonEmptyPatchCount = blades_.nonEmptyPatchCount(),
                          .bladeCount = blades_.bladeCount(),
                          .settledAt = settledAt,
                          .isOfStates = 0};
    const auto dispatch = [&] {
        change_.push(commands, push);
        commands.vk->CmdDispatch(commands, frame.count, 1, 1);
    };
    dispatch();
    push.isOfStates = 1;
    for (const BladeStates* placed : states) {
        push.states = placed->states().address();
        push.etas = placed->etas().address();
        push.patchTimes = placed->patchTimes();
        push.patchCounts = placed->patchCounts();
        dispatch();
    }
}

StreamingStats Streaming::stats()
{
    census_.advance(residency_.scores());
    return {.pages = residency_.tree().pageCount(),
            .places = blades_.placeCount() / pageBlades,
            .residentPages = residency_.tree().residentPages(),
            .residentBlades = residency_.tree().blades(),
            .wantedPages = census_.wanted(),
            .missingPages = census_.missing(),
            .nearestMissing = nearestMissing(residency_.tree(), residency_.scores()),
            .copiedBytes = copied_,
            .thinning = std::max(thinning_, 1.0f),
            .isSettled = isSettled_};
}

std::vector<BladePart> Streaming::partsOf(const shared::Patch& cell) const
{
    std::vector<BladePart> parts;
    const std::uint32_t end = cell.firstBlade + cell.bladeCount;
    for (std::uint32_t blade = cell.firstBlade; blade < end;) {
        const std::uint32_t page = residency_.placeOf(blade / pageBlades);
        if (page == shared::noPlace)
            return {};
        const std::uint32_t inPage = blade % pageBlades;
        const std::uint32_t count = std::min(end - blade, pageBlades - inPage);
        parts.push_back({page + inPage, count});
        blade += count;
    }
    return parts;
}

std::optional<VkSemaphoreSubmitInfo> Streaming::copied() const
{
    if (!copies_.hasQueue())
        return std::nullopt;
    return copies_.copied();
}

VkDeviceSize Streaming::bytesFor(const Settings& settings)
{
    return batchesOf(settings) * pagesPerFrame(settings) * pageBytes +
           settings.framesInFlight * maxChanges(settings) * sizeof(shared::PageChange);
}

} // namespace sward::render
