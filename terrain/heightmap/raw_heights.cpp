#include "core/error.h"
#include "terrain/heightmap/height_samples.h"
#include "terrain/heightmap/heightfield.h"

#include <bit>
#include <cmath>

namespace sward::terrain {
namespace {

// The other byte order is right if it is this many times as smooth.
constexpr double smootherFactor = 8.0;

std::uint32_t wordAt(std::span<const std::byte> file, std::size_t index, std::size_t bytes,
                     bool isBigEndian)
{
    std::uint32_t word = 0;
    for (std::size_t i = 0; i < bytes; ++i) {
        const std::size_t at = index * bytes + (isBigEndian ? i : bytes - 1 - i);
        word = word << 8 | std::to_integer<std::uint32_t>(file[at]);
    }
    return word;
}

float rawSampleAt(std::span<const std::byte> file, std::size_t index, const RawLayout& layout)
{
    return layout.isFloat ? std::bit_cast<float>(wordAt(file, index, 4, layout.isBigEndian))
                          : static_cast<float>(wordAt(file, index, 2, layout.isBigEndian));
}

// Sum of steps between neighbours along x. A value that is no height counts as a high step.
double roughness(std::span<const std::byte> file, const glm::uvec2& size, const RawLayout& layout)
{
    constexpr float highStep = 1e9f;
    double sum = 0.0;
    for (std::size_t j = 0; j < size.y; ++j)
        for (std::size_t i = 1; i < size.x; ++i) {
            const std::size_t at = j * size.x + i;
            const float step =
                std::fabs(rawSampleAt(file, at, layout) - rawSampleAt(file, at - 1, layout));
            sum += static_cast<double>(step < highStep ? step : highStep);
        }
    return sum;
}

} // namespace

HeightSamples readRawHeights(std::span<const std::byte> file, const std::optional<glm::uvec2>& size,
                             const RawLayout& layout, const std::string& place,
                             Diagnostics& diagnostics)
{
    const std::size_t bytes = layout.isFloat ? 4 : 2;
    if (!size)
        fail(ErrorKind::usage,
             "{}: --size WxH is missing: raw heights do not tell their size; this file has {} "
             "samples",
             place, file.size() / bytes);
    const std::uint64_t count = std::uint64_t(size->x) * size->y;
    if (size->x < 2 || size->y < 2 || size->x > heightmapSideLimit ||
        size->y > heightmapSideLimit || count > heightPointLimit)
        fail(ErrorKind::usage, "{}: --size {}x{} is outside 2 to {} on a side and {} in all", place,
             size->x, size->y, heightmapSideLimit, heightPointLimit);
    if (file.size() != bytes * count)
        fail(ErrorKind::input, "{}: --size {}x{} needs {} bytes, the file has {}", place, size->x,
             size->y, bytes * count, file.size());

    const RawLayout other{!layout.isBigEndian, layout.isFloat};
    const double own = roughness(file, *size, layout);
    if (own > smootherFactor * roughness(file, *size, other))
        diagnostics.warn("{}: neighbouring heights say that its byte order is the other: try "
                         "--endian {}",
                         place, other.isBigEndian ? "big" : "little");

    HeightSamples samples;
    samples.size = *size;
    samples.full = layout.isFloat ? 1.0 : 65535.0;
    samples.isMetric = layout.isFloat;
    samples.values.reserve(count);
    for (std::size_t i = 0; i < count; ++i)
        samples.values.push_back(rawSampleAt(file, i, layout));
    if (layout.isFloat)
        dropNoData(samples, place, diagnostics);
    return samples;
}

} // namespace sward::terrain
