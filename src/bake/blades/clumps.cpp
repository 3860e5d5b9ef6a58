#include "bake/blades/clumps.h"

#include "bake/filter/up_vector.h"
#include "core/bounds.h"
#include "core/math/exact_math.h"
#include "core/math/floor.h"
#include "core/random.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>

namespace sward::bake {
namespace {

// Key of clump centres, different from the key of roots.
constexpr std::uint64_t clumpSalt = 0x636c756d70ULL;

// Upper bound on centres, for memory; larger ground gets larger clumps.
constexpr double maxClumps = 2e6;

// Search radius in spacings. A fraction of about e^−7 of all positions has no clump within it.
constexpr double reachShare = 1.5;

constexpr std::size_t trianglesPerBlock = 8192;

// Cells are twice as wide as the reach, so a search covers two cells along each axis.
glm::ivec3 cellAt(const glm::dvec3& place, double reach)
{
    return glm::ivec3(glm::floor(place * (0.5 / reach)));
}

glm::vec3 centreOn(const terrain::GroundMesh& ground, std::size_t triangle, std::uint64_t own)
{
    const glm::uvec3 corners = ground.triangles[triangle];
    const glm::dvec3 p0(ground.positions[corners.x]);
    const double s = std::sqrt(uniform(own, 0, 1));
    const double v = uniform(own, 0, 2);
    return glm::vec3(p0 + s * (1.0 - v) * (glm::dvec3(ground.positions[corners.y]) - p0) +
                     s * v * (glm::dvec3(ground.positions[corners.z]) - p0));
}

} // namespace

glm::dvec3 Clumps::Clump::direction(const terrain::GroundMesh& ground) const
{
    const glm::uvec3 corners = ground.triangles[triangle];
    const glm::dvec3 normal = ground.faceNormal(triangle);
    const glm::dvec3 tangent = surfaceTangent(normal, glm::dvec3(ground.positions[corners.x]),
                                              glm::dvec3(ground.positions[corners.y]),
                                              glm::dvec3(ground.positions[corners.z]));
    const SinCos turn = exactSinCos(exactTwoPi * uniform(key, 0, 3));
    return turn.cos * tangent + turn.sin * glm::cross(normal, tangent);
}

std::uint64_t clumpKeyOf(std::uint64_t seed)
{
    return hashBits(seed, clumpSalt);
}

double clumpSpacing(double size, double area)
{
    return size <= 0.0 ? 0.0 : std::max(size, std::sqrt(area / maxClumps));
}

Clumps::Clumps(const terrain::GroundMesh& ground, double spacing, std::uint64_t seed)
{
    if (spacing <= 0.0)
        return;
    spacing_ = spacing;
    reach_ = reachShare * spacing;
    scatter(ground, spacing, clumpKeyOf(seed));
    sortIntoBuckets();
}

void Clumps::scatter(const terrain::GroundMesh& ground, double spacing, std::uint64_t key)
{
    // Same rule as for roots: ⌊λA + u⌋ centres on each triangle.
    const double density = 1.0 / (spacing * spacing);
    const std::size_t triangles = ground.triangles.size();
    std::vector<std::vector<Clump>> blocks((triangles + trianglesPerBlock - 1) / trianglesPerBlock);
    tbb::parallel_for(std::size_t(0), blocks.size(), [&](std::size_t block) {
        const std::size_t end = std::min((block + 1) * trianglesPerBlock, triangles);
        for (std::size_t t = block * trianglesPerBlock; t < end; ++t) {
            if (ground.bears[t] == 0)
                continue;
            const std::uint64_t source = ground.source(t);
            const auto count = static_cast<std::uint32_t>(
                std::floor(density * ground.area(t) + uniform(key, source, 0)));
            for (std::uint32_t i = 0; i < count; ++i) {
                const std::uint64_t own = hashBits(key, source << 32 | i);
                blocks[block].push_back(
                    {centreOn(ground, t, own), static_cast<std::uint32_t>(t), own});
            }
        }
    });
    std::vector<std::size_t> first(blocks.size() + 1, 0);
    for (std::size_t block = 0; block < blocks.size(); ++block)
        first[block + 1] = first[block] + blocks[block].size();
    clumps_.resize(first.back());
    tbb::parallel_for(std::size_t(0), blocks.size(), [&](std::size_t block) {
        std::copy(blocks[block].begin(), blocks[block].end(),
                  clumps_.begin() + std::ptrdiff_t(first[block]));
    });
}

void Clumps::sortIntoBuckets()
{
    // A bucket holds the cells of one hash. Their order inside depends on the threads and does not
    // matter: nearest() breaks ties by key.
    constexpr std::size_t clumpsPerBucket = 8;
    first_.assign(std::bit_ceil(clumps_.size() / clumpsPerBucket + 1) + 1, 0);
    std::vector<std::uint32_t> bucket(clumps_.size());
    tbb::parallel_for(std::size_t(0), clumps_.size(), [&](std::size_t i) {
        const std::size_t own = bucketOf(cellAt(glm::dvec3(clumps_[i].centre), reach_));
        bucket[i] = static_cast<std::uint32_t>(own);
        std::atomic_ref(first_[own]).fetch_add(1, std::memory_order_relaxed);
    });
    std::uint32_t sum = 0;
    for (std::uint32_t& count : first_)
        count = sum += count;
    // first_ now holds the end of each bucket; filling backwards turns it into the beginning.
    UninitializedVector<Clump> sorted(clumps_.size());
    tbb::parallel_for(std::size_t(0), clumps_.size(), [&](std::size_t i) {
        sorted[std::atomic_ref(first_[bucket[i]]).fetch_sub(1, std::memory_order_relaxed) - 1] =
            clumps_[i];
    });
    clumps_ = std::move(sorted);
}

std::size_t Clumps::bucketOf(glm::ivec3 cell) const
{
    const std::uint64_t xy = std::uint64_t(std::uint32_t(cell.x)) << 32 | std::uint32_t(cell.y);
    return hashBits(xy, std::uint32_t(cell.z)) & (first_.size() - 2);
}

const Clumps::Clump* Clumps::nearest(glm::vec3 place) const
{
    if (clumps_.empty())
        return nullptr;
    // Search the own cell and the neighbours that may hold a clump nearer than the best so far.
    const glm::dvec3 at(place);
    const glm::dvec3 inCells = at * (0.5 / reach_);
    const glm::ivec3 own(floorOf(inCells.x), floorOf(inCells.y), floorOf(inCells.z));
    glm::ivec3 beyond;
    glm::dvec3 gap; // squared distances of the cell faces, reduced for rounding
    for (glm::length_t axis = 0; axis < 3; ++axis) {
        const double inside = inCells[axis] - double(own[axis]);
        beyond[axis] = inside < 0.5 ? -1 : 1;
        const double far = (2.0 - 1e-5) * reach_ * (inside < 0.5 ? inside : 1.0 - inside);
        gap[axis] = far * far;
    }
    const Clump* best = nullptr;
    float bestSquared = static_cast<float>(reach_ * reach_);
    for (unsigned i = 0; i < 8; ++i) {
        const glm::ivec3 step(i & 1, i >> 1 & 1, i >> 2);
        if (glm::dot(glm::dvec3(step), gap) > double(bestSquared))
            continue;
        const std::size_t bucket = bucketOf(own + step * beyond);
        for (std::uint32_t c = first_[bucket]; c < first_[bucket + 1]; ++c) {
            const Clump& clump = clumps_[c];
            const glm::vec3 offset = clump.centre - place;
            const float squared = glm::dot(offset, offset);
            if (squared < bestSquared ||
                (squared == bestSquared && best != nullptr && clump.key < best->key)) {
                bestSquared = squared;
                best = &clump;
            }
        }
    }
    return best;
}

void Clumps::nearest(std::span<const RootSample> roots, std::span<const Clump*> found) const
{
    constexpr std::size_t few = 32;
    for (std::size_t i = 0; i < roots.size(); i += few) {
        const std::size_t end = std::min(i + few, roots.size());
        nearestOfFew(roots.subspan(i, end - i), found.subspan(i, end - i));
    }
}

void Clumps::nearestOfFew(std::span<const RootSample> roots, std::span<const Clump*> found) const
{
    Aabb box;
    for (const RootSample& root : roots)
        box.add(root.position);
    const glm::vec3 centre = 0.5f * (box.low + box.high);
    const glm::dvec3 half = 0.5 * glm::dvec3(box.size());
    const double radius = std::sqrt(glm::dot(half, half));
    const Clump* const middle = nearest(centre);
    // Roots that lie far apart share no clumps.
    if (middle == nullptr || radius > 0.5 * reach_) {
        for (std::size_t i = 0; i < roots.size(); ++i)
            found[i] = nearest(roots[i].position);
        return;
    }

    // A root's nearest clump is no farther from it than the centre's, and so within this distance
    // of the centre. The rest covers rounding.
    const glm::dvec3 toMiddle = glm::dvec3(middle->centre) - glm::dvec3(centre);
    const double far =
        (2.0 * radius + std::sqrt(glm::dot(toMiddle, toMiddle))) * 1.001 + 1e-3 * reach_;
    constexpr std::size_t room = 64;
    std::array<const Clump*, room> near;
    std::size_t count = 0;
    const glm::dvec3 at(centre);
    const glm::ivec3 low = cellAt(at - far, reach_);
    const glm::ivec3 high = cellAt(at + far, reach_);
    for (int z = low.z; z <= high.z; ++z)
        for (int y = low.y; y <= high.y; ++y)
            for (int x = low.x; x <= high.x; ++x) {
                const std::size_t bucket = bucketOf({x, y, z});
                for (std::uint32_t c = first_[bucket]; c < first_[bucket + 1]; ++c) {
                    const glm::dvec3 offset = glm::dvec3(clumps_[c].centre) - at;
                    if (glm::dot(offset, offset) <= far * far) {
                        if (count < room)
                            near[count] = &clumps_[c];
                        ++count;
                    }
                }
            }
    for (std::size_t i = 0; i < roots.size(); ++i) {
        if (count > room) {
            found[i] = nearest(roots[i].position);
            continue;
        }
        found[i] = nullptr;
        float bestSquared = static_cast<float>(reach_ * reach_);
        for (std::size_t c = 0; c < count; ++c) {
            const glm::vec3 offset = near[c]->centre - roots[i].position;
            const float squared = glm::dot(offset, offset);
            if (squared < bestSquared ||
                (squared == bestSquared && found[i] != nullptr && near[c]->key < found[i]->key)) {
                bestSquared = squared;
                found[i] = near[c];
            }
        }
    }
}

} // namespace sward::bake
