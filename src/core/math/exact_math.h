#pragma once

namespace sward {

// Trigonometry from +, −, ×, ÷ and √ alone. On CPUs with fused multiply-add the C library uses
// another implementation with other last bits. Code that decides where a blade stands uses these
// functions instead, so that every x86-64 CPU bakes the same bytes. exact_math_test.cpp asserts the
// errors.

struct SinCos {
    double sin;
    double cos;
};

/// 2 π, rounded to double.
inline constexpr double exactTwoPi = 6.28318530717958648;

/// Sine and cosine of `radians`, |radians| ≤ 1e6; absolute error below 1e-10.
SinCos exactSinCos(double radians);

/// Angle of (x, y) from the x axis in (−π, π] [rad]; 0 for (0, 0); absolute error below 1e-14.
double exactAtan2(double y, double x);

/// Angle in [0, π] whose cosine is `c`, clamped to [−1, 1] [rad]; absolute error below 1e-10.
double exactAcos(double c);

} // namespace sward
