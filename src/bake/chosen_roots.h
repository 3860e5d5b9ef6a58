#pragma once

#include <glm/vec3.hpp>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace sward::bake {

/// A root that has its place in a progressive order.
struct ChosenRoot {
    glm::vec3 position; ///< [m]
    float distance;     ///< [m] from those before it; it stays that far from others in every prefix
};

/// Chosen roots of one region in cells for the radius at hand. Places are relative to the corner of
/// a box that holds them all, so none is negative.
class NearbyRoots {
public:
    /// Cells for radii up to `radius` [m], for about so many roots, with nothing in them.
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

    /// How far a root at `place` would be from the others in every prefix with it: their distance
    /// from it, but no farther than 1.25 `radius`; 0 if that is less than `radius`, which must not
    /// be above that of clear().
    float distance(const glm::vec3& place, float radius) const;

private:
    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
    static constexpr float sight = 1.25f; ///< in radii

    struct Cell {
        std::uint32_t x, y, z;
    };

    struct Entry {
        glm::vec3 place;
        float squared; ///< of its distance
        std::uint32_t next;
    };

    std::uint32_t cellOf(float x) const { return static_cast<std::uint32_t>(x * perCell_); }

    /// Cells share a list by chance; distances tell their places apart.
    std::size_t headOf(const Cell& cell) const
    {
        const std::uint32_t mixed =
            cell.x * 0x9e3779b1U ^ cell.y * 0x85ebca77U ^ cell.z * 0xc2b2ae3dU;
        return (mixed ^ mixed >> 15) & (heads_.size() - 1);
    }

    bool look(const Cell& cell, const glm::vec3& place, float least, float& squared) const;

    float width_ = 1.0f;
    float perCell_ = 1.0f;
    std::vector<std::uint32_t> heads_;
    std::vector<Entry> entries_;
};

} // namespace sward::bake
