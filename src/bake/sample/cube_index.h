#pragma once

#include "core/random.h"

#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace sward::bake {

/// Items with a `position` [m], hashed by cubes of space. Reading is thread-safe, adding is not.
/// The order of the items of one cube is independent of other cubes.
template <typename Item>
class CubeIndex {
public:
    /// Makes an index with cubes of `width` [m].
    explicit CubeIndex(double width) { sortInto(width); }

    /// Re-sorts the items into cubes of another width.
    void sortInto(double width)
    {
        width_ = width;
        link(std::bit_ceil(std::max<std::size_t>(entries_.size(), 16)));
    }

    void add(const Item& item)
    {
        entries_.push_back({item, none});
        if (entries_.size() > heads_.size())
            link(2 * heads_.size());
        else
            hang(entries_.size() - 1);
    }

    /// Calls visit(item) for every item in the box, and for some outside it.
    template <typename Visit>
    void forEachIn(const glm::dvec3& low, const glm::dvec3& high, Visit visit) const
    {
        const glm::dvec3 first = glm::floor(low / width_);
        const glm::dvec3 last = glm::floor(high / width_);
        for (double z = first.z; z <= last.z; z += 1.0)
            for (double y = first.y; y <= last.y; y += 1.0)
                for (double x = first.x; x <= last.x; x += 1.0)
                    visitCube({x, y, z}, visit);
    }

private:
    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

    struct Entry {
        Item item;
        std::uint32_t next;
    };

    glm::dvec3 cubeOf(const Item& item) const
    {
        return glm::floor(glm::dvec3(item.position) / width_);
    }

    std::size_t headOf(const glm::dvec3& cube) const
    {
        const auto bits = [](double x) {
            return static_cast<std::uint64_t>(static_cast<std::int64_t>(x));
        };
        return mixBits(bits(cube.x) ^ mixBits(bits(cube.y) ^ mixBits(bits(cube.z)))) &
               (heads_.size() - 1);
    }

    /// Cubes may share a list; skip items of other cubes.
    template <typename Visit>
    void visitCube(const glm::dvec3& cube, Visit& visit) const
    {
        for (std::uint32_t i = heads_[headOf(cube)]; i != none; i = entries_[i].next)
            if (cubeOf(entries_[i].item) == cube)
                visit(entries_[i].item);
    }

    void link(std::size_t heads)
    {
        heads_.assign(heads, none);
        for (std::size_t i = 0; i < entries_.size(); ++i)
            hang(i);
    }

    void hang(std::size_t i)
    {
        std::uint32_t& head = heads_[headOf(cubeOf(entries_[i].item))];
        entries_[i].next = head;
        head = static_cast<std::uint32_t>(i);
    }

    double width_ = 1.0;
    std::vector<std::uint32_t> heads_; ///< a power of two
    std::vector<Entry> entries_;
};

} // namespace sward::bake
