#include "bake/progressive_order.h"

#include "bake/poisson_lattice.h"
#include "core/bounds.h"
#include "core/random.h"

#include <glm/common.hpp>
#include <glm/vector_relational.hpp>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <unordered_map>

namespace sward::bake {
namespace {

// Widest lattice [m], that of the patches that own blades; each finer one has an eighth of it.
constexpr double widestSide = 32.0;
constexpr double finerBy = 8.0;
constexpr int lattices = 5;

// Regions of a lattice are kept apart by a sixteenth of its side: its first radius.
constexpr double sideInRadii = 16.0;

// Levels of a lattice: by their end the radius has fallen to an eighth.
constexpr int levelsPerLattice = 12;
constexpr double radiusStep = 0.8408964152537145; // 2^(−1/4)

// So many roots are tried for each that is chosen, and some more, before the radius is lowered.
constexpr std::size_t triesPerChoice = 5;
constexpr std::size_t moreTries = 32;

// Where so many of a region's roots have been chosen, the rest follows at random: they are close
// neighbours of others.
constexpr double enough = 0.7;

// How far the distance to others is looked for, in radii of the level.
constexpr float sight = 1.25f;

constexpr std::uint8_t notChosen = 255;
constexpr std::uint8_t lastOfAll = 254; // not chosen either, but done with

// Places that keep others away, found by cells as wide as twice the radius.
class Grid {
public:
    // Makes room for so many places, with nothing in it.
    void clear(std::size_t places, float radius)
    {
        radius_ = radius;
        perCell_ = 0.5f / radius;
        heads_.assign(std::bit_ceil(std::max<std::size_t>(places, 16)), none);
        entries_.clear();
    }

    // `distance` is how far the root was from others when it was chosen.
    void add(const glm::vec3& place, float distance)
    {
        std::uint32_t& head = heads_[headOf(cellOf(place))];
        entries_.push_back({place, distance * distance, head});
        head = static_cast<std::uint32_t>(entries_.size() - 1);
    }

    // Distance from a place to the nearest other one that it would come too near to, at most
    // `sight` radii; 0 if that is less than the radius.
    float distance(const glm::vec3& place) const
    {
        float squared = sight * sight * radius_ * radius_;
        const glm::ivec3 own = cellOf(place);
        if (!look(own, place, squared))
            return 0.0f;
        const glm::ivec3 first = cellOf(place - sight * radius_);
        const glm::ivec3 last = cellOf(place + sight * radius_);
        for (int z = first.z; z <= last.z; ++z)
            for (int y = first.y; y <= last.y; ++y)
                for (int x = first.x; x <= last.x; ++x)
                    if ((x != own.x || y != own.y || z != own.z) &&
                        !look({x, y, z}, place, squared))
                        return 0.0f;
        return std::sqrt(squared);
    }

private:
    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

    struct Entry {
        glm::vec3 place;
        float squared; // how far it stays from others in every prefix that it is in
        std::uint32_t next;
    };

    glm::ivec3 cellOf(const glm::vec3& place) const
    {
        return glm::ivec3(glm::floor(place * perCell_));
    }

    // Cells share a list by chance; distances tell their places apart.
    std::size_t headOf(const glm::ivec3& cell) const
    {
        const std::uint32_t mixed = static_cast<std::uint32_t>(cell.x) * 0x9e3779b1U ^
                                    static_cast<std::uint32_t>(cell.y) * 0x85ebca77U ^
                                    static_cast<std::uint32_t>(cell.z) * 0xc2b2ae3dU;
        return (mixed ^ mixed >> 15) & (heads_.size() - 1);
    }

    // Lowers `squared` to the squared distance of what is in a cell; false if that is below the
    // radius.
    bool look(const glm::ivec3& cell, const glm::vec3& place, float& squared) const
    {
        for (std::uint32_t i = heads_[headOf(cell)]; i != none; i = entries_[i].next) {
            const glm::vec3 offset = entries_[i].place - place;
            const float other = offset.x * offset.x + offset.y * offset.y + offset.z * offset.z;
            if (other >= entries_[i].squared)
                continue;
            if (other < radius_ * radius_)
                return false;
            squared = std::min(squared, other);
        }
        return true;
    }

    float radius_ = 1.0f;
    float perCell_ = 1.0f;
    std::vector<std::uint32_t> heads_;
    std::vector<Entry> entries_;
};

// A root that has been chosen.
struct Chosen {
    glm::vec3 place;
    float distance; // [m] from others when it was
};

// Chosen roots by cubes of space.
class ChosenIndex {
public:
    explicit ChosenIndex(double width)
        : width_(width)
    {
    }

    void add(const Chosen& chosen)
    {
        cubes_[keyOf(glm::floor(glm::dvec3(chosen.place) / width_))].push_back(chosen);
    }

    template <typename Visit>
    void forEachIn(const glm::vec3& low, const glm::vec3& high, Visit visit) const
    {
        const glm::dvec3 first = glm::floor(glm::dvec3(low) / width_);
        const glm::dvec3 last = glm::floor(glm::dvec3(high) / width_);
        for (double z = first.z; z <= last.z; z += 1.0)
            for (double y = first.y; y <= last.y; y += 1.0)
                for (double x = first.x; x <= last.x; x += 1.0)
                    if (const auto found = cubes_.find(keyOf({x, y, z})); found != cubes_.end())
                        for (const Chosen& chosen : found->second)
                            visit(chosen);
    }

private:
    static std::uint64_t keyOf(const glm::dvec3& cube)
    {
        constexpr std::uint64_t mask = (1ULL << 21) - 1;
        const auto bits = [](double x) {
            return static_cast<std::uint64_t>(static_cast<std::int64_t>(x)) & mask;
        };
        return bits(cube.x) << 42 | bits(cube.y) << 21 | bits(cube.z);
    }

    struct Mix {
        std::size_t operator()(std::uint64_t key) const { return mixBits(key); }
    };

    double width_;
    std::unordered_map<std::uint64_t, std::vector<Chosen>, Mix> cubes_;
};

// What one thread needs to choose in a region.
struct Chooser {
    Grid grid;
    std::vector<glm::vec3> places;
    std::vector<std::uint32_t> open;
    std::vector<Chosen> around;

    // Chooses among the places, which are in random order; sets the level of each.
    void choose(double firstRadius, const ChosenIndex& before, std::vector<std::uint8_t>& levels,
                std::vector<float>& distances)
    {
        Aabb box;
        for (const glm::vec3& place : places)
            box.add(place);
        around.clear();
        const auto margin = static_cast<float>(firstRadius);
        const glm::vec3 low = box.low - margin;
        const glm::vec3 high = box.high + margin;
        std::size_t earlier = 0;
        before.forEachIn(low, high, [&](const Chosen& other) {
            if (glm::any(glm::lessThan(other.place, low)) ||
                glm::any(glm::greaterThan(other.place, high)))
                return;
            around.push_back(other);
            earlier += std::size_t(other.distance >= margin);
        });

        levels.assign(places.size(), notChosen);
        distances.assign(places.size(), 0.0f);
        open.resize(places.size());
        for (std::uint32_t i = 0; i < open.size(); ++i)
            open[i] = i;
        std::size_t chosen = 0;
        double radius = firstRadius;
        for (int level = 0; level < levelsPerLattice && !open.empty(); ++level) {
            if (double(chosen) >= enough * double(places.size())) {
                for (std::uint8_t& own : levels)
                    own = own == notChosen ? lastOfAll : own;
                return;
            }
            grid.clear(triesPerChoice * (around.size() + chosen) / 2, static_cast<float>(radius));
            for (const Chosen& other : around)
                grid.add(other.place, other.distance);
            for (std::size_t i = 0; i < places.size(); ++i)
                if (levels[i] < level)
                    grid.add(places[i], distances[i]);
            // Try the first ones of those that are left.
            std::size_t tried = 0;
            std::size_t left = 0;
            for (; tried < open.size() && tried < triesPerChoice * (earlier + chosen) + moreTries;
                 ++tried) {
                const std::uint32_t i = open[tried];
                if (const float distance = grid.distance(places[i]); distance > 0.0f) {
                    grid.add(places[i], distance);
                    distances[i] = distance;
                    levels[i] = static_cast<std::uint8_t>(level);
                    ++chosen;
                } else {
                    open[left++] = i;
                }
            }
            open.erase(open.begin() + static_cast<std::ptrdiff_t>(left),
                       open.begin() + static_cast<std::ptrdiff_t>(tried));
            radius *= radiusStep;
        }
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

// The farther from others a root was when it was chosen, the earlier it comes. Of floats above zero
// the larger has the larger bits.
std::uint64_t orderOf(float distance, std::uint64_t priority)
{
    return std::uint64_t(~std::bit_cast<std::uint32_t>(distance)) << 32 | priority >> 32;
}

struct Entry {
    PoissonLattice::Key region;
    std::uint64_t priority;
    std::uint32_t root;
};

} // namespace

std::vector<std::uint64_t> progressiveOrder(const terrain::GroundMesh& ground, const Roots& roots)
{
    std::vector<std::uint64_t> order(roots.size());
    std::vector<Entry> open(roots.size());
    tbb::parallel_for(std::size_t(0), roots.size(), [&](std::size_t i) {
        const std::uint64_t priority = mixBits(keyBits(keyOf(ground, roots[i])) + 1);
        order[i] = orderOf(0.0f, priority);
        open[i] = {0, priority, static_cast<std::uint32_t>(i)};
    });

    const double extent = extentOf(roots);
    std::vector<Chosen> all;
    double side = widestSide;
    for (int lattice = 0; lattice < lattices && !open.empty(); ++lattice, side /= finerBy) {
        if (extent / side > 5e5)
            break;
        const double radius = side / sideInRadii;
        const PoissonLattice regions(side, 0.0, radius, extent);
        tbb::parallel_for(std::size_t(0), open.size(), [&](std::size_t i) {
            open[i].region = regions.regionOf(glm::dvec3(roots[open[i].root].position));
        });
        tbb::parallel_sort(open.begin(), open.end(), [](const Entry& a, const Entry& b) {
            if (a.region != b.region)
                return a.region < b.region;
            return a.priority != b.priority ? a.priority < b.priority : a.root < b.root;
        });
        std::vector<std::size_t> first;
        for (std::size_t i = 0; i < open.size(); ++i)
            if (i == 0 || open[i].region != open[i - 1].region)
                first.push_back(i);
        first.push_back(open.size());

        ChosenIndex index(0.6 * side);
        for (const Chosen& chosen : all)
            index.add(chosen);
        std::vector<std::uint8_t> levelOf(open.size(), notChosen);
        std::vector<float> distanceOf(open.size());
        tbb::enumerable_thread_specific<Chooser> choosers;
        for (std::size_t begin = 0; begin + 1 < first.size();) {
            // All regions of one kind at once.
            const int kind = PoissonLattice::kindOf(open[first[begin]].region);
            std::size_t end = begin;
            while (end + 1 < first.size() &&
                   PoissonLattice::kindOf(open[first[end]].region) == kind)
                ++end;
            tbb::parallel_for(begin, end, [&](std::size_t region) {
                Chooser& chooser = choosers.local();
                chooser.places.clear();
                for (std::size_t i = first[region]; i < first[region + 1]; ++i)
                    chooser.places.push_back(roots[open[i].root].position);
                std::vector<std::uint8_t> levels;
                std::vector<float> distances;
                chooser.choose(radius, index, levels, distances);
                std::copy(distances.begin(), distances.end(),
                          distanceOf.begin() + static_cast<std::ptrdiff_t>(first[region]));
                std::copy(levels.begin(), levels.end(),
                          levelOf.begin() + static_cast<std::ptrdiff_t>(first[region]));
            });
            for (std::size_t i = first[begin]; i < first[end]; ++i)
                if (levelOf[i] < lastOfAll) {
                    const glm::vec3 place = roots[open[i].root].position;
                    all.push_back({place, distanceOf[i]});
                    if (kind < 3)
                        index.add(all.back());
                }
            begin = end;
        }

        // What has been chosen is done with.
        std::size_t left = 0;
        for (std::size_t i = 0; i < open.size(); ++i)
            if (levelOf[i] == notChosen) {
                open[left++] = open[i];
            } else {
                order[open[i].root] = orderOf(distanceOf[i], open[i].priority);
            }
        open.resize(left);
    }
    return order;
}

} // namespace sward::bake
