#include "bake/clumps.h"

#include "bake/up_vector.h"
#include "core/exact_math.h"
#include "core/random.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>

namespace sward::bake {
namespace {

// Clump centres are drawn with another key than roots.
constexpr std::uint64_t clumpSalt = 0x636c756d70ULL;

// More centres than this are not worth their memory: clumps grow instead.
constexpr double mostClumps = 2e6;

// A blade's clump is at most so many spacings away: around e^−7 of all places have none so near.
constexpr double reachShare = 1.5;

constexpr std::size_t trianglesPerBlock = 8192;
constexpr double twoPi = 6.28318530717958648;

glm::ivec3 cellAt(glm::vec3 place, double cellSize)
{
    return glm::ivec3(glm::floor(glm::dvec3(place) / cellSize));
}

Clumps::Clump clumpOn(const terrain::GroundMesh& ground, std::size_t triangle, std::uint64_t own)
{
    const glm::uvec3 corners = ground.triangles[triangle];
    const glm::dvec3 p0(ground.positions[corners.x]);
    const glm::dvec3 p1(ground.positions[corners.y]);
    const glm::dvec3 p2(ground.positions[corners.z]);
    const double s = std::sqrt(uniform(own, 0, 1));
    const double v = uniform(own, 0, 2);

    const glm::dvec3 normal = ground.faceNormal(triangle);
    const glm::dvec3 tangent = surfaceTangent(normal, p0, p1, p2);
    const SinCos turn = exactSinCos(twoPi * uniform(own, 0, 3));
    return {glm::vec3(p0 + s * (1.0 - v) * (p1 - p0) + s * v * (p2 - p0)),
            glm::vec3(turn.cos * tangent + turn.sin * glm::cross(normal, tangent)), own};
}

} // namespace

double clumpSpacing(double size, double area)
{
    return size <= 0.0 ? 0.0 : std::max(size, std::sqrt(area / mostClumps));
}

Clumps::Clumps(const terrain::GroundMesh& ground, double spacing, std::uint64_t seed)
{
    if (spacing <= 0.0)
        return;
    cellSize_ = reachShare * spacing;
    scatter(ground, spacing, hashBits(seed, clumpSalt));
    sortIntoBuckets();
}

void Clumps::scatter(const terrain::GroundMesh& ground, double spacing, std::uint64_t key)
{
    // As roots are scattered: ⌊λA + u⌋ on each triangle.
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
            for (std::uint32_t i = 0; i < count; ++i)
                blocks[block].push_back(clumpOn(ground, t, hashBits(key, source << 32 | i)));
        }
    });
    std::size_t count = 0;
    for (const std::vector<Clump>& block : blocks)
        count += block.size();
    clumps_.reserve(count);
    for (const std::vector<Clump>& block : blocks)
        clumps_.insert(clumps_.end(), block.begin(), block.end());
}

void Clumps::sortIntoBuckets()
{
    // A bucket holds the cells of one hash. Their order inside comes from the threads and does not
    // matter: nearest() tells equals apart by their keys.
    first_.assign(std::bit_ceil(clumps_.size() + 1) + 1, 0);
    std::vector<std::uint32_t> bucket(clumps_.size());
    tbb::parallel_for(std::size_t(0), clumps_.size(), [&](std::size_t i) {
        const std::size_t own = bucketOf(cellAt(clumps_[i].centre, cellSize_));
        bucket[i] = static_cast<std::uint32_t>(own);
        std::atomic_ref(first_[own]).fetch_add(1, std::memory_order_relaxed);
    });
    std::uint32_t sum = 0;
    for (std::uint32_t& count : first_)
        count = sum += count;
    // Now first_ is where each bucket ends; filled backward, it is where it begins.
    std::vector<Clump> sorted(clumps_.size());
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
    const glm::ivec3 middle = cellAt(place, cellSize_);
    const Clump* best = nullptr;
    double bestSquared = cellSize_ * cellSize_;
    // A centre within one cell's width lies in one of the 27 cells around.
    for (int z = -1; z <= 1; ++z)
        for (int y = -1; y <= 1; ++y)
            for (int x = -1; x <= 1; ++x) {
                const std::size_t bucket = bucketOf(middle + glm::ivec3(x, y, z));
                for (std::uint32_t i = first_[bucket]; i < first_[bucket + 1]; ++i) {
                    const Clump& clump = clumps_[i];
                    const glm::dvec3 offset = glm::dvec3(clump.centre) - glm::dvec3(place);
                    const double squared = glm::dot(offset, offset);
                    if (squared < bestSquared ||
                        (squared == bestSquared && best != nullptr && clump.key < best->key)) {
                        bestSquared = squared;
                        best = &clump;
                    }
                }
            }
    return best;
}

} // namespace sward::bake
