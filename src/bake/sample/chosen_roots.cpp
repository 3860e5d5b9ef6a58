#include "bake/sample/chosen_roots.h"

#include <cmath>

namespace sward::bake {

float NearbyRoots::distance(const glm::vec3& place, float radius, float& blocker) const
{
    // Cells are twice as wide as the sight: the own cell and those beyond the nearer faces suffice.
    const Cell own = {cellOf(place.x), cellOf(place.y), cellOf(place.z)};
    const float least = radius * radius;
    float squared = sight * sight * least;
    if (!look(own, place, least, squared, blocker))
        return 0.0f;
    const auto gapOf = [&](float x, std::uint32_t cell, std::uint32_t& beyond) {
        const float inside = x - static_cast<float>(cell) * width_;
        const bool low = inside < 0.5f * width_;
        beyond = low ? cell - 1 : cell + 1;
        // Reduced for the rounding of cell coordinates.
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
                  squared, blocker))
            return 0.0f;
    }
    return std::sqrt(squared);
}

// Lowers `squared` to the squared distance of the roots in a cell; false if it falls below `least`.
bool NearbyRoots::look(const Cell& cell, const glm::vec3& place, float least, float& squared,
                       float& blocker) const
{
    for (std::uint32_t i = heads_[headOf(cell)]; i != none; i = entries_[i].next) {
        const glm::vec3 offset = entries_[i].place - place;
        const float other = offset.x * offset.x + offset.y * offset.y + offset.z * offset.z;
        if (other >= entries_[i].squared)
            continue;
        if (other < least) {
            blocker = other;
            return false;
        }
        squared = std::min(squared, other);
    }
    return true;
}

} // namespace sward::bake
