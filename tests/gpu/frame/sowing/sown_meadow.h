#pragma once

#include "field/field.h"

#include <cstdint>
#include <optional>

namespace sward::test {

/// A meadow as it grows from its seeds, and its first ranks with these seeds.
struct SownMeadow {
    field::Field whole;
    field::Field seeded;
};

/// On meshes::hills(side, cells). `density` [1/m²], or what closes the sward; `stored`: share of
/// the ranks of `seeded`.
SownMeadow sownMeadow(double side, std::uint32_t cells, std::optional<double> density,
                      double stored);

} // namespace sward::test
