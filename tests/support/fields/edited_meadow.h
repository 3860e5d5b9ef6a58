#pragma once

#include "field/delta.h"
#include "field/field.h"

#include <array>
#include <cstdint>
#include <map>
#include <vector>

namespace sward::test {

/// A field that is edited cell by cell, and the changes that tell of it.
class EditedMeadow {
public:
    using Cell = std::array<std::int64_t, 3>;

    /// Bare ground of `extent` [m] around the origin.
    explicit EditedMeadow(float extent);

    /// Draws `blades` roots of a cell anew; blades of equal number are alike for every amount. A
    /// share `kept` [0, 1] of these remains, chosen by `seed`.
    void sow(const Cell& cell, std::size_t blades, double kept = 1.0, std::uint64_t seed = 1);

    /// Draws up to four cells around the middle anew, bare ones among them, as `seed` has it.
    void sowSome(std::uint64_t seed);

    /// The cells sown since the last call. Views this meadow until it is sown again.
    field::Delta changes();

    /// All of it, joined anew.
    field::Field whole() const;

    std::size_t bladeCount() const;
    const std::map<Cell, field::Field>& cells() const { return cells_; }

private:
    field::Field ground_;
    std::map<Cell, field::Field> cells_;
    std::map<Cell, bool> sown_;
};

} // namespace sward::test
