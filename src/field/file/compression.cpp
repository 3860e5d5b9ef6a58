#include "field/file/compression.h"

#include "core/error.h"
#include "core/expect.h"

#include <zstd.h>

#include <algorithm>
#include <array>
#include <memory>
#include <utility>

namespace sward::field {
namespace {

// Higher levels gain nothing on quantised blades and take several times as long.
constexpr int level = 3;

// Bytes regrouped per step: a block stays in the cache between regrouping and zstd.
constexpr std::size_t blockBytes = std::size_t(1) << 16;

// The largest window of a frame that is read, 2^25 bytes. Levels up to 19 have 8 MB.
constexpr int largestWindow = 25;

// A frame may hold so many bytes, and so many times its own.
constexpr std::size_t plainBytes = std::size_t(256) << 20;
constexpr std::size_t largestRatio = 4096;

// Frames of more bytes than this, and than so many times their own, are unpacked once on trial.
constexpr std::size_t trustedBytes = std::size_t(1) << 20;
constexpr std::size_t trustedRatio = 32;

// Calls visit(byte of the element, first element, number of elements) for each block, in storage
// order.
template <typename Visit>
void forEachBlock(std::size_t rawBytes, std::size_t elementBytes, Visit visit)
{
    const std::size_t count = rawBytes / elementBytes;
    for (std::size_t byte = 0; byte < elementBytes; ++byte)
        for (std::size_t first = 0; first < count; first += blockBytes)
            visit(byte, first, std::min(blockBytes, count - first));
}

// Unpacks a frame piece by piece.
class Unpacker {
public:
    Unpacker(std::span<const std::byte> stored, const std::string& place)
        : in_{stored.data(), stored.size(), 0}
        , place_(place)
    {
        ZSTD_DCtx_setParameter(context_.get(), ZSTD_d_windowLogMax, largestWindow);
    }

    // The number of bytes unpacked; less than `size` only at the end of the frame.
    std::size_t take(std::byte* bytes, std::size_t size)
    {
        ZSTD_outBuffer out{bytes, size, 0};
        while (out.pos < out.size) {
            const std::size_t before = in_.pos + out.pos;
            const std::size_t left = ZSTD_decompressStream(context_.get(), &out, &in_);
            if (ZSTD_isError(left) != 0)
                fail(ErrorKind::input, "{}: the compressed data is damaged", place_);
            if (left == 0 || in_.pos + out.pos == before)
                break;
        }
        return out.pos;
    }

    bool isAtEnd() const { return in_.pos == in_.size; }

private:
    std::unique_ptr<ZSTD_DCtx, decltype(&ZSTD_freeDCtx)> context_{ZSTD_createDCtx(),
                                                                  ZSTD_freeDCtx};
    ZSTD_inBuffer in_;
    const std::string& place_;
};

void requireSize(std::span<const std::byte> stored, std::size_t rawBytes, const std::string& place)
{
    if (ZSTD_getFrameContentSize(stored.data(), stored.size()) != rawBytes)
        fail(ErrorKind::input, "{}: the compressed data does not hold {} bytes", place, rawBytes);
}

[[noreturn]] void failLength(std::size_t total, std::size_t rawBytes, const std::string& place)
{
    fail(ErrorKind::input, "{}: decompresses to {} bytes instead of {}", place, total, rawBytes);
}

} // namespace

struct Compressor::Context {
    std::unique_ptr<ZSTD_CCtx, decltype(&ZSTD_freeCCtx)> zstd{ZSTD_createCCtx(), ZSTD_freeCCtx};
    UninitializedVector<std::byte> out = UninitializedVector<std::byte>(ZSTD_CStreamOutSize());
};

Compressor::Compressor(std::uint64_t rawBytes, TakeBytes take)
    : context_(std::make_unique<Context>())
    , take_(std::move(take))
{
    ZSTD_CCtx_setParameter(context_->zstd.get(), ZSTD_c_compressionLevel, level);
    ZSTD_CCtx_setPledgedSrcSize(context_->zstd.get(), rawBytes);
}

Compressor::~Compressor() = default;

void Compressor::feed(std::span<const std::byte> raw, bool isEnd)
{
    ZSTD_inBuffer in{raw.data(), raw.size(), 0};
    for (std::size_t left = 1; isEnd ? left != 0 : in.pos < in.size;) {
        ZSTD_outBuffer out{context_->out.data(), context_->out.size(), 0};
        left = ZSTD_compressStream2(context_->zstd.get(), &out, &in,
                                    isEnd ? ZSTD_e_end : ZSTD_e_continue);
        expect(ZSTD_isError(left) == 0, "zstd compresses as many bytes as were announced");
        if (out.pos > 0)
            take_(std::span<const std::byte>(context_->out).first(out.pos));
    }
}

void Compressor::add(std::span<const std::byte> raw)
{
    feed(raw, false);
}

void Compressor::finish()
{
    feed({}, true);
}

void regroup(std::span<const std::byte> raw, std::size_t elementBytes, std::size_t byte,
             const TakeBytes& take)
{
    expect(raw.size() % elementBytes == 0, "whole elements");
    std::array<std::byte, blockBytes> block;
    const std::size_t count = raw.size() / elementBytes;
    for (std::size_t first = 0; first < count; first += blockBytes) {
        const std::size_t n = std::min(blockBytes, count - first);
        const std::byte* const from = raw.data() + first * elementBytes + byte;
        for (std::size_t i = 0; i < n; ++i)
            block[i] = from[i * elementBytes];
        take(std::span<const std::byte>(block).first(n));
    }
}

UninitializedVector<std::byte> compress(std::span<const std::byte> raw, std::size_t elementBytes)
{
    UninitializedVector<std::byte> stored;
    stored.reserve(ZSTD_compressBound(raw.size()));
    Compressor compressor(raw.size(), [&](std::span<const std::byte> piece) {
        stored.insert(stored.end(), piece.begin(), piece.end());
    });
    for (std::size_t byte = 0; byte < elementBytes; ++byte)
        regroup(raw, elementBytes, byte,
                [&](std::span<const std::byte> piece) { compressor.add(piece); });
    compressor.finish();
    return stored;
}

std::uint64_t claimedBytes(std::span<const std::byte> stored)
{
    return ZSTD_getFrameContentSize(stored.data(), stored.size());
}

void checkClaim(std::span<const std::byte> stored, std::size_t rawBytes, const std::string& place)
{
    requireSize(stored, rawBytes, place);
    if (rawBytes > plainBytes && (rawBytes - plainBytes) / largestRatio > stored.size())
        fail(ErrorKind::input,
             "{}: {} compressed bytes claim to hold {}, more than {} and {} for each", place,
             stored.size(), rawBytes, plainBytes, largestRatio);
    if (rawBytes <= trustedBytes + trustedRatio * stored.size())
        return;
    // Unpack it once without keeping it, so that no memory is taken for what is only claimed.
    Unpacker unpacker(stored, place);
    std::array<std::byte, blockBytes> block;
    std::size_t total = 0;
    for (std::size_t taken = blockBytes; taken == blockBytes; total += taken)
        taken = unpacker.take(block.data(), blockBytes);
    if (total != rawBytes)
        failLength(total, rawBytes, place);
}

void decompress(std::span<const std::byte> stored, std::size_t elementBytes,
                std::span<std::byte> raw, const std::string& place)
{
    requireSize(stored, raw.size(), place);
    expect(raw.size() % elementBytes == 0, "whole elements");
    Unpacker unpacker(stored, place);
    std::array<std::byte, blockBytes> block;
    std::size_t total = 0;
    forEachBlock(raw.size(), elementBytes, [&](std::size_t byte, std::size_t first, std::size_t n) {
        const std::size_t taken = unpacker.take(block.data(), n);
        total += taken;
        if (taken < n)
            failLength(total, raw.size(), place);
        std::byte* const to = raw.data() + first * elementBytes + byte;
        for (std::size_t i = 0; i < n; ++i)
            to[i * elementBytes] = block[i];
    });
    // The frame must end with its checksum, and the chunk with the frame.
    std::byte beyond = {};
    if (unpacker.take(&beyond, 1) != 0 || !unpacker.isAtEnd())
        fail(ErrorKind::input, "{}: decompresses to more than {} bytes, or bytes follow its end",
             place, raw.size());
}

} // namespace sward::field
