#include "likeness.h"

#include "core/math/srgb.h"

#include <algorithm>
#include <array>
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

/// A plane of numbers, rows from the top.
struct Plane {
    std::size_t width, height;
    std::vector<double> at;
};

/// Luma of pixels, as encoded.
Plane lumaOf(const std::vector<std::byte>& pixels, glm::uvec2 size)
{
    Plane luma{size.x, size.y, std::vector<double>(std::size_t(size.x) * size.y)};
    for (std::size_t i = 0; i < luma.at.size(); ++i)
        luma.at[i] = 0.2126 * valueAt(pixels, 4 * i) + 0.7152 * valueAt(pixels, 4 * i + 1) +
                     0.0722 * valueAt(pixels, 4 * i + 2);
    return luma;
}

Plane product(const Plane& a, const Plane& b)
{
    Plane result = a;
    for (std::size_t i = 0; i < a.at.size(); ++i)
        result.at[i] *= b.at[i];
    return result;
}

/// Means over Gaussian windows that lie in the plane.
Plane blurred(const Plane& plane)
{
    constexpr std::size_t reach = 5;
    std::array<double, 2 * reach + 1> weights{};
    double sum = 0.0;
    for (std::size_t i = 0; i < weights.size(); ++i)
        sum += weights[i] = std::exp(-std::pow(double(i) - double(reach), 2.0) / (2.0 * 1.5 * 1.5));
    // Along rows, and turned; then the same again.
    const auto half = [&](const Plane& from) {
        Plane turned{from.height, from.width - 2 * reach, {}};
        turned.at.resize(turned.width * turned.height);
        for (std::size_t y = 0; y < from.height; ++y)
            for (std::size_t x = 0; x < turned.height; ++x) {
                double mean = 0.0;
                for (std::size_t i = 0; i < weights.size(); ++i)
                    mean += weights[i] / sum * from.at[y * from.width + x + i];
                turned.at[x * turned.width + y] = mean;
            }
        return turned;
    };
    return half(half(plane));
}

} // namespace

double structuralError(const std::vector<std::byte>& a, const std::vector<std::byte>& b,
                       glm::uvec2 size)
{
    constexpr double c1 = 0.01 * 255.0 * 0.01 * 255.0;
    constexpr double c2 = 0.03 * 255.0 * 0.03 * 255.0;
    const Plane x = lumaOf(a, size);
    const Plane y = lumaOf(b, size);
    const Plane meanX = blurred(x);
    const Plane meanY = blurred(y);
    const Plane xx = blurred(product(x, x));
    const Plane yy = blurred(product(y, y));
    const Plane xy = blurred(product(x, y));
    double sum = 0.0;
    for (std::size_t i = 0; i < meanX.at.size(); ++i) {
        const double mx = meanX.at[i];
        const double my = meanY.at[i];
        sum += (2.0 * mx * my + c1) * (2.0 * (xy.at[i] - mx * my) + c2) /
               ((mx * mx + my * my + c1) * (xx.at[i] - mx * mx + yy.at[i] - my * my + c2));
    }
    return 1.0 - sum / double(meanX.at.size());
}

double meanLuminance(const std::vector<std::byte>& pixels)
{
    const auto linear = [&](std::size_t i) {
        return double(linearOf(float(valueAt(pixels, i)) / 255.0f));
    };
    double sum = 0.0;
    for (std::size_t i = 0; i < pixels.size(); i += 4)
        sum += 0.2126 * linear(i) + 0.7152 * linear(i + 1) + 0.0722 * linear(i + 2);
    return 4.0 * sum / double(pixels.size());
}

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
