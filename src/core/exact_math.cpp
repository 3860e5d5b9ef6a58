#include "core/exact_math.h"

#include "core/floor.h"

#include <cmath>
#include <cstddef>
#include <iterator>

namespace sward {
namespace {

constexpr double pi = 3.14159265358979323846;

// Taylor series of atan on |x| ≤ tan(π/16), where eleven terms leave less than 1e-16.
double atanSmall(double x)
{
    constexpr double terms[] = {1.0 / 21.0, 1.0 / 19.0, 1.0 / 17.0, 1.0 / 15.0,
                                1.0 / 13.0, 1.0 / 11.0, 1.0 / 9.0,  1.0 / 7.0,
                                1.0 / 5.0,  1.0 / 3.0,  1.0};
    const double x2 = x * x;
    double sum = 0.0;
    for (const double term : terms)
        sum = term - x2 * sum;
    return x * sum;
}

// atan on [0, 1]: atan(x) = 2·atan(x / (1 + √(1 + x²))), applied twice.
double atanUnit(double x)
{
    const double half = x / (1.0 + std::sqrt(1.0 + x * x));
    const double quarter = half / (1.0 + std::sqrt(1.0 + half * half));
    return 4.0 * atanSmall(quarter);
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
