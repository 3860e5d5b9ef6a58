#pragma once

#include <cstddef>
#include <span>

namespace sward::terrain {

// The filters of EXT_meshopt_compression, Appendix B, in place. They are not left to meshoptimizer:
// its own use rsqrtps, whose last bits differ from one maker of CPUs to the other, and normals
// decide where blades grow to. Input that the extension calls unspecified gives zeros or the
// nearest value that fits.

/// Unit vectors of four signed bytes (`stride` 4) or words (8).
void decodeOctahedral(std::span<std::byte> elements, std::size_t stride);

/// Unit quaternions of four signed words.
void decodeQuaternions(std::span<std::byte> elements);

/// Floats of a mantissa of 24 bits and an exponent of 8.
void decodeExponential(std::span<std::byte> elements);

} // namespace sward::terrain
