#pragma once

#include "bake/disk.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace sward::bake {

/// The disks in and around one region, for finding the one that keeps a root away.
class DiskGrid {
public:
    /// Makes it empty, for disks in a box cut into cells of `width` [m].
    void clear(const glm::dvec3& low, const glm::dvec3& high, double width);

    /// Adds a disk in the box.
    void insert(const Disk& disk);

    const Disk& last() const { return entries_.back().disk; }

    /// A disk nearer to a place than both its radius and `radius`, null if there is none. Disks
    /// whose normal encloses an angle of a cosine below `sheetCosine` with `normal` do not count; a
    /// null `normal` lets all count. The box must reach `radius` farther than the place.
    const Disk* blocker(const glm::vec3& position, float radius, const glm::vec3* normal,
                        double sheetCosine) const;

private:
    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

    struct Entry {
        Disk disk;
        std::uint32_t next;
    };

    glm::ivec3 cellOf(const glm::vec3& position) const
    {
        return glm::ivec3((position - low_) * perCell_);
    }
    std::size_t headOf(const glm::ivec3& cell) const
    {
        return (std::size_t(cell.z) * std::size_t(cells_.y) + std::size_t(cell.y)) *
                   std::size_t(cells_.x) +
               std::size_t(cell.x);
    }

    glm::vec3 low_{0.0f};
    float perCell_ = 1.0f;
    glm::ivec3 cells_{0};
    std::vector<std::uint32_t> heads_;
    std::vector<Entry> entries_;
};

} // namespace sward::bake
