#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <span>

namespace sward {

/// The descriptor of standard input.
inline constexpr int standardInput = 0;

/// Reads what has arrived at `descriptor`, up to bytes.size(). Waits about `patience` for it, so that
/// the caller can look for requests to end meanwhile; a console of Windows may keep it until Enter.
/// Returns the number of bytes, 0 at the end of the input; none if nothing has arrived. Throws
/// Error{io} that names standard input if it cannot be read.
std::optional<std::size_t> readArriving(int descriptor, std::span<char> bytes,
                                        std::chrono::milliseconds patience);

} // namespace sward
