#include "render/streaming/residency.h"

#include "core/expect.h"
#include "render/field/patch_tree.h"
#include "shaders/shared/visibility.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>
#include <utility>

namespace sward::render {
namespace {

using shared::noPlace;
using shared::pageBlades;

/// Grades are a quarter of an octave apart, so that small moves of the eye keep most pages in their
/// grade.
constexpr float gradesPerOctave = 4.0f;

/// Grades above it: visible patches with at least one blade drawn by level of detail.
constexpr std::uint8_t seenGrade = 8;

/// Grade of the coarsest blades everywhere, which represent all others.
constexpr std::uint8_t coarseGrade = 72;
constexpr std::uint32_t gradeCount = coarseGrade + 1;

/// Minimum worth of a patch: its first blade would be drawn at half the distance.
constexpr float minWorth = 0.5f;

/// Maximum factor on the level-of-detail width. Wider blades would look like other blades; beyond
/// it, missing blades leave gaps in the picture.
constexpr float maxThinning = 8.0f;

constexpr std::uint32_t outsideBit = 0x80000000u;

/// Maximum places examined for a page that may leave.
constexpr std::uint32_t maxLooks = 4096;

/// `worth`: seen width of the patch's blades over the width at which level of detail draws its
/// first one.
std::uint8_t gradeOf(float worth, float rank, bool outside)
{
    if (rank <= 0.0f)
        return coarseGrade;
    const bool isSeen = !outside && worth > 1.0f;
    // Invisible patches, near before far, rank below all visible ones.
    const float score = isSeen ? worth : worth / (1.0f + worth);
    const float grade = std::ceil(gradesPerOctave * std::log2(score)) + seenGrade;
    return static_cast<std::uint8_t>(std::clamp(grade, 0.0f, float(coarseGrade - 1)));
}

} // namespace

Residency::Residency(const field::FieldView& field, std::uint32_t places)
    : field_(field)
    , subtrees_(subtreesOf(field.patches))
    , pages_((field.blades.size() + pageBlades - 1) / pageBlades)
    , pageAt_(places, noPlace)
    , wanted_(gradeCount)
{
    expect(places > 0, "there is room for a page");
    free_.reserve(places);
    for (std::uint32_t place = places; place-- > 0;)
        free_.push_back(place);
    queue_.reserve(field.patches.size());
    missing_.reserve(pages_.size());
    order_.reserve(pages_.size());
    for (const shared::Patch& cell : field.patches) {
        if (cell.bladeCount == 0)
            continue;
        Page& first = pages_[cell.firstBlade / pageBlades];
        const std::uint32_t inFirst =
            std::min(pageBlades - cell.firstBlade % pageBlades, cell.bladeCount);
        ++first.begun;
        if (inFirst == cell.bladeCount)
            continue;
        first.high = static_cast<std::uint16_t>(inFirst);
        pages_[cell.firstBlade / pageBlades + 1].low =
            static_cast<std::uint16_t>(cell.bladeCount - inFirst);
    }
}

bool Residency::survey(std::span<const shared::Eyepoint> views, float threshold, std::uint32_t most)
{
    expect(!views.empty(), "someone looks");
    if (field_.patches.empty())
        return true;
    if (visited_ == queue_.size()) {
        // Unchanged views without missing pages need no survey, unless a wanted page left.
        const bool isSame = views.size() == views_.size() &&
                            std::memcmp(views.data(), views_.data(), views.size_bytes()) == 0;
        if (isSame && !lacks() && !hasGivenUp_)
            return true;
        hasGivenUp_ = false;
        fruitless_ = isSame ? fruitless_ : 0;
        views_.assign(views.begin(), views.end());
        threshold_ = threshold;
        queue_.clear();
        queue_.push_back(0);
        visited_ = 0;
        ++number_;
        std::ranges::fill(wanted_, 0u);
        missing_.clear();
    }
    for (; most > 0 && visited_ < queue_.size(); --most)
        visit(queue_[visited_++]);
    if (visited_ < queue_.size())
        return false;
    finish();
    return true;
}

void Residency::visit(std::uint32_t entry)
{
    const std::uint32_t node = entry & ~outsideBit;
    const shared::Patch& cell = field_.patches[node];
    const shared::Subtree& below = subtrees_[node];
    const bool isBelowOutside = (entry & outsideBit) != 0;
    bool outside = true;
    bool wants = false;
    bool descends = false;
    std::uint8_t grade = 0;
    for (const shared::Eyepoint& view : views_) {
        const bool outsideOfView = isBelowOutside || shared::patchCulled(view, cell, below.widest);
        const float distance = shared::boxDistance(view.eye, cell.boundsLow, cell.boundsHigh);
        const float width = view.lodWidth * view.pixelsPerUnit / std::max(distance, 1e-6f);
        const float share = width / std::max(threshold_, 1e-6f);
        const auto worthOf = [share](float rank) { return share / std::max(rank, 1e-6f); };
        if (cell.bladeCount > 0 && worthOf(cell.rankLow) > minWorth) {
            wants = true;
            grade = std::max(grade, gradeOf(worthOf(cell.rankLow), cell.rankLow, outsideOfView));
        }
        descends = descends || worthOf(below.rankBelow) > minWorth;
        outside = outside && outsideOfView;
    }
    if (wants)
        want(cell, grade);
    if (cell.childCount == 0 || !descends)
        return;
    for (std::uint32_t child = 0; child < cell.childCount; ++child)
        queue_.push_back((cell.firstChild + child) | (outside ? outsideBit : 0u));
}

void Residency::want(const shared::Patch& cell, std::uint8_t grade)
{
    const std::uint32_t last = (cell.firstBlade + cell.bladeCount - 1) / pageBlades;
    for (std::uint32_t index = cell.firstBlade / pageBlades; index <= last; ++index) {
        Page& page = pages_[index];
        if (page.survey != number_) {
            page.survey = number_;
            page.grade = grade;
            ++wanted_[grade];
            if (page.state != State::there)
                missing_.push_back(index);
        } else if (grade > page.grade) {
            --wanted_[page.grade];
            ++wanted_[grade];
            page.grade = grade;
        }
    }
}

void Residency::finish()
{
    lastNumber_ = number_;
    seenPages_ = std::accumulate(wanted_.begin() + seenGrade + 1, wanted_.end(), 0u);
    // Find the lowest grade whose pages fit as a whole.
    std::uint64_t total = 0;
    std::uint32_t grade = gradeCount;
    while (grade > 0 && total + wanted_[grade - 1] <= pageAt_.size())
        total += wanted_[--grade];
    minGrade_ = static_cast<std::uint8_t>(grade == 0 ? 0 : grade - 1);

    // Sort by grade, best first; equal ones in level order.
    std::vector<std::uint32_t>& ends = wanted_; // reused: its counts are no longer needed
    std::ranges::fill(ends, 0u);
    for (const std::uint32_t page : missing_)
        ++ends[pages_[page].grade];
    std::uint32_t before = 0;
    for (std::uint32_t g = gradeCount; g-- > 0;)
        before += std::exchange(ends[g], before);
    order_.resize(missing_.size());
    for (const std::uint32_t page : missing_)
        order_[ends[pages_[page].grade]++] = page;
    requested_ = 0;
    firstMissing_ = 0;
    skipPresent();
}

// Skips pages that have arrived during the survey.
void Residency::skipPresent()
{
    while (firstMissing_ < order_.size() && isThere(order_[firstMissing_]))
        ++firstMissing_;
}

std::optional<std::uint32_t> Residency::next()
{
    while (requested_ < order_.size() && pages_[order_[requested_]].state != State::absent)
        ++requested_;
    if (requested_ == order_.size() || pages_[order_[requested_]].grade < minGrade_)
        return std::nullopt;
    return order_[requested_++];
}

std::optional<std::uint32_t> Residency::take(std::uint32_t index)
{
    Page& page = pages_[index];
    expect(page.state == State::absent, "the page is not there");
    if (free_.empty())
        return std::nullopt;
    page.place = free_.back();
    page.state = State::coming;
    free_.pop_back();
    pageAt_[page.place] = index;
    return page.place;
}

shared::PageChange Residency::arrive(std::uint32_t index)
{
    expect(pages_[index].state == State::coming, "the page is on its way");
    pages_[index].state = State::there;
    ++residentPages_;
    skipPresent();
    return change(index, true);
}

std::optional<Residency::Gone> Residency::leave(std::uint32_t waiting)
{
    if (requested_ + waiting >= order_.size())
        return std::nullopt;
    const std::uint8_t better = pages_[order_[requested_ + waiting]].grade;
    if (better < minGrade_)
        return std::nullopt;
    for (std::uint32_t looks = 0; looks < maxLooks && fruitless_ < pageAt_.size();
         ++looks, ++fruitless_) {
        const std::uint32_t index = pageAt_[hand_];
        hand_ = (hand_ + 1) % static_cast<std::uint32_t>(pageAt_.size());
        if (index == noPlace || pages_[index].state != State::there)
            continue;
        Page& page = pages_[index];
        const bool isWanted = page.survey >= lastNumber_;
        if (isWanted && (page.grade > minGrade_ || page.grade >= better))
            continue;
        pageAt_[page.place] = noPlace;
        page.state = State::leaving;
        --residentPages_;
        hasGivenUp_ = hasGivenUp_ || isWanted;
        fruitless_ = 0;
        return Gone{change(index, false), page.place};
    }
    return std::nullopt;
}

void Residency::free(const Gone& gone)
{
    expect(pages_[gone.change.page].state == State::leaving, "the page has left");
    pages_[gone.change.page].state = State::absent;
    free_.push_back(gone.place);
}

bool Residency::isThere(std::uint32_t page) const
{
    return page < pages_.size() && pages_[page].state == State::there;
}

shared::PageChange Residency::change(std::uint32_t index, bool comes)
{
    // A patch on two pages is present only while both are.
    const Page& page = pages_[index];
    const bool low = page.low > 0 && isThere(index - 1);
    const bool high = page.high > 0 && isThere(index + 1);
    const std::size_t own =
        std::min<std::size_t>(pageBlades, field_.blades.size() - std::size_t(index) * pageBlades);
    std::uint64_t blades = own - page.low - page.high;
    if (low)
        blades += std::uint32_t(page.low) + pages_[index - 1].high;
    if (high)
        blades += std::uint32_t(page.high) + pages_[index + 1].low;
    blades_ += comes ? blades : std::uint64_t(0) - blades;
    patches_ += comes ? page.begun : std::uint64_t(0) - page.begun;
    return {.page = index,
            .place = comes ? page.place * pageBlades : noPlace,
            .edges = (low ? shared::lowEdge : 0u) | (high ? shared::highEdge : 0u)};
}

// Whether wanted pages that fit, wholly or in part, are missing.
bool Residency::lacks() const
{
    return firstMissing_ < order_.size() && pages_[order_[firstMissing_]].grade >= minGrade_;
}

float Residency::thinning() const
{
    if (firstMissing_ == order_.size())
        return 1.0f;
    const int grade = pages_[order_[firstMissing_]].grade;
    return std::clamp(std::exp2(static_cast<float>(grade - seenGrade) / gradesPerOctave), 1.0f,
                      maxThinning);
}

std::uint32_t Residency::missingPages() const
{
    return static_cast<std::uint32_t>(std::count_if(
        order_.begin() + static_cast<std::ptrdiff_t>(firstMissing_), order_.end(),
        [this](std::uint32_t page) { return pages_[page].grade > seenGrade && !isThere(page); }));
}

std::uint32_t Residency::placeOf(std::uint32_t page) const
{
    return isThere(page) ? pages_[page].place * pageBlades : noPlace;
}

} // namespace sward::render
