#pragma once

#include "field/seeds/seeds.h"
#include "shaders/shared/sow/sow_pass.h"

#include <glm/vec3.hpp>

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

namespace sward::field {

/// The clumps of a cell of seeds, by place. The traits of a clump are computed when it is first
/// asked for. Thread-safe.
class NearClumps {
public:
    /// `waves` and `ground` are those of the cell. All arguments must outlive it.
    NearClumps(const SeedCell& cell, const shared::SowMeadow& meadow,
               const shared::SowGround& ground, const shared::SowWaves& waves);
    NearClumps(const NearClumps&) = delete; // it keeps references to its neighbours
    NearClumps& operator=(const NearClumps&) = delete;

    /// The clump nearest to a place of the cell, of equally near ones that of the lowest key. With
    /// none within reach, one of the candidate `own` alone.
    shared::SowClump nearest(const glm::ivec3& place, std::uint64_t own) const;

    /// The same tables for a device: centres, and the first of each list of centres whose buckets
    /// have the same hash.
    std::vector<shared::SowCentre> centres() const;
    std::span<const std::uint32_t> heads() const { return heads_; }

private:
    struct Centre {
        glm::ivec3 place;
        std::uint32_t next;
        std::uint64_t key;
        std::uint32_t clump; ///< of the cell
    };
    struct Traits {
        std::atomic<bool> isKnown{false};
        glm::vec3 along{0.0f};
        shared::SowClumpTraits wide = {};
    };

    const Traits& traitsOf(const Centre& centre) const;

    std::size_t headOf(const glm::ivec3& bucket) const;
    glm::ivec3 bucketOf(const glm::ivec3& place, glm::ivec3& half) const;

    const SeedCell& cell_;
    const shared::SowMeadow& meadow_;
    const shared::SowGround& ground_;
    shared::SowWaves waves_;
    bool isShared_;      ///< some species has a shared direction
    std::int64_t reach_; ///< units; buckets are twice as wide
    std::vector<Centre> centres_;
    mutable std::mutex mutex_;         ///< of who computes traits
    std::unique_ptr<Traits[]> traits_; ///< one per centre
    std::vector<std::uint32_t> heads_;
};

} // namespace sward::field
