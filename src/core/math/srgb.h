#pragma once

#include <cmath>

namespace sward {

/// Transfer functions of sRGB (IEC 61966-2-1) for values in [0, 1]: to linear light, and back.
inline float linearOf(float encoded)
{
    return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

inline float encodedOf(float linear)
{
    return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1.0f / 2.4f) - 0.055f;
}

} // namespace sward
