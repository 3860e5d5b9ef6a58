// Arithmetic of sown blades: integers, and single precision whose results are the same everywhere.
// A shader that includes it enables GL_EXT_shader_explicit_arithmetic_types_int64. Only + - * of
// floats are correctly rounded in Vulkan (and only where none are contracted), so quotients and
// roots are corrected by integers here. Literals are exact, or single values of nine digits.
#ifndef SWARD_SHARED_SOW_EXACT_H
#define SWARD_SHARED_SOW_EXACT_H

#include "shaders/shared/types.h"

SHARED_BEGIN

/// As mixBits() of core/random.h.
SHARED_FN uint64_t sowMix(uint64_t x)
{
    x ^= x >> 30;
    x *= 0xbf58476d1ce4e5b9ul;
    x ^= x >> 27;
    x *= 0x94d049bb133111ebul;
    x ^= x >> 31;
    return x;
}

/// As hashBits() of core/random.h.
SHARED_FN uint64_t sowHash(uint64_t key, uint64_t index)
{
    return sowMix(sowMix(key + 0x9e3779b97f4a7c15ul) ^
                  (index * 0xd1342543de82ef95ul + 0x2545f4914f6cdd1dul));
}

/// The upper half of a hash.
SHARED_FN uint sowUpper(uint64_t bits)
{
    return uint(bits >> 32);
}

/// Uniform in [0, 1), a multiple of 2⁻²⁴, from the highest bits of a hash: uniform() of
/// core/random.h, cut to 24 bits.
SHARED_FN float sowUnit(uint64_t bits)
{
    return float(sowUpper(bits) >> 8u) * 5.9604644775390625e-8f;
}

/// √x, correctly rounded. `x` is normal or 0.
SHARED_FN float sowSqrt(float x)
{
    if (x <= 0.0f)
        return 0.0f;
    const uint bits = floatBitsToUint(x);
    uint root = floatBitsToUint(sqrt(x));
    const int exponent = int(bits >> 23u) - 150;
    const uint64_t wide = uint64_t((bits & 0x7fffffu) | 0x800000u);
    for (int i = 0; i < 4; ++i) {
        const uint64_t r = uint64_t((root & 0x7fffffu) | 0x800000u);
        const int shift = exponent - 2 * (int(root >> 23u) - 150) + 2;
        const uint64_t scaled = wide << shift;
        if (scaled > (r + r + 1ul) * (r + r + 1ul))
            root += 1u;
        else if (scaled < (r + r - 1ul) * (r + r - 1ul))
            root -= 1u;
        else
            break;
    }
    return uintBitsToFloat(root);
}

/// a / b, correctly rounded, for a ≥ 0 and b > 0 whose quotient is normal or 0.
SHARED_FN float sowDivide(float a, float b)
{
    if (a <= 0.0f)
        return 0.0f;
    const uint above = floatBitsToUint(a);
    const uint below = floatBitsToUint(b);
    uint quotient = floatBitsToUint(a / b);
    const int64_t dividend = int64_t((above & 0x7fffffu) | 0x800000u);
    const int64_t divisor = int64_t((below & 0x7fffffu) | 0x800000u);
    for (int i = 0; i < 4; ++i) {
        const int64_t q = int64_t((quotient & 0x7fffffu) | 0x800000u);
        const int shift = int(above >> 23u) - int(quotient >> 23u) - int(below >> 23u) + 150;
        const int64_t rest = (dividend << shift) - q * divisor;
        if (rest + rest > divisor)
            quotient += 1u;
        else if (rest + rest < -divisor)
            quotient -= 1u;
        else
            break;
    }
    return uintBitsToFloat(quotient);
}

/// A whole number in single precision; any rounding.
SHARED_FN float sowNear(uint64_t x)
{
    return float(sowUpper(x)) * 4294967296.0f + float(uint(x & 0xfffffffful));
}

/// ⌊√x⌋. The estimate in single precision is within 2¹², the correction within 2; then integers
/// decide.
SHARED_FN uint sowWholeSqrt(uint64_t x)
{
    if (x == 0ul)
        return 0u;
    uint64_t root = uint64_t(uint(clamp(sqrt(sowNear(x)), 1.0f, 4294967040.0f)));
    const uint64_t square = root * root;
    const float perStep = 0.5f / sowNear(root);
    if (x >= square)
        root += uint64_t(uint(sowNear(x - square) * perStep));
    else
        root -= min(root - 1ul, uint64_t(uint(sowNear(square - x) * perStep)));
    root = min(root, uint64_t(0xffffffffu));
    for (int i = 0; i < 64 && root * root > x; ++i)
        root -= 1ul;
    for (int i = 0; i < 64 && x - root * root > root + root; ++i)
        root += 1ul;
    return uint(root);
}

/// Angle of (x, y) from the x axis in turns, [−0.5, 0.5]; error 2·10⁻⁶. 0 for (0, 0).
SHARED_FN float sowAtanTurns(float y, float x)
{
    const float wide = max(abs(x), abs(y));
    if (wide <= 0.0f)
        return 0.0f;
    const float q = sowDivide(min(abs(x), abs(y)), wide);
    const float s = q * q;
    float turns = -0.0018585f;
    turns = turns * s + 0.0083829f;
    turns = turns * s + -0.0185426f;
    turns = turns * s + 0.0308077f;
    turns = turns * s + -0.0529429f;
    turns = turns * s + 0.1591549f;
    turns = turns * q;
    if (abs(y) > abs(x))
        turns = 0.25f - turns;
    if (x < 0.0f)
        turns = 0.5f - turns;
    return y < 0.0f ? -turns : turns;
}

/// (cosine, sine) of an angle in turns, |turns| < 2¹⁶; error 10⁻⁶.
SHARED_FN vec2 sowDirection(float turns)
{
    const float quarters = floor(turns * 4.0f + 0.5f);
    const float r = (turns - quarters * 0.25f) * 6.28318531f;
    const float q = r * r;
    float s = -0.000195152960f;
    s = s * q + 0.00833215524f;
    s = s * q + -0.166666657f;
    s = (s * q + 1.0f) * r;
    float c = 0.0000243904487f;
    c = c * q + -0.00138867637f;
    c = c * q + 0.0416666418f;
    c = c * q + -0.5f;
    c = c * q + 1.0f;
    const int quarter = int(quarters) & 3;
    if (quarter == 0)
        return vec2(c, s);
    if (quarter == 1)
        return vec2(-s, c);
    if (quarter == 2)
        return vec2(-c, -s);
    return vec2(s, -c);
}

SHARED_END
#endif
