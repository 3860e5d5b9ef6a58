#pragma once

#include <cstddef>
#include <span>

namespace sward::terrain {

// The filters of EXT_meshopt_compression, Appendix B, in place. Not meshoptimizer's: they use
// rsqrtps, whose last bits differ between CPU makers, and normals determine where blades grow.
// Input that the extension leaves unspecified gives zeros or the nearest representable value.

/// Unit vectors of four signed bytes (`stride` 4) or words (8).
void decodeOctahedral(std::span<std::byte> elements, std::size_t stride);

/// Unit quaternions of four signed words.
void decodeQuaternions(std::span<std::byte> elements);

/// Floats of a mantissa of 24 bits and an exponent of 8.
void decodeExponential(std::span<std::byte> elements);

} // namespace sward::terrain
