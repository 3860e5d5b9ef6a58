#pragma once

#include "field/seeds/seeds.h"
#include "shaders/shared/sow/sown_blade.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

namespace sward::field {

/// The clumps of a cell of seeds, by place. For one thread: the traits of a clump are computed when
/// it is first asked for.
class NearClumps {
public:
    /// `waves` and `ground` are those of the cell. All arguments must outlive it.
    NearClumps(const SeedCell& cell, const shared::SowMeadow& meadow,
               const shared::SowGround& ground, const shared::SowWaves& waves);

    /// The clump nearest to a place of the cell, of equally near ones that of the lowest key. With
    /// none within reach, one of the candidate `own` alone.
    shared::SowClump nearest(const glm::ivec3& place, std::uint64_t own) const;

private:
    struct Centre {
        glm::ivec3 place;
        std::uint32_t next;
        std::uint64_t key;
        std::uint32_t clump;  ///< of the cell
        std::uint32_t traits; ///< index of its traits; unknown until it is asked for
    };
    struct Traits {
        glm::vec3 along;
        shared::SowClumpTraits wide;
    };

    const Traits& traitsOf(Centre& centre) const;

    std::size_t headOf(const glm::ivec3& bucket) const;
    glm::ivec3 bucketOf(const glm::ivec3& place, glm::ivec3& half) const;

    const SeedCell& cell_;
    const shared::SowMeadow& meadow_;
    const shared::SowGround& ground_;
    shared::SowWaves waves_;
    bool isShared_;      ///< some species has a shared direction
    std::int64_t reach_; ///< units; buckets are twice as wide
    mutable std::vector<Centre> centres_;
    mutable std::vector<Traits> traits_; ///< of those that were asked for
    std::vector<std::uint32_t> heads_;
};

} // namespace sward::field
