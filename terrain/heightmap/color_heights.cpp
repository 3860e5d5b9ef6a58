#include "terrain/heightmap/color_heights.h"

#include "core/error.h"
#include "core/json/settings_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>
#include <vector>

namespace sward::terrain {
namespace {

struct Encoding {
    std::string_view name;
    HeightEncoding encoding;
};
constexpr std::array<Encoding, 2> encodings{
    {{"terrarium", HeightEncoding::terrarium}, {"terrain-rgb", HeightEncoding::terrainRgb}}};

// Heights of the Earth, its seas included, with some room [m].
constexpr double deepestSea = -12'000.0;
constexpr double highestPeak = 9'500.0;

// Share of the pixels that has to have a height.
constexpr double minShare = 0.25;

// Alpha below this is transparent.
constexpr unsigned char halfOpaque = 128;

// Mean step between neighbours of real ground, as a share of the whole range.
constexpr double smoothShare = 0.1;

double heightOf(HeightEncoding encoding, double red, double green, double blue)
{
    return encoding == HeightEncoding::terrarium
               ? red * 256.0 + green + blue / 256.0 - 32768.0
               : (red * 65536.0 + green * 256.0 + blue) * 0.1 - 10'000.0;
}

bool looksLike(const PngPixels& pixels, HeightEncoding encoding)
{
    std::vector<float> heights(std::size_t(pixels.size.x) * pixels.size.y);
    decodeHeights(pixels, encoding, heights);
    if (pixels.hasAlpha())
        for (std::size_t i = 0; i < heights.size(); ++i)
            if (pixels.bytes[i * pixels.channels + 3] < halfOpaque)
                heights[i] = std::numeric_limits<float>::quiet_NaN();
    double low = std::numeric_limits<double>::max();
    double high = std::numeric_limits<double>::lowest();
    std::size_t known = 0;
    for (const float height : heights)
        if (!std::isnan(height)) {
            low = std::min(low, static_cast<double>(height));
            high = std::max(high, static_cast<double>(height));
            ++known;
        }
    if (static_cast<double>(known) < minShare * static_cast<double>(heights.size()))
        return false;
    const double range = high - low;
    if (low < deepestSea || low + range > highestPeak || !(range > 0.0))
        return false;
    double sum = 0.0;
    std::size_t count = 0;
    for (std::size_t i = 1; i < heights.size(); ++i)
        if (i % pixels.size.x != 0 && !std::isnan(heights[i]) && !std::isnan(heights[i - 1])) {
            sum += std::fabs(static_cast<double>(heights[i]) - static_cast<double>(heights[i - 1]));
            ++count;
        }
    return count > 0 && sum / static_cast<double>(count) < smoothShare * range;
}

} // namespace

HeightEncoding heightEncodingOf(const std::string& name, const std::string& place)
{
    if (name.empty())
        return HeightEncoding::none;
    std::vector<std::string> known;
    for (const Encoding& one : encodings) {
        if (one.name == name)
            return one.encoding;
        known.emplace_back(one.name);
    }
    const std::string near = nearestWord(name, known);
    fail(ErrorKind::usage, "{}: --encoding is \"{}\", neither terrarium nor terrain-rgb{}", place,
         name, near.empty() ? "" : fmt::format("; did you mean \"{}\"?", near));
}

void decodeHeights(const PngPixels& pixels, HeightEncoding encoding, std::span<float> heights)
{
    for (std::size_t i = 0; i < heights.size(); ++i) {
        const unsigned char* const color = pixels.bytes.data() + i * pixels.channels;
        const bool isBlack = color[0] == 0 && color[1] == 0 && color[2] == 0;
        heights[i] = isBlack ? std::numeric_limits<float>::quiet_NaN()
                             : static_cast<float>(heightOf(encoding, color[0], color[1], color[2]));
    }
}

std::string encodingHint(const PngPixels& pixels)
{
    if (pixels.isWide || pixels.channels < 3)
        return {};
    for (const Encoding& one : encodings)
        if (looksLike(pixels, one.encoding))
            return fmt::format("; the colours look like heights in metres: try --encoding {}",
                               one.name);
    return {};
}

} // namespace sward::terrain
