#pragma once

#include "core/uninitialized.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>

namespace sward::field {

/// Takes bytes piece by piece.
using TakeBytes = std::function<void(std::span<const std::byte>)>;

/// Hands byte `byte` of every element to `take`, in pieces of at most 64 KiB. `raw` is a whole
/// number of elements.
void regroup(std::span<const std::byte> raw, std::size_t elementBytes, std::size_t byte,
             const TakeBytes& take);

/// Compresses bytes that come in pieces into one zstd frame, in little memory. The frame depends on
/// the bytes alone, not on how they are cut.
class Compressor {
public:
    /// `rawBytes` will come in all. `take` is given the frame in pieces.
    Compressor(std::uint64_t rawBytes, TakeBytes take);
    Compressor(const Compressor&) = delete;
    Compressor& operator=(const Compressor&) = delete;
    ~Compressor();

    void add(std::span<const std::byte> raw); ///< the next bytes
    void finish();                            ///< after the last ones, once

private:
    struct Context;
    void feed(std::span<const std::byte> raw, bool isEnd);

    std::unique_ptr<Context> context_;
    TakeBytes take_;
};

/// Compresses array elements into one zstd frame; the result depends on the input alone. Byte k of
/// all elements is stored together (all first bytes, then all second …). Neighbours in a field have
/// similar high bytes, which then compress. `raw` is a whole number of elements.
UninitializedVector<std::byte> compress(std::span<const std::byte> raw, std::size_t elementBytes);

/// Bytes that a frame declares; some other number if it declares none.
std::uint64_t claimedBytes(std::span<const std::byte> stored);

/// Throws Error{input} naming `place` unless the frame declares `rawBytes`, at most 256 MB and 4096
/// for each of its own. More than 1 MB and 32 for each are unpacked once without being kept, so that
/// memory is allocated only for what is there. Called before that.
void checkClaim(std::span<const std::byte> stored, std::size_t rawBytes, const std::string& place);

/// Undoes compress() into `raw`. Throws Error{input} naming `place` unless the frame holds exactly
/// `raw.size()` bytes.
void decompress(std::span<const std::byte> stored, std::size_t elementBytes,
                std::span<std::byte> raw, const std::string& place);

} // namespace sward::field
