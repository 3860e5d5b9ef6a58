#include "render/streaming/residency.h"

#include "core/expect.h"
#include "render/streaming/thinning.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <utility>

namespace sward::render {
namespace {

using shared::noPlace;
using shared::pageBlades;

/// A search that does not end within a frame's visits goes on for so many frames while eyes move;
/// its order is that of the first of them.
constexpr std::uint32_t maxSearchFrames = 8;

/// Frames for which the thinning of the last complete search holds.
constexpr std::uint32_t maxUnknownFrames = 32;

/// Frames after which residents are ranked anew.
constexpr std::uint32_t maxRankedFrames = 64;

/// A view has been cut if its eye has moved by more [m], or its direction by more (cosine), since
/// the search began.
constexpr float cutDistance = 16.0f;
constexpr float cutCosine = 0.98f;

bool areSame(std::span<const shared::Eyepoint> a, std::span<const shared::Eyepoint> b)
{
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size_bytes()) == 0;
}

/// The same, whatever the level of detail.
bool areAlike(std::span<const shared::Eyepoint> a, std::span<const shared::Eyepoint> b)
{
    return std::ranges::equal(a, b, [](shared::Eyepoint one, const shared::Eyepoint& other) {
        one.lodThreshold = other.lodThreshold;
        return std::memcmp(&one, &other, sizeof one) == 0;
    });
}

} // namespace

Residency::Residency(const field::FieldView& field, std::uint32_t places)
    : tree_(field)
    , missing_(tree_, scores_)
    , resident_(tree_, scores_)
{
    expect(places > 0, "there is room for a page");
    free_.reserve(places);
    left_.reserve(places);
    for (std::uint32_t place = places; place-- > 0;)
        free_.push_back(place);
}

void Residency::look(std::span<const shared::Eyepoint> views,
                     std::span<const shared::Eyepoint> ahead, float threshold, std::uint32_t visits)
{
    expect(!views.empty(), "someone looks");
    const bool isBehind = visits_.granted > 0 && visits_.isSpent();
    const bool isCut = hasCut(views);
    isAfterCut_ = isCut;
    if (isCut)
        unknownFrames_ = maxUnknownFrames;
    isStill_ = ahead.empty() && areAlike(views, scores_.views());
    scores_.look(views, ahead, threshold);
    visits_ = {visits, 0};
    for (const std::uint32_t page : left_)
        tree_.free(page);
    left_.clear();

    // Rank residents anew from time to time; the next one to leave in each frame.
    hasRestarted_ = false;
    hasMoreVisits_ = false;
    resident_.look();
    if (isCut || (!isStill_ && (isRankExact_ || (victim_ && ++rankedFrames_ > maxRankedFrames)))) {
        rank(false);
    } else if (victim_) {
        victim_ = resident_.scored(victim_->page, visits_);
    }

    // Search anew unless the last search holds, or goes on.
    const bool isOfThese =
        ahead.empty() && !hasBegunMoving_ && isStill_ == hasBegunStill_ && !hasPostponed_;
    const bool holds = isOfThese && areSame(views, begunWith_);
    const bool goesOn = !isSearched_ && ((isOfThese && areAlike(views, begunWith_)) ||
                                         (isBehind && ++frames_ < maxSearchFrames));
    if (isCut || (!holds && !goesOn))
        beginSearch(!ahead.empty());
}

/// Whether the views are others than those with which the search began, more than by a flight.
bool Residency::hasCut(std::span<const shared::Eyepoint> views) const
{
    if (views.size() != begunWith_.size())
        return true;
    for (std::size_t i = 0; i < views.size(); ++i) {
        const shared::Eyepoint& before = begunWith_[i];
        if (glm::distance(views[i].eye, before.eye) > cutDistance)
            return true;
        for (const std::size_t side : {0u, 2u})
            if (glm::dot(glm::vec3(views[i].planes[side]), glm::vec3(before.planes[side])) <
                cutCosine)
                return true;
    }
    return false;
}

/// Begins to rank resident pages for leaving.
void Residency::rank(bool isExact)
{
    rankedFrames_ = 0;
    isRankExact_ = isExact;
    victim_.reset();
    resident_.begin(isExact);
}

void Residency::beginSearch(bool isMoving)
{
    const std::span<const shared::Eyepoint> views = scores_.views();
    begunWith_.assign(views.begin(), views.end());
    hasBegunMoving_ = isMoving;
    hasBegunStill_ = isStill_;
    frames_ = 0;
    second_.reset();
    held_.reset();
    hasPostponed_ = false;
    isSearched_ = false;
    missing_.begin();
}

MissingSearch::Floor Residency::floor() const
{
    // While eyes move, bounds that exceed the floor by little are not looked into: a later frame
    // does when they exceed it by more.
    MissingSearch::Floor floor;
    floor.margin = hasBegunStill_ ? 1.0f : margin;
    if (free_.empty() && victim_)
        floor.patches = std::max(floor.patches, margin * victim_->score);
    if (!hasBegunStill_)
        floor.inSight = margin * margin * margin * margin * PageScores::lowest;
    return floor;
}

std::optional<Residency::Wanted> Residency::next()
{
    for (std::optional<Wanted>* kept : {&held_, &second_})
        if (*kept) {
            const Wanted wanted = **kept;
            kept->reset();
            if (tree_.state(wanted.page) == PageTree::State::absent)
                return wanted;
        }
    if (isSearched_)
        return std::nullopt;
    while (const auto found = missing_.next(floor(), visits_)) {
        const shared::Patch& cell = tree_.patch(found->patch);
        const std::uint32_t pages[]{PageTree::firstPage(cell), PageTree::lastPage(cell)};
        const bool isFirst = tree_.state(pages[0]) == PageTree::State::absent;
        const bool isSecond =
            pages[1] != pages[0] && tree_.state(pages[1]) == PageTree::State::absent;
        if (isFirst && isSecond)
            second_ = Wanted{pages[1], found->score, found->drawn};
        if (isFirst || isSecond)
            return Wanted{isFirst ? pages[0] : pages[1], found->score, found->drawn};
        // It is leaving.
        missing_.leaveOut(found->drawn);
        hasPostponed_ = true;
    }
    isSearched_ = missing_.isDone();
    return std::nullopt;
}

std::optional<std::uint32_t> Residency::take(std::uint32_t page)
{
    if (free_.empty())
        return std::nullopt;
    const std::uint32_t place = free_.back();
    free_.pop_back();
    tree_.take(page, place);
    visits_.granted += VisitBudget::perPage;
    return place;
}

void Residency::postpone(const Wanted& wanted)
{
    missing_.leaveOut(wanted.drawn);
    hasPostponed_ = true;
}

shared::PageChange Residency::arrive(std::uint32_t page)
{
    return tree_.arrive(page);
}

/// Finds the next page to leave; false if there is none, or none yet.
bool Residency::findVictim()
{
    while (!victim_) {
        victim_ = resident_.next(visits_);
        if (!victim_ && !resident_.isDone() && !std::exchange(hasMoreVisits_, true)) {
            visits_.granted = std::max(visits_.granted, visits_.used) + VisitBudget::forRanking;
            continue;
        }
        if (victim_)
            break;
        if (!resident_.isDone() || hasRestarted_)
            return false;
        hasRestarted_ = true;
        rank(isRankExact_);
    }
    return true;
}

std::optional<Residency::Gone> Residency::leave(const Wanted& wanted)
{
    bool isFound = findVictim();
    if (isFound && margin * victim_->score >= wanted.score && isStill_ && !isRankExact_) {
        // There is time to look closer.
        rank(true);
        isFound = findVictim();
    }
    if (!isFound) {
        // Continue in the next frame with the same page.
        held_ = wanted;
        return std::nullopt;
    }
    if (margin * victim_->score >= wanted.score) {
        missing_.leaveOut(wanted.drawn);
        missing_.end();
        second_.reset();
        isSearched_ = true;
        return std::nullopt;
    }
    const std::uint32_t page = victim_->page;
    const std::uint32_t place = tree_.placeOf(page);
    missing_.leaveOut(victim_->drawn);
    victim_.reset();
    return Gone{tree_.leave(page), place};
}

void Residency::free(const Gone& gone)
{
    left_.push_back(gone.change.page);
    free_.push_back(gone.place);
}

void Residency::finish()
{
    // What is missing most: what no page could come for, and all that has not been looked into.
    if (!isSearched_ && !held_ && !second_)
        held_ = next();
    float missing = missing_.drawnMissing();
    for (const std::optional<Wanted>* waiting : {&held_, &second_})
        missing = std::max(missing, *waiting ? (*waiting)->drawn : 0.0f);
    // Bounds of a search that is interrupted are far too high: the last result holds for a while.
    const bool isKnown = isSearched_ || !visits_.isSpent();
    if (!isKnown && ++unknownFrames_ < maxUnknownFrames)
        return;
    unknownFrames_ = 0;
    thinning_ = std::clamp(missing, 1.0f, maxThinning);
}

std::uint32_t Residency::placeOf(std::uint32_t page) const
{
    const std::uint32_t place = tree_.placeOf(page);
    return place == noPlace ? noPlace : place * pageBlades;
}

} // namespace sward::render
