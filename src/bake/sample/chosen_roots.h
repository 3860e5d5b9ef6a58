#pragma once

#include <glm/vec3.hpp>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace sward::bake {

/// A root already placed in the progressive order.
struct ChosenRoot {
    glm::vec3 position; ///< [m]
    float distance;     ///< [m] from all earlier roots
};

/// Chosen roots of one region, in a grid for the current radius. Positions are relative to the
/// lower corner of their bounding box, so none is negative.
class NearbyRoots {
public:
    /// Empties the grid and sets cells for radii up to `radius` [m] and about `roots` roots.
    void clear(float radius, std::size_t roots)
    {
        width_ = 2.0f * sight * radius;
        perCell_ = 1.0f / width_;
        heads_.assign(std::bit_ceil(std::max<std::size_t>(2 * roots, 16)), none);
        entries_.clear();
    }

    void add(const ChosenRoot& chosen)
    {
        const Cell cell = {cellOf(chosen.position.x), cellOf(chosen.position.y),
                           cellOf(chosen.position.z)};
        std::uint32_t& head = heads_[headOf(cell)];
        entries_.push_back({chosen.position, chosen.distance * chosen.distance, head});
        head = static_cast<std::uint32_t>(entries_.size() - 1);
    }

    /// Distance from `place` to the nearest chosen root, at most 1.25 `radius`, or 0 if it is less
    /// than `radius`. Then `blocker` is the squared distance [m²] of one root that is nearer, and
    /// the place stays blocked for every smaller radius whose square is above it. `radius` must not
    /// be above that of clear().
    float distance(const glm::vec3& place, float radius, float& blocker) const;

private:
    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
    static constexpr float sight = 1.25f; ///< search distance in radii

    struct Cell {
        std::uint32_t x, y, z;
    };

    struct Entry {
        glm::vec3 place;
        float squared; ///< squared distance
        std::uint32_t next;
    };

    std::uint32_t cellOf(float x) const { return static_cast<std::uint32_t>(x * perCell_); }

    /// Cells whose hashes collide share a list; the distance test ignores the foreign roots.
    std::size_t headOf(const Cell& cell) const
    {
        const std::uint32_t mixed =
            cell.x * 0x9e3779b1U ^ cell.y * 0x85ebca77U ^ cell.z * 0xc2b2ae3dU;
        return (mixed ^ mixed >> 15) & (heads_.size() - 1);
    }

    bool look(const Cell& cell, const glm::vec3& place, float least, float& squared,
              float& blocker) const;

    float width_ = 1.0f;
    float perCell_ = 1.0f;
    std::vector<std::uint32_t> heads_;
    std::vector<Entry> entries_;
};

} // namespace sward::bake
