#include "field/compression.h"

#include "core/error.h"
#include "core/expect.h"

#include <zstd.h>

namespace sward::field {

std::vector<std::byte> compress(std::span<const std::byte> raw)
{
    // Level 3: higher levels gain nothing on quantised blades and cost many times as much.
    std::vector<std::byte> stored(ZSTD_compressBound(raw.size()));
    const std::size_t size = ZSTD_compress(stored.data(), stored.size(), raw.data(), raw.size(), 3);
    expect(ZSTD_isError(size) == 0, "zstd compresses into a buffer of its own bound");
    stored.resize(size);
    return stored;
}

std::vector<std::byte> decompress(std::span<const std::byte> stored, std::size_t rawBytes,
                                  const std::string& place)
{
    // A frame that claims another size is refused before memory is taken for it.
    if (ZSTD_getFrameContentSize(stored.data(), stored.size()) != rawBytes)
        fail(ErrorKind::input, "{}: the compressed data does not hold {} bytes", place, rawBytes);
    std::vector<std::byte> raw(rawBytes);
    const std::size_t size = ZSTD_decompress(raw.data(), raw.size(), stored.data(), stored.size());
    if (ZSTD_isError(size) != 0)
        fail(ErrorKind::input, "{}: cannot decompress: {}", place, ZSTD_getErrorName(size));
    if (size != rawBytes)
        fail(ErrorKind::input, "{}: decompresses to {} bytes instead of {}", place, size, rawBytes);
    return raw;
}

std::vector<std::byte> shuffleBytes(std::span<const std::byte> raw, std::size_t elementBytes)
{
    const std::size_t count = raw.size() / elementBytes;
    std::vector<std::byte> shuffled(raw.size());
    for (std::size_t k = 0; k < elementBytes; ++k)
        for (std::size_t i = 0; i < count; ++i)
            shuffled[k * count + i] = raw[i * elementBytes + k];
    return shuffled;
}

std::vector<std::byte> unshuffleBytes(std::span<const std::byte> shuffled, std::size_t elementBytes)
{
    const std::size_t count = shuffled.size() / elementBytes;
    std::vector<std::byte> raw(shuffled.size());
    for (std::size_t k = 0; k < elementBytes; ++k)
        for (std::size_t i = 0; i < count; ++i)
            raw[i * elementBytes + k] = shuffled[k * count + i];
    return raw;
}

} // namespace sward::field
