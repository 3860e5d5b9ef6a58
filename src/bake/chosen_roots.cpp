#include "bake/chosen_roots.h"

#include "core/random.h"

#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

#include <cmath>

namespace sward::bake {

void ChosenIndex::sortInto(double width, std::size_t more)
{
    const std::vector<Entry> before = std::move(entries_);
    width_ = width;
    heads_.assign(std::bit_ceil(std::max<std::size_t>(before.size() + more, 16)), none);
    entries_.clear();
    entries_.reserve(before.size());
    for (const Entry& entry : before)
        add(entry.chosen);
}

void ChosenIndex::add(const ChosenRoot& chosen)
{
    std::uint32_t& head = heads_[headOf(glm::floor(glm::dvec3(chosen.place) / width_))];
    entries_.push_back({chosen, head});
    head = static_cast<std::uint32_t>(entries_.size() - 1);
}

void ChosenIndex::find(const glm::vec3& low, const glm::vec3& high,
                       std::vector<ChosenRoot>& found) const
{
    // Cubes may share a list: what lies in another one is left to it.
    const auto findIn = [&](const glm::dvec3& cube) {
        for (std::uint32_t i = heads_[headOf(cube)]; i != none; i = entries_[i].next) {
            const ChosenRoot& chosen = entries_[i].chosen;
            if (glm::all(glm::greaterThanEqual(chosen.place, low)) &&
                glm::all(glm::lessThanEqual(chosen.place, high)) &&
                glm::floor(glm::dvec3(chosen.place) / width_) == cube)
                found.push_back(chosen);
        }
    };
    const glm::dvec3 first = glm::floor(glm::dvec3(low) / width_);
    const glm::dvec3 last = glm::floor(glm::dvec3(high) / width_);
    for (double z = first.z; z <= last.z; z += 1.0)
        for (double y = first.y; y <= last.y; y += 1.0)
            for (double x = first.x; x <= last.x; x += 1.0)
                findIn({x, y, z});
}

std::size_t ChosenIndex::headOf(const glm::dvec3& cube) const
{
    const auto bits = [](double x) {
        return static_cast<std::uint64_t>(static_cast<std::int64_t>(x));
    };
    return mixBits(bits(cube.x) ^ mixBits(bits(cube.y) ^ mixBits(bits(cube.z)))) &
           (heads_.size() - 1);
}

float NearbyRoots::distance(const glm::vec3& place, float radius) const
{
    // A cell is twice as wide as sight reaches: its own and those beyond the nearer faces hold all.
    const Cell own = {cellOf(place.x), cellOf(place.y), cellOf(place.z)};
    const float least = radius * radius;
    float squared = sight * sight * least;
    if (!look(own, place, least, squared))
        return 0.0f;
    const auto gapOf = [&](float x, std::uint32_t cell, std::uint32_t& beyond) {
        const float inside = x - static_cast<float>(cell) * width_;
        const bool low = inside < 0.5f * width_;
        beyond = low ? cell - 1 : cell + 1;
        // Not too long for what rounding did to the cells.
        const float gap = std::max((low ? inside : width_ - inside) - 1e-3f * width_, 0.0f);
        return gap * gap;
    };
    Cell beyond;
    const float gapX = gapOf(place.x, own.x, beyond.x);
    const float gapY = gapOf(place.y, own.y, beyond.y);
    const float gapZ = gapOf(place.z, own.z, beyond.z);
    for (unsigned i = 1; i < 8; ++i) {
        const bool x = (i & 1) != 0;
        const bool y = (i & 2) != 0;
        const bool z = (i & 4) != 0;
        if ((x ? gapX : 0.0f) + (y ? gapY : 0.0f) + (z ? gapZ : 0.0f) < squared &&
            !look({x ? beyond.x : own.x, y ? beyond.y : own.y, z ? beyond.z : own.z}, place, least,
                  squared))
            return 0.0f;
    }
    return std::sqrt(squared);
}

// Lowers `squared` to the squared distance of what is in a cell; false if that is below the least.
bool NearbyRoots::look(const Cell& cell, const glm::vec3& place, float least, float& squared) const
{
    for (std::uint32_t i = heads_[headOf(cell)]; i != none; i = entries_[i].next) {
        const glm::vec3 offset = entries_[i].place - place;
        const float other = offset.x * offset.x + offset.y * offset.y + offset.z * offset.z;
        if (other >= entries_[i].squared)
            continue;
        if (other < least)
            return false;
        squared = std::min(squared, other);
    }
    return true;
}

} // namespace sward::bake
