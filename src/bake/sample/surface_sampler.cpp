#include "bake/sample/surface_sampler.h"

#include "bake/sample/search_limit.h"
#include "bake/sample/triangle_points.h"
#include "core/error.h"
#include "core/random.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>
#include <tbb/parallel_scan.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <mutex>

namespace sward::bake {
namespace {

// Candidates per block; one thread tests a block. The result does not depend on the size.
constexpr std::uint64_t candidatesPerBlock = 16384;

// Candidates that are tested to estimate the kept share, and the maximum for a count. The maximum
// gives up on ground that keeps fewer than one in a million.
constexpr double fewTrials = 1e5;
constexpr double manyTrials = 4e6;
constexpr double maxTrials = 1e8;

// A count tests a few more candidates than needed; their priority threshold is searched above this
// value.
constexpr double windowStart = 0.9;

// A count behind a filter that keeps less than this share is searched for within a SearchLimit.
constexpr double smallShare = 0.01;

// A candidate number has 31 bits per triangle side.
constexpr std::uint32_t maxCandidate = 2147483647;
constexpr auto maxCandidates = double(maxCandidate);

double random(std::uint64_t seed, field::BladeKey key, Dimension dimension)
{
    return uniform(seed, keyBits(key), static_cast<std::uint32_t>(dimension));
}

Aabb boxOfTriangle(const terrain::GroundMesh& ground, std::size_t triangle)
{
    Aabb box;
    for (glm::length_t corner = 0; corner < 3; ++corner)
        box.add(ground.positions[ground.triangles[triangle][corner]]);
    return box;
}

// The largest relative density that is painted in a box, or more.
double highestIn(const Aabb& box, const Painting* painting)
{
    return painting != nullptr && painting->mayRaise(box) ? painting->highest() : 1.0;
}

void add(std::array<std::uint64_t, rejectCount>& sum,
         const std::array<std::uint64_t, rejectCount>& more)
{
    for (std::size_t i = 0; i < rejectCount; ++i)
        sum[i] += more[i];
}

} // namespace

double bearingArea(const terrain::GroundMesh& ground, Sides sides)
{
    // Sum in fixed blocks, so that rounding does not depend on the number of threads.
    using Range = tbb::blocked_range<std::size_t>;
    constexpr std::size_t trianglesPerBlock = 8192;
    const double area = tbb::parallel_deterministic_reduce(
        Range(0, ground.triangles.size(), trianglesPerBlock), 0.0,
        [&](const Range& range, double sum) {
            for (std::size_t t = range.begin(); t < range.end(); ++t)
                sum += ground.bears[t] != 0 ? ground.area(t) : 0.0;
            return sum;
        },
        std::plus<>());
    return sides == Sides::both ? 2.0 * area : area;
}

double priorityOf(std::uint64_t seed, field::BladeKey key)
{
    return random(seed, key, Dimension::priority);
}

// Result of one block of candidates.
struct SurfaceSampler::Block {
    std::uint64_t proposed = 0;
    std::array<std::uint64_t, rejectCount> rejected{};
    std::uint64_t kept = 0;
};

// The candidates of a density, numbered consecutively. Entry i of `first` is the number of the
// first candidate of triangle i (and, if both sides bear, of its back at i + triangles).
struct SurfaceSampler::Tries {
    Amount amount;
    std::vector<std::uint64_t> first;

    std::uint64_t count() const { return first.back(); }
};

SurfaceSampler::SurfaceSampler(const terrain::GroundMesh& ground, const BakeSettings& settings,
                               const RootFilter& filter)
    : ground_(ground)
    , settings_(settings)
    , filter_(filter)
{
}

std::uint32_t SurfaceSampler::candidates(std::size_t triangle, double density, bool back) const
{
    const double share = density * ground_.area(triangle);
    const double count =
        std::floor(share + roundingShare(settings_.seed, ground_.source(triangle), back));
    if (count > maxCandidates)
        fail(ErrorKind::input, "triangle {} of {:.6g} m² would bear {:.6g} blades, more than {}",
             ground_.source(triangle), ground_.area(triangle), count, maxCandidates);
    return static_cast<std::uint32_t>(count);
}

std::vector<std::uint64_t>
SurfaceSampler::firstCandidates(double density, const TileRegion* counted, double around) const
{
    // One entry per bearing triangle side, then the total.
    const std::size_t triangles = ground_.triangles.size();
    const bool front = settings_.sides != Sides::back;
    const bool back = settings_.sides != Sides::front;
    std::vector<std::uint64_t> first(triangles * (front && back ? 2 : 1) + 1);
    tbb::parallel_for(std::size_t(0), triangles, [&](std::size_t t) {
        if (ground_.bears[t] == 0)
            return;
        const Aabb box = boxOfTriangle(ground_, t);
        if (counted != nullptr && around < unbounded && !counted->isNear(box, around))
            return;
        const double highest = density * highestIn(box, filter_.painting());
        if (front)
            first[t + 1] = candidates(t, highest, false);
        if (back)
            first[(front ? triangles : 0) + t + 1] = candidates(t, highest, true);
    });
    for (std::size_t i = 1; i < first.size(); ++i)
        first[i] += first[i - 1];
    return first;
}

// Calls visit(root, isMore) for the candidates numbered [begin, end); isMore: only strokes ask for
// it.
template <typename Visit>
void SurfaceSampler::forEachCandidate(const Tries& tries, std::uint64_t begin, std::uint64_t end,
                                      Visit visit) const
{
    const std::vector<std::uint64_t>& first = tries.first;
    const std::size_t triangles = ground_.triangles.size();
    const bool paints = filter_.painting() != nullptr && filter_.painting()->highest() > 1.0;
    // Triangle (and side) of the first candidate.
    auto slot = static_cast<std::size_t>(std::upper_bound(first.begin(), first.end(), begin) -
                                         first.begin() - 1);
    while (begin < end) {
        while (first[slot + 1] <= begin)
            ++slot;
        const bool back = settings_.sides == Sides::back || slot >= triangles;
        const std::size_t triangle = slot % triangles;
        const TrianglePoints points(ground_, triangle);
        const TriangleSequence sequence(settings_.seed, ground_.source(triangle), back);
        const std::uint32_t usual =
            paints ? candidates(triangle, tries.amount.density, back) : maxCandidate;
        const std::uint64_t last = std::min(first[slot + 1], end);
        for (; begin < last; ++begin) {
            const auto index = static_cast<std::uint32_t>(begin - first[slot]);
            const glm::vec2 place = sequence.at(index);
            visit(points.at(place.x, place.y, index | (back ? backSide : 0U)), index >= usual);
        }
    }
}

// Calls visit(index of the block, begin, end) for all blocks, several at a time.
template <typename Visit>
void SurfaceSampler::forEachBlock(const Tries& tries, Progress& progress, Visit visit) const
{
    const std::uint64_t total = tries.count();
    progress.begin("sample", total);
    tbb::parallel_for(std::uint64_t(0), (total + candidatesPerBlock - 1) / candidatesPerBlock,
                      [&](std::uint64_t block) {
                          const std::uint64_t begin = block * candidatesPerBlock;
                          const std::uint64_t end = std::min(begin + candidatesPerBlock, total);
                          visit(block, begin, end);
                          progress.advance(end - begin);
                      });
}

bool SurfaceSampler::hasPriority(const RootSample& root, const Amount& amount) const
{
    const field::BladeKey key = keyOf(ground_, root);
    return amount.takesAll() || std::pair(priorityOf(settings_.seed, key), keyBits(key)) <=
                                    std::pair(amount.priority, amount.lastKey);
}

bool SurfaceSampler::takes(const RootSample& root, const Amount& amount, bool counts,
                           Block& block) const
{
    if (!hasPriority(root, amount))
        return false;
    block.proposed += std::uint64_t(counts);
    const double chance = random(settings_.seed, keyOf(ground_, root), Dimension::chance);
    Reject reason = Reject::mask;
    if (filter_.paintedDensity(root, chance, reason) <= chance) {
        block.rejected[static_cast<std::size_t>(reason)] += std::uint64_t(counts);
        return false;
    }
    return isFree(root, counts, block);
}

// A candidate for which only strokes ask. It does not count as proposed where they do not.
bool SurfaceSampler::takesMore(const RootSample& root, const Amount& amount, bool counts,
                               Block& block) const
{
    if (!filter_.painting()->mayChangeDensity(root.position) || !hasPriority(root, amount))
        return false;
    const bool back = (root.candidate & backSide) != 0;
    const double number = double(root.candidate & ~backSide) + 1.0;
    // The relative density at which ⌊λA + u⌋ includes it.
    const double asks =
        (number - roundingShare(settings_.seed, ground_.source(root.triangle), back)) /
        (amount.density * ground_.area(root.triangle));
    Reject ignored = Reject::paint;
    if (filter_.paintedDensity(root, 0.0, ignored) < asks)
        return false;
    block.proposed += std::uint64_t(counts);
    return isFree(root, counts, block);
}

bool SurfaceSampler::isFree(const RootSample& root, bool counts, Block& block) const
{
    if (const std::optional<Reject> obstacle = filter_.obstacle(root)) {
        block.rejected[static_cast<std::size_t>(*obstacle)] += std::uint64_t(counts);
        return false;
    }
    return true;
}

Sampling SurfaceSampler::sample(const Amount& amount, Progress& progress, const TileRegion* counted,
                                double around) const
{
    const Tries tries{amount, firstCandidates(amount.density, counted, around)};
    Sampling result;
    result.roots.resize(tries.count());

    // If every candidate is kept, its number is its index.
    if (amount.takesAll() && !filter_.needsAnything() && filter_.painting() == nullptr &&
        counted == nullptr) {
        forEachBlock(tries, progress, [&](std::uint64_t, std::uint64_t begin, std::uint64_t end) {
            RootSample* place = result.roots.data() + begin;
            forEachCandidate(tries, begin, end,
                             [&](const RootSample& root, bool) { *place++ = root; });
        });
        result.proposed = result.roots.size();
        return result;
    }

    // Else each block fills the front of its range; then compact the ranges.
    std::vector<Block> blocks((tries.count() + candidatesPerBlock - 1) / candidatesPerBlock);
    forEachBlock(tries, progress, [&](std::uint64_t index, std::uint64_t begin, std::uint64_t end) {
        Block& block = blocks[index];
        RootSample* const front = result.roots.data() + begin;
        forEachCandidate(tries, begin, end, [&](const RootSample& root, bool isMore) {
            const bool counts = counted == nullptr || counted->holds(root);
            if (isMore ? takesMore(root, amount, counts, block)
                       : takes(root, amount, counts, block))
                front[block.kept++] = root;
        });
    });
    std::size_t kept = 0;
    for (std::size_t i = 0; i < blocks.size(); ++i) {
        const RootSample* const front = result.roots.data() + i * candidatesPerBlock;
        std::copy(front, front + blocks[i].kept, result.roots.data() + kept);
        kept += blocks[i].kept;
        result.proposed += blocks[i].proposed;
        add(result.rejected, blocks[i].rejected);
    }
    result.roots.resize(kept);
    return result;
}

Amount SurfaceSampler::amountFor(std::uint64_t count, Progress& progress) const
{
    Amount amount;
    const double area = bearingArea(ground_, settings_.sides);
    if (count == 0 || area <= 0.0)
        return amount;

    // Estimate the kept share from a small sample; from a larger one if the share is small.
    double share = 1.0;
    if (filter_.needsAnything()) {
        Sampling probe = sample({fewTrials / area}, progress);
        if (probe.roots.empty())
            probe = sample({manyTrials / area}, progress);
        if (probe.roots.empty())
            return {manyTrials / area};
        share = double(probe.roots.size()) / double(probe.proposed);
    }

    // Request slightly more than needed, and retry with more if the random draw yields too few.
    amount.density =
        (double(count) * 1.02 + 6.0 * std::sqrt(double(count)) + 16.0) / (area * share);
    const double maxDensity = std::max(maxTrials, 4.0 * double(count)) / area;
    double from = count < 100'000 ? 0.0 : windowStart;
    const SearchLimit limit(count);
    for (;;) {
        amount.density = std::min(amount.density, maxDensity);
        const Tries tries{{amount.density}, firstCandidates(amount.density)};
        // Count kept roots below the window and collect those in it.
        std::vector<std::pair<double, std::uint64_t>> window;
        std::uint64_t below = 0;
        std::mutex gathering;
        forEachBlock(tries, progress, [&](std::uint64_t, std::uint64_t first, std::uint64_t end) {
            Block block;
            std::vector<std::pair<double, std::uint64_t>> own;
            if (share < smallShare)
                limit.require();
            forEachCandidate(tries, first, end, [&](const RootSample& root, bool) {
                if (!takes(root, tries.amount, true, block))
                    return;
                const field::BladeKey key = keyOf(ground_, root);
                const double priority = priorityOf(settings_.seed, key);
                if (priority < from)
                    ++block.kept;
                else
                    own.emplace_back(priority, keyBits(key));
            });
            const std::lock_guard lock(gathering);
            below += block.kept;
            window.insert(window.end(), own.begin(), own.end());
        });
        const std::uint64_t kept = below + window.size();
        if (kept <= count && (kept == count || amount.density >= maxDensity))
            return amount;
        if (kept < count) {
            amount.density *= 1.5;
            from = 0.0;
        } else if (below >= count) {
            from = 0.0;
        } else {
            const auto nth = window.begin() + static_cast<std::ptrdiff_t>(count - below) - 1;
            std::nth_element(window.begin(), nth, window.end());
            amount.priority = nth->first;
            amount.lastKey = nth->second;
            return amount;
        }
    }
}

} // namespace sward::bake
