#pragma once

#include "field/seeds/seeds.h"
#include "field/seeds/sow_unit.h"
#include "shaders/shared/eyepoint.h"

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

namespace sward::render {

/// Which units of a field with seeds eyepoints want. Depends on the places of the eyes, not on
/// where they look: an eye that turns finds everything there. Runs on the CPU.
class SowChoice {
public:
    /// `seeds` must outlive it.
    explicit SowChoice(const field::SeedsView& seeds);

    /// A unit that is wanted, or a cell whose bearing cubes are not known yet.
    struct Wanted {
        /// The share that is drawn at the unit's nearest place over its lowest rank: above 1.
        float score = 0.0f;
        bool isCell = false;
        field::SowUnit unit; ///< of a cell: `cell` alone
    };

    /// All that is wanted, in falling order of scores; equal scores in order of their units.
    void find(std::span<const shared::Eyepoint> eyes, std::vector<Wanted>& wanted) const;

    /// Score of any unit.
    float scoreOf(const field::SowUnit& unit, std::span<const shared::Eyepoint> eyes) const;

    /// Whether it is known where a cell bears.
    bool knows(const std::array<std::int32_t, 3>& cell) const { return bearing_.contains(cell); }

    /// Says where a cell bears.
    void know(const std::array<std::int32_t, 3>& cell, const field::UnitCell::Cubes& cubes);

    /// Number of a cell of the seeds; those that they lacked at first follow.
    std::size_t add(const std::array<std::int32_t, 3>& cell);

    /// Whether something may bear in a unit, as far as that is known.
    bool mayBear(const field::SowUnit& unit) const;

    /// Number of a cell of the seeds.
    std::size_t indexOf(const std::array<std::int32_t, 3>& cell) const;

private:
    /// The cubes of units of each unitLevel() in which something may bear.
    using Bearing = std::array<std::vector<std::array<std::uint8_t, 3>>, field::finestUnits + 1>;

    void findIn(std::size_t index, std::span<const shared::Eyepoint> eyes,
                std::vector<Wanted>& wanted) const;

    const field::SeedsView* seeds_;
    std::uint32_t firstLevel_; ///< levels below are stored
    std::vector<std::array<std::int32_t, 3>> cells_;
    std::map<std::array<std::int32_t, 3>, std::size_t> indices_; ///< of these
    std::map<std::array<std::int32_t, 3>, Bearing> bearing_;
};

} // namespace sward::render
