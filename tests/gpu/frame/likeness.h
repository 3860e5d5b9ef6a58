#pragma once

#include <glm/vec2.hpp>

#include <cstddef>
#include <vector>

namespace sward::test {

// What pictures of one scene by two ways of drawing must reach. Edges may differ by 1/256 pixel.
constexpr double minPsnr = 40.0;           ///< [dB]
constexpr double minPsnrOfThickets = 39.0; ///< [dB] where many pixels show several blades
constexpr double minPsnrOfFolds = 37.0;    ///< [dB] where a pixel of four samples shows both halves
                                           ///< of a folded blade: they have one light
constexpr double maxTileDifference = 2.0;  ///< of 255

/// How alike two pictures of the same grass are. RGBA, 8 bits, rows from the top.
struct Likeness {
    double psnr = 0.0;      ///< [dB] over the pixels with grass
    double grass = 0.0;     ///< [0, 1] share of pixels with grass
    double worstTile = 0.0; ///< largest mean signed difference of a tile of 32 × 32 pixels, of 255
};

/// Compares `a` and `b`. Pixels with grass are those in which either differs from `bare`, the
/// picture without grass.
Likeness likeness(const std::vector<std::byte>& a, const std::vector<std::byte>& b,
                  const std::vector<std::byte>& bare, glm::uvec2 size);

/// 1 − SSIM of the luma of two pictures (Wang et al. 2004): Gaussian windows of σ 1.5 pixels.
double structuralError(const std::vector<std::byte>& a, const std::vector<std::byte>& b,
                       glm::uvec2 size);

/// Mean of ITU-R BT.709 luminance, linear.
double meanLuminance(const std::vector<std::byte>& pixels);

} // namespace sward::test
