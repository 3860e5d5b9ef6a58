#include "terrain/unit_colors.h"

#include <glm/common.hpp>

#include <algorithm>

namespace sward::terrain {
namespace {

// Rounding may exceed 1 by this much without a word.
constexpr float tolerance = 1e-3f;
// Brighter colours than this do not occur; larger numbers are bytes or words.
constexpr float brightest = 2.0f;

// What numbers up to `largest` are to be divided by.
float divisorOf(float largest)
{
    if (largest <= brightest)
        return 1.0f;
    return largest <= 255.0f ? 255.0f : 65535.0f;
}

struct Range {
    float least = 0.0f;
    float largest = 0.0f; // of red, green and blue
    float largestAlpha = 0.0f;
};

Range rangeOf(std::span<const glm::vec4> colors)
{
    Range range;
    for (const glm::vec4& color : colors) {
        range.largest = std::max({range.largest, color.x, color.y, color.z});
        range.largestAlpha = std::max(range.largestAlpha, color.w);
        range.least = std::min({range.least, color.x, color.y, color.z, color.w});
    }
    return range;
}

} // namespace

glm::vec4 scaleToUnit(std::span<glm::vec4> colors, const std::string& place,
                      const std::string& what, Diagnostics& diagnostics)
{
    const Range range = rangeOf(colors);
    const float divisor = divisorOf(range.largest);
    const float alphaDivisor = divisorOf(range.largestAlpha);
    const glm::vec4 factor(divisor, divisor, divisor, alphaDivisor);
    if (divisor <= 1.0f && alphaDivisor <= 1.0f)
        return factor;
    diagnostics.warn("{}: {} reaches {:.6g}, not 1: its numbers are divided by {}", place, what,
                     std::max(range.largest, range.largestAlpha), std::max(divisor, alphaDivisor));
    for (glm::vec4& color : colors)
        color /= factor;
    return factor;
}

void cutToUnit(std::span<glm::vec4> colors, const std::string& place, const std::string& what,
               Diagnostics& diagnostics)
{
    const Range range = rangeOf(colors);
    const float over = std::max(range.largest, range.largestAlpha);
    if (over > 1.0f + tolerance || range.least < -tolerance)
        diagnostics.warn("{}: {} lies from {:.6g} to {:.6g}, and is cut off at 0 and 1", place,
                         what, range.least, over);
    for (glm::vec4& color : colors)
        color = glm::clamp(color, 0.0f, 1.0f);
}

void bringToUnit(std::span<glm::vec4> colors, const std::string& place, const std::string& what,
                 Diagnostics& diagnostics)
{
    scaleToUnit(colors, place, what, diagnostics);
    cutToUnit(colors, place, what, diagnostics);
}

} // namespace sward::terrain
