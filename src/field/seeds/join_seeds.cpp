#include "field/seeds/join_seeds.h"

#include "core/error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace sward::field {
namespace {

constexpr double joinedCellSide = 32.0; // [m]
constexpr double farthestCell = 1e9;

// Cells by which a member's are moved.
std::array<std::int32_t, 3> shiftOf(const SeedMember& member, const glm::dvec3& origin)
{
    std::array<std::int32_t, 3> shift{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double cells =
            (member.placed.origin[glm::length_t(axis)] - origin[glm::length_t(axis)]) /
            joinedCellSide;
        if (cells != std::floor(cells) || !(std::abs(cells) < farthestCell))
            fail(ErrorKind::input,
                 "{}: its seeds lie {:.6g} cells of 32 m from those of the first field, which is "
                 "no whole number; 'sward grow' makes blades of them",
                 member.name, cells);
        shift[axis] = static_cast<std::int32_t>(cells);
    }
    return shift;
}

// Cells tell species by their slots.
void requireSlots(const SeedMember& member)
{
    for (std::size_t slot = 0; slot < member.species.size(); ++slot)
        if (member.species[slot] != slot)
            fail(ErrorKind::input,
                 "{}: species {} of its seeds would be number {} of those shown together; name the "
                 "file first, or make blades of its seeds by 'sward grow'",
                 member.name, slot, member.species[slot]);
}

} // namespace

std::shared_ptr<const SharedSeeds> joinSeeds(std::span<const SeedMember> members,
                                             const glm::dvec3& origin, std::size_t speciesCount)
{
    struct Source {
        SeedEntry entry;
        const SeedMember* member;
    };
    std::vector<Source> order;
    const SeedMember* first = nullptr;
    for (const SeedMember& member : members) {
        const SeedsView* const seeds = member.placed.seeds;
        if (seeds == nullptr)
            continue;
        if (first == nullptr)
            first = &member;
        else if (const std::string values =
                     differencesOf(*first->placed.seeds->meadow, *seeds->meadow);
                 !values.empty())
            fail(ErrorKind::input,
                 "{}: its seeds are of another meadow than those of {} ({}); 'sward grow' makes "
                 "blades of them",
                 member.name, first->name, values);
        requireSlots(member);
        const std::array<std::int32_t, 3> shift = shiftOf(member, origin);
        for (SeedEntry entry : seeds->cells) {
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const std::int64_t moved = std::int64_t(entry.cell[axis]) + shift[axis];
                if (moved < std::numeric_limits<std::int32_t>::min() ||
                    moved > std::numeric_limits<std::int32_t>::max())
                    fail(ErrorKind::input, "{}: its seeds are too far from the first field",
                         member.name);
                entry.cell[axis] = static_cast<std::int32_t>(moved);
            }
            order.push_back({entry, &member});
        }
    }
    if (first == nullptr)
        return nullptr;
    std::stable_sort(order.begin(), order.end(),
                     [](const Source& a, const Source& b) { return a.entry.cell < b.entry.cell; });

    Seeds joined;
    joined.meadow = *first->placed.seeds->meadow;
    // Species of other members, of which nothing is sown.
    joined.meadow.species.resize(std::max(speciesCount, joined.meadow.species.size()));
    for (std::size_t i = 0; i < order.size(); ++i) {
        SeedEntry entry = order[i].entry;
        const SeedMember& member = *order[i].member;
        if (i > 0 && order[i - 1].entry.cell == entry.cell)
            fail(ErrorKind::input,
                 "{}: has seeds of the cell ({}, {}, {}) of 32 m, as {} has; 'sward grow' makes "
                 "blades of them",
                 member.name, entry.cell[0], entry.cell[1], entry.cell[2],
                 order[i - 1].member->name);
        const auto frame = member.placed.seeds->data.subspan(entry.offset, entry.bytes);
        entry.offset = joined.data.size();
        joined.cells.push_back(entry);
        joined.data.insert(joined.data.end(), frame.begin(), frame.end());
    }
    return std::make_shared<const SharedSeeds>(std::move(joined));
}

} // namespace sward::field
