#pragma once

#include "bake/poisson/disk.h"
#include "bake/poisson/region_frame.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sward::bake {

/// Disks of a smooth region, projected on its plane. Each cell of the map names the disk nearest to
/// it, so that one look rejects most darts. One bit per cell marks the centres of disks.
class DiskMap {
public:
    static constexpr int cellsPerSpacing = 3;

    /// Cells that a map must extend beyond a disk.
    static constexpr int margin = cellsPerSpacing + 2;

    void clear(const RegionFrame& frame);

    /// Adds a disk at this local place; ignores one nearer to the border than `margin`. Returns
    /// false if two disks share a cell, which happens only if sheets lie on each other: then the
    /// map is of no use.
    bool insert(const Disk& disk, const glm::vec3& local);
    bool insert(const Disk& disk)
    {
        return insert(disk, glm::vec3(frame_.place(glm::dvec3(disk.position))));
    }

    class Look;

    /// Whether one disk surely covers a triangle of local corners, so that no dart there can be
    /// accepted.
    bool surelyCovers(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) const;

    /// Whether a disk is nearer to `position` [m], at this local place, than both its radius and
    /// `radius`. The map must extend `radius` beyond the position.
    bool blocks(const glm::vec3& position, const glm::vec3& local, float radius) const;

    /// Calls visit(disk) for all disks.
    template <typename Visit>
    void forEach(Visit visit) const
    {
        for (std::size_t i = 1; i < entries_.size(); ++i)
            visit(Disk{entries_[i].position, entries_[i].radius, normals_[i]});
    }

private:
    static constexpr std::uint32_t numberBits = 24;
    static constexpr std::int32_t numberMask = (1 << numberBits) - 1;
    static constexpr std::int32_t empty = 0x7f << numberBits;

    struct Entry {
        glm::vec3 local;
        float radius;       // [m]
        glm::vec3 position; // [m]
        float unused;       // two entries fill a cache line
    };

    bool blocksAt(std::size_t cell, const glm::vec3& position, float radius) const;

    RegionFrame frame_;
    float sure_ = 0.0f; // [cells²] surely blocked below
    float perMetre_ = 1.0f;
    float reachSlack_ = 0.0f;           // [cells] for rounding
    std::size_t width_ = 0;             // cells in a row
    std::size_t bytesPerRow_ = 0;       // of the centres
    std::vector<Entry> entries_;        // the first is far from everything
    std::vector<glm::vec3> normals_;    // of the entries
    std::vector<std::int32_t> nearest_; // distance class and number of the nearest disk
    std::vector<std::uint8_t> centres_; // a bit per cell
};

/// A quick look at the disks inserted so far; valid until the next change.
class DiskMap::Look {
public:
    explicit Look(const DiskMap& map)
        : entries_(map.entries_.data())
        , nearest_(map.nearest_.data())
        , width_(map.width_)
        , sure_(map.sure_)
    {
    }

    /// Place of the disk nearest to a cell; (x, y) must lie in the map.
    const glm::vec3& nearestTo(float x, float y) const
    {
        const std::size_t cell = static_cast<std::size_t>(static_cast<std::int32_t>(y)) * width_ +
                                 static_cast<std::size_t>(static_cast<std::int32_t>(x));
        return entries_[nearest_[cell] & numberMask].local;
    }

    /// Whether a local place surely is nearer than the spacing to that of a disk.
    bool isSurelyNear(const glm::vec3& local, const glm::vec3& disk) const
    {
        const glm::vec3 offset = disk - local;
        return offset.x * offset.x + offset.y * offset.y + offset.z * offset.z < sure_;
    }

    /// Whether a disk surely is nearer than the spacing to this local place of a dart. Most places
    /// without a certain answer are free.
    bool surelyBlocks(const glm::vec3& local) const
    {
        return isSurelyNear(local, nearestTo(local.x, local.y));
    }

private:
    const Entry* entries_;
    const std::int32_t* nearest_;
    std::size_t width_;
    float sure_;
};

} // namespace sward::bake
