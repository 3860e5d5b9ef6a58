#include "bake/sample/progressive_order.h"

#include "bake/sample/chosen_roots.h"
#include "bake/sample/cube_index.h"
#include "bake/sample/poisson_lattice.h"
#include "core/bounds.h"
#include "core/random.h"

#include <glm/vector_relational.hpp>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>

namespace sward::bake {
namespace {

// Widest lattice [m], equal to the widest patches with blades; each finer one has an eighth of it.
constexpr double widestSide = 32.0;
constexpr double finerBy = 8.0;
constexpr int lattices = 5;

// Regions of a lattice are a sixteenth of its side apart: its first radius.
constexpr double sideInRadii = 16.0;

constexpr double radiusStep = 0.8408964152537145; // 2^(−1/4)

// A region with more roots stops when the radius has fallen to an eighth, and leaves the rest to
// the finer lattice, whose many regions fit a cache. Other regions continue to the end, or until
// the radius is 1/30 000; closer roots follow in random order.
constexpr std::size_t maxRootsToTheEnd = 262'144;
constexpr int levelsPerLattice = 12;
constexpr int levelsToTheEnd = 60;

// Tries per chosen root (plus a constant) before the radius is lowered.
constexpr std::size_t triesPerChoice = 5;
constexpr std::size_t moreTries = 32;

// Number of levels between two rebuilds of the cells.
constexpr int levelsPerCells = 2;

// State of a root.
enum class State : std::uint8_t { open, chosen, done };

struct Candidate {
    glm::vec3 place; // relative to a corner of the region
    std::uint32_t root;
    std::uint64_t priority;

    bool operator<(const Candidate& other) const
    {
        return priority != other.priority ? priority < other.priority : root < other.root;
    }
};

// The open roots of a region in order of priority, sorted lazily.
class Candidates {
public:
    std::vector<Candidate>& all() { return all_; }
    void restart() { sorted_ = 0; }

    const Candidate& at(std::size_t i)
    {
        if (i >= sorted_) {
            const std::size_t end =
                std::min(all_.size(), std::max<std::size_t>(2 * sorted_, fewest));
            const auto first = all_.begin() + static_cast<std::ptrdiff_t>(sorted_);
            const auto last = all_.begin() + static_cast<std::ptrdiff_t>(end);
            if (end < all_.size())
                std::nth_element(first, last, all_.end());
            std::sort(first, last);
            sorted_ = end;
        }
        return all_[i];
    }

private:
    static constexpr std::size_t fewest = 256;
    std::vector<Candidate> all_;
    std::size_t sorted_ = 0;
};

// A candidate tried without success, and the squared distance [m²] of a root that blocks it. It
// stays blocked until the radius is smaller than that.
struct Passed {
    std::uint32_t candidate;
    float blocker;
};

// Working memory of one thread.
struct Chooser {
    Candidates candidates;
    NearbyRoots nearby;
    std::vector<ChosenRoot> chosen; // around the region and in it
    std::vector<Passed> passed;     // in order

    // Chooses roots among the candidates, whose positions are still absolute. Calls
    // choose(candidate, distance) for each chosen one; returns whether the others are finished.
    template <typename Choose>
    bool run(double firstRadius, double enough, const CubeIndex<ChosenRoot>& before, Choose choose)
    {
        std::vector<Candidate>& all = candidates.all();
        candidates.restart();
        Aabb box;
        for (const Candidate& candidate : all)
            box.add(candidate.place);
        const auto margin = static_cast<float>(firstRadius);
        const glm::vec3 low = box.low - margin;
        chosen.clear();
        const glm::vec3 high = box.high + margin;
        std::size_t early = 0;
        before.forEachIn(glm::dvec3(low), glm::dvec3(high), [&](const ChosenRoot& other) {
            if (glm::any(glm::lessThan(other.position, low)) ||
                glm::any(glm::greaterThan(other.position, high)))
                return;
            chosen.push_back({other.position - low, other.distance});
            early += std::size_t(other.distance >= margin);
        });
        for (Candidate& candidate : all)
            candidate.place -= low;

        const std::size_t around = chosen.size();
        const bool toTheEnd = all.size() <= maxRootsToTheEnd;
        const auto satisfied = [&] {
            return double(chosen.size() - around) >= enough * double(all.size());
        };
        passed.clear();
        std::size_t next = 0; // first untried candidate
        double radius = firstRadius;
        const int levels = toTheEnd ? levelsToTheEnd : levelsPerLattice;
        for (int level = 0; level < levels && !satisfied(); ++level) {
            const auto least = static_cast<float>(radius);
            if (level % levelsPerCells == 0) {
                nearby.clear(least, triesPerChoice * chosen.size() / 2);
                for (const ChosenRoot& other : chosen)
                    nearby.add(other);
            }
            const auto take = [&](std::uint32_t i, float& blocker) {
                const Candidate& candidate = all[i];
                const float distance = nearby.distance(candidate.place, least, blocker);
                if (distance <= 0.0f)
                    return false;
                chosen.push_back({candidate.place, distance});
                nearby.add(chosen.back());
                choose(candidate, distance);
                return true;
            };

            // Try the earlier failures first, then new ones.
            std::size_t tried = 0;
            const auto mayTry = [&] {
                return tried < triesPerChoice * (early + chosen.size() - around) + moreTries;
            };
            std::size_t left = 0;
            for (; tried < passed.size() && mayTry(); ++tried) {
                Passed& again = passed[tried];
                if (again.blocker < least * least || !take(again.candidate, again.blocker))
                    passed[left++] = again;
            }
            passed.erase(passed.begin() + static_cast<std::ptrdiff_t>(left),
                         passed.begin() + static_cast<std::ptrdiff_t>(tried));
            for (; next < all.size() && mayTry(); ++tried, ++next) {
                candidates.at(next);
                Passed first{static_cast<std::uint32_t>(next), 0.0f};
                if (!take(first.candidate, first.blocker))
                    passed.push_back(first);
            }
            if (passed.empty() && next == all.size())
                break;
            radius *= radiusStep;
        }
        return toTheEnd || satisfied();
    }
};

double extentOf(const Roots& roots)
{
    double extent = 0.0;
    for (const RootSample& root : roots)
        extent = std::max({extent, std::fabs(double(root.position.x)),
                           std::fabs(double(root.position.y)), std::fabs(double(root.position.z))});
    return extent;
}

// Roots chosen at a larger distance come first. Bits of positive floats sort like their values.
std::uint64_t orderOf(float distance, std::uint64_t priority)
{
    return std::uint64_t(~std::bit_cast<std::uint32_t>(distance)) << 32 | priority >> 32;
}

float distanceOf(std::uint64_t order)
{
    return std::bit_cast<float>(~static_cast<std::uint32_t>(order >> 32));
}

// Consecutive roots of one region.
struct Run {
    PoissonLattice::Key region;
    std::size_t begin, end;
};

// The open roots by regions, sorted.
std::vector<Run> runsOf(const Roots& roots, const std::vector<State>& states,
                        const PoissonLattice& lattice)
{
    constexpr std::size_t rootsPerBlock = 16'384;
    std::vector<std::vector<Run>> blocks((roots.size() + rootsPerBlock - 1) / rootsPerBlock);
    tbb::parallel_for(std::size_t(0), blocks.size(), [&](std::size_t block) {
        std::vector<Run>& runs = blocks[block];
        const std::size_t end = std::min((block + 1) * rootsPerBlock, roots.size());
        for (std::size_t i = block * rootsPerBlock; i < end; ++i) {
            if (states[i] != State::open)
                continue;
            const PoissonLattice::Key region = lattice.regionOf(glm::dvec3(roots[i].position));
            if (runs.empty() || runs.back().region != region)
                runs.push_back({region, i, i});
            runs.back().end = i + 1;
        }
    });
    std::vector<Run> all;
    for (const std::vector<Run>& runs : blocks)
        all.insert(all.end(), runs.begin(), runs.end());
    tbb::parallel_sort(all.begin(), all.end(), [](const Run& a, const Run& b) {
        return a.region != b.region ? a.region < b.region : a.begin < b.begin;
    });
    return all;
}

// Chooses roots lattice by lattice, from the widest to the finest.
class Ordering {
public:
    // All must outlive it; `progress` may be null.
    Ordering(const terrain::GroundMesh& ground, const Roots& roots, double evenUpTo,
             const Progress* progress)
        : ground_(ground)
        , roots_(roots)
        , evenUpTo_(evenUpTo)
        , progress_(progress)
        , extent_(extentOf(roots))
        , order_(roots.size())
        , states_(roots.size(), State::open)
        , index_(0.6 * widestSide)
    {
        tbb::parallel_for(std::size_t(0), roots.size(),
                          [&](std::size_t i) { order_[i] = orderOf(0.0f, priorityOf(i)); });
    }

    std::vector<std::uint64_t> run()
    {
        double side = widestSide;
        for (int lattice = 0; lattice < lattices && !(extent_ / side > 5e5); ++lattice) {
            if (!leavesRoots(side))
                break;
            side /= finerBy;
        }
        return std::move(order_);
    }

private:
    std::uint64_t priorityOf(std::size_t i) const
    {
        return mixBits(keyBits(keyOf(ground_, roots_[i])) + 1);
    }

    // Chooses roots in the regions of the lattice of this side [m]. Returns whether some are left
    // for a finer one.
    bool leavesRoots(double side)
    {
        const double radius = side / sideInRadii;
        runs_ = runsOf(roots_, states_, PoissonLattice(side, 0.0, radius, extent_));
        if (runs_.empty())
            return false;
        first_.clear();
        for (std::size_t i = 0; i < runs_.size(); ++i)
            if (i == 0 || runs_[i].region != runs_[i - 1].region)
                first_.push_back(i);
        first_.push_back(runs_.size());
        isDone_.assign(first_.size() - 1, 0);
        index_.sortInto(0.6 * side);

        tbb::enumerable_thread_specific<Chooser> choosers;
        bool isLast = true;
        for (std::size_t begin = 0; begin < isDone_.size();) {
            // All regions of one kind at once.
            const int kind = kindOf(begin);
            std::size_t end = begin;
            while (end < isDone_.size() && kindOf(end) == kind)
                ++end;
            tbb::parallel_for(begin, end, [&](std::size_t region) {
                chooseIn(region, radius, choosers.local());
            });
            for (std::size_t region = begin; region < end; ++region)
                isLast = isLast && isDone_[region] != 0;
            if (kind < lastKind || !isLast)
                indexChosen(begin, end);
            begin = end;
        }
        finishRoots();
        return !isLast;
    }

    int kindOf(std::size_t region) const
    {
        return PoissonLattice::kindOf(runs_[first_[region]].region);
    }

    template <typename Take>
    void forRootsOf(std::size_t region, Take take) const
    {
        for (std::size_t run = first_[region]; run < first_[region + 1]; ++run)
            for (std::size_t i = runs_[run].begin; i < runs_[run].end; ++i)
                take(i);
    }

    void chooseIn(std::size_t region, double radius, Chooser& chooser)
    {
        if (progress_ != nullptr)
            progress_->throwIfCancelled();
        std::vector<Candidate>& candidates = chooser.candidates.all();
        candidates.clear();
        forRootsOf(region, [&](std::size_t i) {
            if (states_[i] == State::open)
                candidates.push_back(
                    {roots_[i].position, static_cast<std::uint32_t>(i), priorityOf(i)});
        });
        isDone_[region] = std::uint8_t(
            chooser.run(radius, evenUpTo_, index_, [&](const Candidate& candidate, float distance) {
                states_[candidate.root] = State::chosen;
                order_[candidate.root] = orderOf(distance, candidate.priority);
            }));
    }

    // Later regions must keep their distance from the chosen roots of these.
    void indexChosen(std::size_t begin, std::size_t end)
    {
        for (std::size_t region = begin; region < end; ++region)
            forRootsOf(region, [&](std::size_t i) {
                if (states_[i] == State::chosen)
                    index_.add({roots_[i].position, distanceOf(order_[i])});
            });
    }

    // Marks finished roots, so that later lattices skip them.
    void finishRoots()
    {
        tbb::parallel_for(std::size_t(0), isDone_.size(), [&](std::size_t region) {
            forRootsOf(region, [&](std::size_t i) {
                if (isDone_[region] != 0 || states_[i] == State::chosen)
                    states_[i] = State::done;
            });
        });
    }

    static constexpr int lastKind = 3; // of a lattice's regions

    const terrain::GroundMesh& ground_;
    const Roots& roots_;
    double evenUpTo_;
    const Progress* progress_;
    double extent_;
    std::vector<std::uint64_t> order_;
    std::vector<State> states_;
    CubeIndex<ChosenRoot> index_; // the chosen roots

    // Of the lattice at hand:
    std::vector<Run> runs_;
    std::vector<std::size_t> first_;   // run of each region, and the end of all
    std::vector<std::uint8_t> isDone_; // by region
};

} // namespace

std::vector<std::uint64_t> progressiveOrder(const terrain::GroundMesh& ground, const Roots& roots,
                                            double evenUpTo, const Progress* progress)
{
    return Ordering(ground, roots, evenUpTo, progress).run();
}

} // namespace sward::bake
