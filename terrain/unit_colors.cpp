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

} // namespace

void bringToUnit(std::span<glm::vec4> colors, const std::string& place, const std::string& what,
                 Diagnostics& diagnostics)
{
    float largest = 0.0f;
    float largestAlpha = 0.0f;
    float least = 0.0f;
    for (const glm::vec4& color : colors) {
        largest = std::max({largest, color.x, color.y, color.z});
        largestAlpha = std::max(largestAlpha, color.w);
        least = std::min({least, color.x, color.y, color.z, color.w});
    }
    const float divisor = divisorOf(largest);
    const float alphaDivisor = divisorOf(largestAlpha);
    const float over = std::max(largest, largestAlpha);
    if (divisor > 1.0f || alphaDivisor > 1.0f)
        diagnostics.warn("{}: {} reaches {:.6g}, not 1: its numbers are divided by {}", place, what,
                         over, std::max(divisor, alphaDivisor));
    else if (over > 1.0f + tolerance || least < -tolerance)
        diagnostics.warn("{}: {} lies from {:.6g} to {:.6g}, and is cut off at 0 and 1", place,
                         what, least, over);
    const glm::vec4 factor(glm::vec4(divisor, divisor, divisor, alphaDivisor));
    for (glm::vec4& color : colors)
        color = glm::clamp(color / factor, 0.0f, 1.0f);
}

} // namespace sward::terrain
