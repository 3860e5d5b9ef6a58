#pragma once

#include "bake/blades/clumps.h"
#include "bake/ground/root_sample.h"
#include "core/random.h"
#include "shaders/shared/blade.h"

#include <algorithm>
#include <cstdint>

namespace sward::bake {

/// Random numbers of one blade and of its clump.
class Dice {
public:
    /// Without a clump, the blade counts as one of its own.
    Dice(std::uint64_t seed, field::BladeKey key, const Clumps::Clump* clump)
        : own_(hashBits(seed, keyBits(key)))
        , hash_(hashBits(seed + 1, keyBits(key)))
        , clumpKey_(clump != nullptr ? clump->key : own_)
        , clump_(hashBits(clumpKey_, 0))
    {
    }

    /// Uniform in [0, 1), of the blade.
    double own(Dimension dimension) const { return uniformOf(own_, dimension); }

    /// Uniform in [0, 1), the same for all blades of the clump.
    double clump(Dimension dimension) const { return uniformOf(clump_, dimension); }

    /// Blends the blade's own number with its clump's.
    double blended(Dimension dimension, double share) const
    {
        return own(dimension) + share * (clump(dimension) - own(dimension));
    }

    /// The clump's number in a blade, below shared::driedClump.
    std::uint32_t clumpNumber() const
    {
        return std::min(static_cast<std::uint32_t>(hashBits(clumpKey_, 1) & 255U),
                        shared::driedClump - 1U);
    }

    /// The blade's hash, 0 to 15.
    std::uint32_t hash() const { return static_cast<std::uint32_t>(hash_ & 15U); }

private:
    /// The last step of uniform().
    static double uniformOf(std::uint64_t bits, Dimension dimension)
    {
        return static_cast<double>(hashBits(bits, static_cast<std::uint32_t>(dimension)) >> 11) *
               0x1.0p-53;
    }

    std::uint64_t own_;
    std::uint64_t hash_;
    std::uint64_t clumpKey_;
    std::uint64_t clump_;
};

} // namespace sward::bake
