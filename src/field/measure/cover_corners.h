#pragma once

#include "field/field.h"
#include "field/organs.h"
#include "shaders/shared/blade.h"
#include "shaders/shared/cover.h"
#include "shaders/shared/look/blade_colors.h"
#include "shaders/shared/noise.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace sward::field {

/// Calls `put(corner, amount)` for each corner around a place, with the weights of leafAreaAt().
template <typename Put>
void dealToCorners(const shared::Cover& shape, glm::vec3 place, float amount, const Put& put)
{
    const glm::vec3 last = glm::vec3(shape.countX, shape.countY, shape.countZ) - 1.0f;
    const glm::vec3 at =
        glm::clamp((place - shape.low) * shape.cellsPerMetre, glm::vec3(0.0f), last);
    const glm::vec3 cell = glm::min(glm::floor(at), last - 1.0f);
    const glm::vec3 f = at - cell;
    const std::size_t stepY = shape.countX;
    const std::size_t stepZ = stepY * shape.countY;
    const std::size_t first = static_cast<std::size_t>(cell.x) +
                              stepY * static_cast<std::size_t>(cell.y) +
                              stepZ * static_cast<std::size_t>(cell.z);
    for (std::size_t corner = 0; corner < 8; ++corner) {
        const bool x = (corner & 1u) != 0;
        const bool y = (corner & 2u) != 0;
        const bool z = (corner & 4u) != 0;
        const float weight =
            (x ? f.x : 1.0f - f.x) * (y ? f.y : 1.0f - f.y) * (z ? f.z : 1.0f - f.z);
        put(first + (x ? 1 : 0) + (y ? stepY : 0) + (z ? stepZ : 0), amount * weight);
    }
}

/// Amounts at the corners of a grid.
class CoverCorners {
public:
    explicit CoverCorners(const shared::Cover& shape)
        : shape_(shape)
        , amounts_(std::size_t(shape.countX) * shape.countY * shape.countZ, 0.0f)
    {
    }

    /// Distributes an amount to the corners around a place.
    void deal(glm::vec3 place, float amount)
    {
        dealToCorners(shape_, place, amount,
                      [&](std::size_t corner, float part) { amounts_[corner] += part; });
    }

    std::vector<float>& amounts() { return amounts_; }

private:
    shared::Cover shape_;
    std::vector<float> amounts_;
};

/// A blade that stands for some of its patch.
struct CoverBlade {
    glm::vec3 root;
    float height;                ///< [m] of it, or of its plant
    float area;                  ///< [m²] of them together
    float tone;                  ///< clumpTone(); 0.5 if it has none
    const shared::Species* look; ///< never null
};

/// Calls `visit` for a `share` of a patch's blades, which are spread evenly over it and represent
/// all. Blades in a row are, and their first may be any blade of the patch: where a patch begins is
/// a stalk, so that rows from there on have fewer ribbons than the patch.
template <typename Visit>
void forSomeBlades(std::span<const Species> species, const shared::Patch& cell,
                   std::span<const shared::PackedBlade> blades, double share, const Visit& visit)
{
    const auto read =
        static_cast<std::uint32_t>(std::ceil(share * static_cast<double>(cell.bladeCount)));
    const std::uint32_t first =
        read < cell.bladeCount
            ? shared::mixUint(blades[cell.firstBlade].rootXY ^ cell.bladeCount) % cell.bladeCount
            : 0;
    for (std::uint32_t n = 0; n < read; ++n) {
        const std::uint32_t i = (first + n) % cell.bladeCount;
        const shared::Blade blade = shared::unpackBlade(blades[cell.firstBlade + i], cell);
        const BladePart part = partOf(species[blade.species], blade);
        const float area = part.length * blade.width *
                           shared::outlineArea(part.look->shape, part.look->tipThreshold);
        // Plants stand alone, and dead blades have a colour of their own.
        const bool hasTone = species[blade.species].organs.empty() && blade.clump != shared::driedClump;
        visit(CoverBlade{blade.root, blade.height,
                         area * static_cast<float>(cell.bladeCount) / static_cast<float>(read),
                         hasTone ? shared::clumpTone(blade.clump) : 0.5f, part.look});
    }
}

} // namespace sward::field
