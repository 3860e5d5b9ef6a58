#include "core/exact_math.h"

#include <cmath>

namespace sward {
namespace {

constexpr double pi = 3.14159265358979323846;

// Taylor series of atan on |x| ≤ tan(π/16), where eleven terms leave less than 1e-16.
double atanSmall(double x)
{
    const double x2 = x * x;
    double sum = 0.0;
    for (int n = 21; n >= 1; n -= 2)
        sum = 1.0 / n - x2 * sum;
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
    const double turns = std::floor(radians * (2.0 / pi) + 0.5);
    const double r = (radians - turns * halfPiHigh) - turns * halfPiLow;
    const double r2 = r * r;

    // Taylor series on |r| ≤ π/4; the first term left out is below 1e-16.
    double s = 0.0;
    double c = 0.0;
    for (int n = 8; n >= 1; --n) {
        s = (1.0 - s) * r2 / ((2.0 * n) * (2.0 * n + 1.0));
        c = (1.0 - c) * r2 / ((2.0 * n - 1.0) * (2.0 * n));
    }
    s = r * (1.0 - s);
    c = 1.0 - c;

    switch (static_cast<long long>(turns) & 3) {
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
