#include "core/math/exact_math.h"

#include "core/math/floor.h"

#include <cmath>
#include <cstddef>
#include <iterator>

namespace sward {
namespace {

constexpr double pi = 3.14159265358979323846;

// atan on [0, 1]: atan(x) = atan(c) + atan((x − c) / (1 + xc)), with c the nearest sixteenth. On
// the remainder, at most 1/32, five terms of the Taylor series leave less than 1e-17.
double atanUnit(double x)
{
    constexpr double sixteenths[] = {0x0.0p+0,
                                     0x1.ff55bb72cfdeap-5,
                                     0x1.fd5ba9aac2f6ep-4,
                                     0x1.7b97b4bce5b02p-3,
                                     0x1.f5b75f92c80ddp-3,
                                     0x1.362773707ebccp-2,
                                     0x1.6f61941e4def1p-2,
                                     0x1.a64eec3cc23fdp-2,
                                     0x1.dac670561bb4fp-2,
                                     0x1.0657e94db30d0p-1,
                                     0x1.1e00babdefeb4p-1,
                                     0x1.345f01cce37bbp-1,
                                     0x1.4978fa3269ee1p-1,
                                     0x1.5d58987169b18p-1,
                                     0x1.700a7c5784634p-1,
                                     0x1.819d0b7158a4dp-1,
                                     0x1.921fb54442d18p-1};
    const auto nearest = static_cast<std::size_t>(x * 16.0 + 0.5);
    const double c = static_cast<double>(nearest) * (1.0 / 16.0);
    const double rest = (x - c) / (1.0 + x * c);
    const double squared = rest * rest;
    constexpr double terms[] = {1.0 / 9.0, 1.0 / 7.0, 1.0 / 5.0, 1.0 / 3.0, 1.0};
    double sum = 0.0;
    for (const double term : terms)
        sum = term - squared * sum;
    return sixteenths[nearest] + rest * sum;
}

} // namespace

SinCos exactSinCos(double radians)
{
    // Reduce to the nearest quarter turn; π/2 in two parts keeps the remainder exact.
    constexpr double halfPiHigh = 0x1.921fb544p+0;
    constexpr double halfPiLow = 0x1.0b4611a626331p-34;
    const std::int64_t quarters = floorOf(radians * (2.0 / pi) + 0.5);
    const auto turns = static_cast<double>(quarters);
    const double r = (radians - turns * halfPiHigh) - turns * halfPiLow;
    const double r2 = r * r;

    // Taylor series on |r| ≤ π/4; the first term left out is below 1e-16. Ratios of successive
    // terms: 1/(2n (2n + 1)) for the sine, 1/((2n − 1) 2n) for the cosine.
    constexpr double sines[] = {1.0 / 272.0, 1.0 / 210.0, 1.0 / 156.0, 1.0 / 110.0,
                                1.0 / 72.0,  1.0 / 42.0,  1.0 / 20.0,  1.0 / 6.0};
    constexpr double cosines[] = {1.0 / 240.0, 1.0 / 182.0, 1.0 / 132.0, 1.0 / 90.0,
                                  1.0 / 56.0,  1.0 / 30.0,  1.0 / 12.0,  1.0 / 2.0};
    double s = 0.0;
    double c = 0.0;
    for (std::size_t i = 0; i < std::size(sines); ++i) {
        s = (1.0 - s) * r2 * sines[i];
        c = (1.0 - c) * r2 * cosines[i];
    }
    s = r * (1.0 - s);
    c = 1.0 - c;

    switch (quarters & 3) {
    case 0:
        return {s, c};
    case 1:
        return {c, -s};
    case 2:
        return {-s, -c};
    default:
        return {-c, s};
    }
}

double exactAtan2(double y, double x)
{
    const double ax = std::fabs(x);
    const double ay = std::fabs(y);
    if (ax == 0.0 && ay == 0.0)
        return 0.0;
    double angle = ay <= ax ? atanUnit(ay / ax) : pi / 2.0 - atanUnit(ax / ay);
    if (x < 0.0)
        angle = pi - angle;
    return y < 0.0 ? -angle : angle;
}

double exactAcos(double c)
{
    const double clamped = c < -1.0 ? -1.0 : c > 1.0 ? 1.0 : c;
    return exactAtan2(std::sqrt((1.0 - clamped) * (1.0 + clamped)), clamped);
}

} // namespace sward
