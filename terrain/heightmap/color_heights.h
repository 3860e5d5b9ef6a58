#pragma once

#include "terrain/heightmap/height_samples.h"
#include "terrain/image/png_pixels.h"

#include <span>
#include <string>

namespace sward::terrain {

/// Heights [m] of colours of 8 bits, one for each pixel. Black, the least height of an encoding,
/// stands for no data: NaN. `encoding` is not none.
void decodeHeights(const PngPixels& pixels, HeightEncoding encoding, std::span<float> heights);

/// The end of a warning that proposes --encoding if the colours look like encoded heights: they
/// decode to heights of the Earth that change little from pixel to pixel, without black and
/// transparent ones. Else empty.
std::string encodingHint(const PngPixels& pixels);

} // namespace sward::terrain
