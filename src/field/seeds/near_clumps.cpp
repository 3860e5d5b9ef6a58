#include "field/seeds/near_clumps.h"

#include "core/random.h"

#include <algorithm>
#include <bit>
#include <cstdlib>

namespace sward::field {
namespace {

constexpr std::uint32_t none = shared::noSeedBits;

// Squares of distances fit into 63 bits: a cell has 2^29 units at most. Centres beyond cannot be
// within reach of a cell that a bake has written.
constexpr std::int32_t farthestCentre = 3 << 28;
constexpr std::int64_t longestReach = 1 << 28;

std::int64_t squaredLength(const glm::ivec3& v)
{
    return std::int64_t(v.x) * v.x + std::int64_t(v.y) * v.y + std::int64_t(v.z) * v.z;
}

} // namespace

NearClumps::NearClumps(const SeedCell& cell, const shared::SowMeadow& meadow,
                       const shared::SowGround& ground, const shared::SowWaves& waves)
    : cell_(cell)
    , meadow_(meadow)
    , ground_(ground)
    , waves_(waves)
    , isShared_(std::any_of(
          meadow.species.at, meadow.species.at + meadow.speciesCount,
          [](const shared::SowSpecies& one) { return one.facing == shared::sowShared; }))
    , reach_(std::clamp<std::int64_t>(meadow.clumpReach, 1, longestReach))
    , heads_(std::bit_ceil(cell.clumps.size() / 2 + 1), none)
{
    centres_.reserve(cell.clumps.size());
    for (std::uint32_t index = 0; index < cell.clumps.size(); ++index) {
        const shared::SeedClump& clump = cell.clumps[index];
        const shared::SeedPiece& piece = cell.pieces[clump.piece];
        const shared::SeedVertex& a = cell.vertices[piece.corners[0]];
        const shared::SeedVertex& b = cell.vertices[piece.corners[1]];
        const shared::SeedVertex& c = cell.vertices[piece.corners[2]];
        Centre centre = {};
        centre.clump = index;
        centre.key = shared::sowClumpKey(meadow.clumpKey, piece.source, clump.number);
        centre.place = shared::sowClumpPlace(a, b, c, centre.key);
        if (std::max({std::abs(centre.place.x), std::abs(centre.place.y),
                      std::abs(centre.place.z)}) > farthestCentre)
            continue;
        glm::ivec3 half;
        std::uint32_t& head = heads_[headOf(bucketOf(centre.place, half))];
        centre.next = head;
        head = static_cast<std::uint32_t>(centres_.size());
        centres_.push_back(centre);
    }
    traits_ = std::make_unique<Traits[]>(centres_.size());
}

const NearClumps::Traits& NearClumps::traitsOf(const Centre& centre) const
{
    Traits& traits = traits_[static_cast<std::size_t>(&centre - centres_.data())];
    if (traits.isKnown.load(std::memory_order_acquire))
        return traits;
    const std::lock_guard lock(mutex_);
    if (traits.isKnown.load(std::memory_order_relaxed))
        return traits;
    const shared::SeedClump& clump = cell_.clumps[centre.clump];
    const shared::SeedPiece& piece = cell_.pieces[clump.piece];
    glm::vec3 first;
    glm::vec3 second;
    shared::sowEdges(cell_.vertices[piece.corners[0]], cell_.vertices[piece.corners[1]],
                     cell_.vertices[piece.corners[2]], first, second);
    if (isShared_)
        traits.along = shared::sowClumpDirection(first, second, centre.key);
    if (meadow_.wideVariation > 0.0f)
        traits.wide =
            shared::sowClumpTraits(meadow_, clump, centre.place, first, second, ground_, waves_);
    traits.isKnown.store(true, std::memory_order_release);
    return traits;
}

std::size_t NearClumps::headOf(const glm::ivec3& bucket) const
{
    const std::uint64_t xy =
        std::uint64_t(std::uint32_t(bucket.x)) << 32U | std::uint32_t(bucket.y);
    return hashBits(xy, std::uint32_t(bucket.z)) & (heads_.size() - 1);
}

// The bucket of a place, and the step to the bucket beside it along each axis that is nearer.
glm::ivec3 NearClumps::bucketOf(const glm::ivec3& place, glm::ivec3& half) const
{
    glm::ivec3 bucket;
    for (glm::length_t axis = 0; axis < 3; ++axis) {
        // Count halves of buckets, rounding down.
        const std::int64_t x = place[axis];
        const std::int64_t halves = x >= 0 ? x / reach_ : -((reach_ - 1 - x) / reach_);
        bucket[axis] = static_cast<int>(halves >> 1);
        half[axis] = (halves & 1) == 0 ? -1 : 1;
    }
    return bucket;
}

std::vector<shared::SowCentre> NearClumps::centres() const
{
    std::vector<shared::SowCentre> result;
    result.reserve(centres_.size());
    for (const Centre& centre : centres_) {
        const shared::SeedClump& clump = cell_.clumps[centre.clump];
        result.push_back({.place = centre.place,
                          .next = centre.next,
                          .key = centre.key,
                          .piece = clump.piece,
                          .moisture = clump.moisture});
    }
    return result;
}

shared::SowClump NearClumps::nearest(const glm::ivec3& place, std::uint64_t own) const
{
    shared::SowClump clump = {};
    clump.key = own;
    if (centres_.empty())
        return clump;
    glm::ivec3 half;
    const glm::ivec3 bucket = bucketOf(place, half);
    const Centre* best = nullptr;
    std::int64_t bestSquared = reach_ * reach_;
    for (int i = 0; i < 8; ++i) {
        const glm::ivec3 step(i & 1, i >> 1 & 1, i >> 2);
        for (std::uint32_t c = heads_[headOf(bucket + step * half)]; c != none;
             c = centres_[c].next) {
            const std::int64_t squared = squaredLength(place - centres_[c].place);
            if (squared < bestSquared ||
                (squared == bestSquared && best != nullptr && centres_[c].key < best->key)) {
                bestSquared = squared;
                best = &centres_[c];
            }
        }
    }
    if (best != nullptr) {
        clump.key = best->key;
        clump.offset = place - best->place;
        const Traits& traits = traitsOf(*best);
        clump.along = traits.along;
        clump.wide = traits.wide;
        clump.isAny = 1;
    }
    return clump;
}

} // namespace sward::field
