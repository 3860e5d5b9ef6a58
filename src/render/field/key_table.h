#pragma once

#include "core/random.h"
#include "field/field.h"
#include "shaders/shared/edits.h"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace sward::render {

inline bool sameKey(field::BladeKey a, field::BladeKey b)
{
    return a.triangle == b.triangle && a.candidate == b.candidate;
}

/// Finds blades by their keys.
class KeyTable {
public:
    /// `keys` must outlive it.
    explicit KeyTable(std::span<const field::BladeKey> keys)
        : keys_(keys)
        , slots_(std::bit_ceil(2 * keys.size() + 1), shared::noSource)
    {
        for (std::uint32_t i = 0; i < keys.size(); ++i) {
            if (i > 0 && sameKey(keys[i], keys[i - 1]))
                continue;
            std::size_t slot = slotOf(keys[i]);
            while (slots_[slot] != shared::noSource)
                slot = (slot + 1) & (slots_.size() - 1);
            slots_[slot] = i;
        }
    }

    /// The blade that follows the first one of a key as number `repeated`; noSource if none does.
    std::uint32_t find(field::BladeKey key, std::uint32_t repeated) const
    {
        for (std::size_t slot = slotOf(key); slots_[slot] != shared::noSource;
             slot = (slot + 1) & (slots_.size() - 1)) {
            if (!sameKey(keys_[slots_[slot]], key))
                continue;
            const std::size_t i = std::size_t(slots_[slot]) + repeated;
            return i < keys_.size() && sameKey(keys_[i], key) ? static_cast<std::uint32_t>(i)
                                                              : shared::noSource;
        }
        return shared::noSource;
    }

private:
    std::size_t slotOf(field::BladeKey key) const
    {
        return mixBits(std::uint64_t(key.triangle) << 32U | key.candidate) & (slots_.size() - 1);
    }

    std::span<const field::BladeKey> keys_;
    std::vector<std::uint32_t> slots_;
};

} // namespace sward::render
