// Reading a delta gives a verified change or an Error. Length and hash are repaired first.

#include "core/error.h"
#include "field/delta.h"
#include "fuzz/memory_file.h"

#include <xxhash.h>

#include <cstring>
#include <vector>

namespace sward::fuzz {

void fieldDelta(Bytes bytes)
{
    constexpr std::size_t lengthAt = 8;
    constexpr std::size_t hashAt = 16;
    constexpr std::size_t hashed = 24;
    std::vector<std::uint8_t> mended(bytes.begin(), bytes.end());
    if (mended.size() > hashed) {
        const std::uint64_t length = mended.size();
        std::memcpy(mended.data() + lengthAt, &length, sizeof length);
        const std::uint64_t hash = XXH3_64bits(mended.data() + hashed, mended.size() - hashed);
        std::memcpy(mended.data() + hashAt, &hash, sizeof hash);
    }
    const std::vector<field::Species> species(2);
    try {
        field::readDelta(memoryFile().hold(mended, ".swdelta"), species);
    } catch (const Error&) {
    }
}

} // namespace sward::fuzz
