#include "support/fields/edited_meadow.h"

#include "core/random.h"
#include "field/join.h"
#include "support/fields/display_ground.h"
#include "support/fields/fields.h"

#include <glm/vec3.hpp>

namespace sward::test {
namespace {

constexpr float edge = 32.0f; ///< [m] of a cell

std::uint64_t seedOf(const EditedMeadow::Cell& cell)
{
    std::uint64_t seed = 7;
    for (const std::int64_t axis : cell)
        seed = mixBits(seed + static_cast<std::uint64_t>(axis));
    return seed;
}

shared::Blade bladeOf(const EditedMeadow::Cell& cell, std::uint64_t index)
{
    const std::uint64_t seed = seedOf(cell);
    const auto between = [&](float low, float high, std::uint32_t dimension) {
        return low + (high - low) * static_cast<float>(uniform(seed, index, dimension));
    };
    shared::Blade blade = {};
    const glm::vec3 low = edge * glm::vec3(cell[0], cell[1], cell[2]);
    blade.root =
        low + glm::vec3(between(0.1f, edge - 0.1f, 0), 0.05f, between(0.1f, edge - 0.1f, 2));
    blade.up = {0.0f, 1.0f, 0.0f};
    blade.facing = between(0.0f, shared::twoPi, 3);
    blade.stiffness = between(0.3f, 0.8f, 4);
    blade.height = between(0.6f, 1.4f, 5);
    blade.width = between(0.05f, 0.1f, 6);
    blade.exposure = 1.0f;
    blade.tint = {0.3f, between(0.27f, 0.38f, 7), 0.15f};
    return blade;
}

} // namespace

EditedMeadow::EditedMeadow(float extent)
    : ground_(emptyField())
{
    ground_.ground = planeGround(extent);
}

void EditedMeadow::sow(const Cell& cell, std::size_t blades, double kept, std::uint64_t seed)
{
    std::vector<shared::Blade> grown;
    std::vector<field::BladeKey> keys;
    for (std::size_t i = 0; i < blades; ++i)
        if (uniform(seed, i, 20) < kept) {
            grown.push_back(bladeOf(cell, i));
            keys.push_back(
                {static_cast<std::uint32_t>(seedOf(cell)), static_cast<std::uint32_t>(i)});
        }
    sown_[cell] = true;
    if (grown.empty())
        cells_.erase(cell);
    else
        cells_[cell] = treeOf(grown, keys, edge * glm::vec3(cell[0], cell[1], cell[2]), edge);
}

void EditedMeadow::sowSome(std::uint64_t seed)
{
    const auto dice = [&](std::uint32_t bound, std::uint32_t dimension) {
        return static_cast<std::uint32_t>(uniform(5, seed, dimension) * bound);
    };
    for (std::uint32_t i = 0; i <= dice(3, 0); ++i)
        sow({std::int64_t(dice(3, 10 * i + 1)) - 1, 0, std::int64_t(dice(3, 10 * i + 2)) - 1},
            dice(2500, 10 * i + 3), dice(3, 10 * i + 4) / 2.0, seed);
}

field::Delta EditedMeadow::changes()
{
    field::Delta delta;
    for (const auto& [cell, isSown] : sown_) {
        const auto now = cells_.find(cell);
        if (now == cells_.end())
            delta.cells.push_back({cell, {}, {}, {}});
        else
            delta.cells.push_back(
                {cell, now->second.patches, now->second.blades, now->second.keys});
    }
    sown_.clear();
    return delta;
}

field::Field EditedMeadow::whole() const
{
    std::vector<field::Member> members{{field::viewOf(ground_), "ground"}};
    for (const auto& [cell, field] : cells_)
        members.push_back({field::viewOf(field), "cell"});
    return field::join(members).field;
}

std::size_t EditedMeadow::bladeCount() const
{
    std::size_t blades = 0;
    for (const auto& [cell, field] : cells_)
        blades += field.blades.size();
    return blades;
}

} // namespace sward::test
