#include "bake/poisson/disk_grid.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>

namespace sward::bake {

void DiskGrid::clear(const glm::dvec3& low, const glm::dvec3& high, double width)
{
    low_ = glm::vec3(low);
    perCell_ = static_cast<float>(1.0 / width);
    cells_ = glm::ivec3(glm::ceil((high - low) / width)) + 2;
    heads_.assign(std::size_t(cells_.x) * std::size_t(cells_.y) * std::size_t(cells_.z), none);
    entries_.clear();
}

void DiskGrid::insert(const Disk& disk)
{
    std::uint32_t& head = heads_[headOf(cellOf(disk.position))];
    entries_.push_back({disk, head});
    head = static_cast<std::uint32_t>(entries_.size() - 1);
}

const Disk* DiskGrid::blockerIn(const glm::ivec3& cell, const glm::vec3& position, float radius,
                                const glm::vec3* normal, double sheetCosine) const
{
    // Rounding must not let a root stand nearer than the radius.
    constexpr float generous = 1.000002f;
    for (std::uint32_t i = heads_[headOf(cell)]; i != none;) {
        const Disk& disk = entries_[i].disk;
        i = entries_[i].next;
        const float dx = disk.position.x - position.x;
        const float dy = disk.position.y - position.y;
        const float dz = disk.position.z - position.z;
        const float reach = std::min(disk.radius, radius);
        if (dx * dx + dy * dy + dz * dz >= reach * reach * generous)
            continue;
        if (normal != nullptr && double(glm::dot(*normal, disk.normal)) < sheetCosine)
            continue;
        return &disk;
    }
    return nullptr;
}

const Disk* DiskGrid::blocker(const glm::vec3& position, float radius, const glm::vec3* normal,
                              double sheetCosine) const
{
    // Try the own cell first; it most likely holds the blocker.
    const glm::ivec3 own = cellOf(position);
    if (const Disk* disk = blockerIn(own, position, radius, normal, sheetCosine))
        return disk;
    const glm::ivec3 first = cellOf(position - radius);
    const glm::ivec3 last = cellOf(position + radius);
    for (int z = first.z; z <= last.z; ++z)
        for (int y = first.y; y <= last.y; ++y)
            for (int x = first.x; x <= last.x; ++x)
                if (x != own.x || y != own.y || z != own.z)
                    if (const Disk* disk =
                            blockerIn({x, y, z}, position, radius, normal, sheetCosine))
                        return disk;
    return nullptr;
}

} // namespace sward::bake
