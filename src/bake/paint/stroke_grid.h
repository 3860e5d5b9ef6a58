#pragma once

#include "core/bounds.h"
#include "core/math/floor.h"
#include "core/random.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace sward::bake {

/// A capsule of a stroke.
struct StrokeSegment {
    glm::dvec3 from{0.0};  ///< [m] relative to the ground's origin
    glm::dvec3 along{0.0}; ///< to its other end
    glm::vec3 fromNormal{0.0f};
    glm::vec3 toNormal{0.0f};
    double radius = 0.0;      ///< [m]
    std::uint32_t stroke = 0; ///< rises from segment to segment
    bool hasNormals = false;

    double perSquaredLength = 0.0; ///< of `along`; 0 if it has no length

    /// Share [0, 1] of the way along at the point nearest to a position.
    double shareAt(const glm::dvec3& place) const
    {
        const glm::dvec3 offset = place - from;
        const double share =
            (offset.x * along.x + offset.y * along.y + offset.z * along.z) * perSquaredLength;
        return share < 0.0 ? 0.0 : share > 1.0 ? 1.0 : share;
    }

    /// The box of the capsule, a millimetre wider.
    DAabb box() const;
};

/// Finds the capsules near a position. Each lies in the cells of a grid about as wide as its
/// radius; there is one grid for each power of two. What is found may be too much, never too
/// little.
class StrokeGrid {
public:
    explicit StrokeGrid(std::vector<StrokeSegment> segments);

    const std::vector<StrokeSegment>& segments() const { return segments_; }

    /// Whether a capsule may be near.
    bool holds(const glm::dvec3& place) const
    {
        for (const Level& level : levels_)
            if (!level.at(place).empty())
                return true;
        return false;
    }

    /// Calls visit(segment) for each that may be near, in rising order among those of one width.
    template <typename Visit>
    void visitNear(const glm::dvec3& place, Visit visit) const
    {
        for (const Level& level : levels_)
            for (const std::uint32_t segment : level.at(place))
                visit(segment);
    }

private:
    // The segments of one cell are a range of `segments`. Cells 2²¹ apart along an axis share it.
    struct Cell {
        std::uint64_t key;
        std::uint32_t first;
        std::uint32_t count; // 0: the slot is free
    };

    struct Level {
        double perMetre = 1.0;
        DAabb box;
        std::vector<Cell> table; // a power of two; open addressing
        std::vector<std::uint32_t> segments;

        static std::uint64_t keyOf(std::int64_t x, std::int64_t y, std::int64_t z)
        {
            constexpr std::uint64_t mask = 0x1fffff;
            return (std::uint64_t(x) & mask) | (std::uint64_t(y) & mask) << 21 |
                   (std::uint64_t(z) & mask) << 42;
        }

        std::span<const std::uint32_t> at(const glm::dvec3& place) const
        {
            if (place.x < box.low.x || place.x > box.high.x || place.y < box.low.y ||
                place.y > box.high.y || place.z < box.low.z || place.z > box.high.z)
                return {};
            const std::uint64_t key =
                keyOf(floorOf(place.x * perMetre), floorOf(place.y * perMetre),
                      floorOf(place.z * perMetre));
            for (std::size_t slot = mixBits(key);; ++slot) {
                const Cell& cell = table[slot & (table.size() - 1)];
                if (cell.count == 0)
                    return {};
                if (cell.key == key)
                    return {segments.data() + cell.first, cell.count};
            }
        }
    };

    void addLevel(int exponent, const std::vector<std::uint32_t>& members);

    std::vector<StrokeSegment> segments_;
    std::vector<Level> levels_;
};

} // namespace sward::bake
