#pragma once

#include "field/file/compression.h"
#include "shaders/shared/blade.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>

namespace sward::field {

/// The blades and keys of a field that do not lie in memory, for writeField(). Both are given in
/// the order of the file; one thread may ask for blades while another asks for keys.
class BladePieces {
public:
    /// Takes blades piece by piece.
    using TakeBlades = std::function<void(std::span<const shared::PackedBlade>)>;

    virtual ~BladePieces() = default;

    /// Number of blades, and of keys.
    virtual std::uint64_t count() const = 0;

    /// Hands over all blades.
    virtual void eachBlade(const TakeBlades& take) const = 0;

    /// Hands over byte `byte` (0 to sizeof(BladeKey) - 1) of all keys.
    virtual void eachKeyByte(std::size_t byte, const TakeBytes& take) const = 0;
};

/// The frames of a field's seeds that do not lie in memory, for writeField().
class SeedPieces {
public:
    virtual ~SeedPieces() = default;

    /// Hands over all bytes in the order of the cells: SeedsView::elsewhere of them.
    virtual void eachSeedByte(const TakeBytes& take) const = 0;
};

} // namespace sward::field
