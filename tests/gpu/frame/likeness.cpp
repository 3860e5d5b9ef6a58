#include "likeness.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace sward::test {
namespace {

constexpr std::uint32_t tile = 32; ///< [pixels]

double valueAt(const std::vector<std::byte>& pixels, std::size_t i)
{
    return std::to_integer<int>(pixels[i]);
}

double worstTile(const std::vector<std::byte>& a, const std::vector<std::byte>& b, glm::uvec2 size)
{
    double worst = 0.0;
    for (std::uint32_t row = 0; row + tile <= size.y; row += tile)
        for (std::uint32_t column = 0; column + tile <= size.x; column += tile) {
            double sum = 0.0;
            for (std::uint32_t y = row; y < row + tile; ++y)
                for (std::uint32_t x = column; x < column + tile; ++x)
                    for (std::size_t c = 0; c < 3; ++c) {
                        const std::size_t i = 4 * (std::size_t(y) * size.x + x) + c;
                        sum += valueAt(a, i) - valueAt(b, i);
                    }
            worst = std::max(worst, std::fabs(sum) / (3.0 * tile * tile));
        }
    return worst;
}

} // namespace

Likeness likeness(const std::vector<std::byte>& a, const std::vector<std::byte>& b,
                  const std::vector<std::byte>& bare, glm::uvec2 size)
{
    double error = 0.0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.size(); i += 4) {
        if (std::equal(&a[i], &a[i] + 4, &bare[i]) && std::equal(&b[i], &b[i] + 4, &bare[i]))
            continue;
        for (std::size_t c = 0; c < 3; ++c)
            error += std::pow(valueAt(a, i + c) - valueAt(b, i + c), 2.0);
        ++count;
    }
    return {.psnr = 10.0 * std::log10(255.0 * 255.0 * 3.0 * double(count) / std::max(error, 1e-9)),
            .grass = 4.0 * double(count) / double(a.size()),
            .worstTile = worstTile(a, b, size)};
}

} // namespace sward::test
