#pragma once

#include "bake/poisson/disk.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace sward::bake {

/// Grid of the disks in and around one region; finds a disk that blocks a new root.
class DiskGrid {
public:
    /// Empties it, for disks in a box with cells of `width` [m].
    void clear(const glm::dvec3& low, const glm::dvec3& high, double width);

    /// Adds a disk in the box.
    void insert(const Disk& disk);

    const Disk& last() const { return entries_.back().disk; }

    /// Returns a disk nearer to `position` than both its radius and `radius`, else null. Ignores
    /// disks whose normal has a cosine below `sheetCosine` with `normal`; a null `normal` considers
    /// all. The box must extend `radius` beyond the position.
    const Disk* blocker(const glm::vec3& position, float radius, const glm::vec3* normal,
                        double sheetCosine) const;

    /// Whether such a disk is in the same cell, which holds most of them.
    bool blocksNearby(const glm::vec3& position, float radius, const glm::vec3* normal,
                      double sheetCosine) const
    {
        return blockerIn(cellOf(position), position, radius, normal, sheetCosine) != nullptr;
    }

private:
    const Disk* blockerIn(const glm::ivec3& cell, const glm::vec3& position, float radius,
                          const glm::vec3* normal, double sheetCosine) const;

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
