#pragma once

#include "field/seeds/seeds.h"
#include "shaders/shared/sow/sown_blade.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

namespace sward::field {

/// The clumps of a cell of seeds, by place.
class NearClumps {
public:
    /// `waves` and `ground` are those of the cell.
    NearClumps(const SeedCell& cell, const shared::SowMeadow& meadow,
               const shared::SowGround& ground, const shared::SowWaves& waves);

    /// The clump nearest to a place of the cell, of equally near ones that of the lowest key. With
    /// none within reach, one of the candidate `own` alone.
    shared::SowClump nearest(const glm::ivec3& place, std::uint64_t own) const;

private:
    struct Centre {
        glm::ivec3 place;
        glm::vec3 along;
        shared::SowClumpTraits wide;
        std::uint64_t key;
        std::uint32_t next;
    };

    std::size_t headOf(const glm::ivec3& bucket) const;
    glm::ivec3 bucketOf(const glm::ivec3& place, glm::ivec3& half) const;

    std::int64_t reach_; ///< units; buckets are twice as wide
    std::vector<Centre> centres_;
    std::vector<std::uint32_t> heads_;
};

} // namespace sward::field
