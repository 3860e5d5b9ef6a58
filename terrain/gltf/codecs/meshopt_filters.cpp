#include "terrain/gltf/codecs/meshopt_filters.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

namespace sward::terrain {
namespace {

template <typename Value>
std::array<Value, 4> load(const std::byte* bytes)
{
    std::array<Value, 4> values;
    std::memcpy(values.data(), bytes, sizeof values);
    return values;
}

template <typename Value>
void store(std::byte* bytes, const std::array<Value, 4>& values)
{
    std::memcpy(bytes, values.data(), sizeof values);
}

// A number in [-1, 1] as a signed normalised integer, halves away from zero.
template <typename Value>
Value quantize(double number)
{
    constexpr double full = std::numeric_limits<Value>::max();
    const double scaled = std::clamp(number, -1.0, 1.0) * full;
    return static_cast<Value>(static_cast<int>(scaled + (scaled < 0.0 ? -0.5 : 0.5)));
}

template <typename Value>
void decodeOctahedralOf(std::span<std::byte> elements)
{
    for (std::size_t at = 0; at + 4 * sizeof(Value) <= elements.size(); at += 4 * sizeof(Value)) {
        auto v = load<Value>(elements.data() + at);
        // The third number is 1 at this element's precision.
        const double one = std::max(1, int(v[2]));
        double x = v[0] / one;
        double y = v[1] / one;
        const double z = 1.0 - std::fabs(x) - std::fabs(y);

        // Fold the lower half back.
        const double t = std::min(z, 0.0);
        x -= std::copysign(t, x);
        y -= std::copysign(t, y);
        const double length = std::sqrt(x * x + y * y + z * z);
        const double scale = length > 0.0 ? 1.0 / length : 0.0;
        v[0] = quantize<Value>(x * scale);
        v[1] = quantize<Value>(y * scale);
        v[2] = quantize<Value>(z * scale);
        store(elements.data() + at, v);
    }
}

} // namespace

void decodeOctahedral(std::span<std::byte> elements, std::size_t stride)
{
    if (stride == 4)
        decodeOctahedralOf<std::int8_t>(elements);
    else
        decodeOctahedralOf<std::int16_t>(elements);
}

void decodeQuaternions(std::span<std::byte> elements)
{
    constexpr std::size_t size = 8;
    const double range = 1.0 / std::sqrt(2.0);
    for (std::size_t at = 0; at + size <= elements.size(); at += size) {
        const auto v = load<std::int16_t>(elements.data() + at);
        // The last number is 1 at this element's precision; its two lowest bits name the omitted
        // component.
        const double one = std::max(3, int(v[3]) | 3);
        const auto largest = static_cast<std::size_t>(v[3] & 3);
        const double x = v[0] / one * range;
        const double y = v[1] / one * range;
        const double z = v[2] / one * range;
        const double w = std::sqrt(std::max(0.0, 1.0 - x * x - y * y - z * z));
        std::array<std::int16_t, 4> q{};
        q[(largest + 1) % 4] = quantize<std::int16_t>(x);
        q[(largest + 2) % 4] = quantize<std::int16_t>(y);
        q[(largest + 3) % 4] = quantize<std::int16_t>(z);
        q[largest] = quantize<std::int16_t>(w);
        store(elements.data() + at, q);
    }
}

void decodeExponential(std::span<std::byte> elements)
{
    for (std::size_t at = 0; at + 4 <= elements.size(); at += 4) {
        std::int32_t bits = 0;
        std::memcpy(&bits, elements.data() + at, sizeof bits);
        const int exponent = bits >> 24;
        const int mantissa = static_cast<std::int32_t>(static_cast<std::uint32_t>(bits) << 8) >> 8;
        const auto number = static_cast<float>(std::ldexp(mantissa, exponent));
        std::memcpy(elements.data() + at, &number, sizeof number);
    }
}

} // namespace sward::terrain
