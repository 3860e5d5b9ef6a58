#pragma once

#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

namespace sward::bake {

/// A root that keeps others away.
struct Disk {
    glm::vec3 position; ///< [m] relative to the ground's origin
    float radius;       ///< [m] how near no root may come that has as wide a disk itself
    glm::vec3 normal;   ///< unit
};

/// Disks by the cube of space that they are in. Reading is thread-safe, adding is not.
class DiskIndex {
public:
    /// Cubes of this width [m]; coordinates up to a million widths.
    explicit DiskIndex(double width)
        : width_(width)
    {
    }

    void add(const Disk& disk) { cubes_[keyOf(cubeOf(glm::dvec3(disk.position)))].push_back(disk); }

    /// Calls visit(disk) for every disk in the box, and some around it.
    template <typename Visit>
    void forEachIn(const glm::dvec3& low, const glm::dvec3& high, Visit visit) const
    {
        const Cube first = cubeOf(low);
        const Cube last = cubeOf(high);
        for (std::int64_t z = first.z; z <= last.z; ++z)
            for (std::int64_t y = first.y; y <= last.y; ++y)
                for (std::int64_t x = first.x; x <= last.x; ++x) {
                    const auto found = cubes_.find(keyOf({x, y, z}));
                    if (found != cubes_.end())
                        for (const Disk& disk : found->second)
                            visit(disk);
                }
    }

private:
    struct Cube {
        std::int64_t x, y, z;
    };

    struct Hash {
        std::size_t operator()(std::uint64_t key) const
        {
            key *= 0x9e3779b97f4a7c15ULL;
            return static_cast<std::size_t>(key ^ key >> 32);
        }
    };

    Cube cubeOf(const glm::dvec3& place) const
    {
        const glm::dvec3 cube = glm::floor(place / width_);
        return {static_cast<std::int64_t>(cube.x), static_cast<std::int64_t>(cube.y),
                static_cast<std::int64_t>(cube.z)};
    }

    static std::uint64_t keyOf(const Cube& cube)
    {
        constexpr std::uint64_t mask = (1ULL << 21) - 1;
        return (static_cast<std::uint64_t>(cube.x) & mask) << 42 |
               (static_cast<std::uint64_t>(cube.y) & mask) << 21 |
               (static_cast<std::uint64_t>(cube.z) & mask);
    }

    double width_;
    std::unordered_map<std::uint64_t, std::vector<Disk>, Hash> cubes_;
};

} // namespace sward::bake
