#include "terrain/heightmap/height_samples.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace sward::terrain {
namespace {

constexpr std::size_t fewSamples = 256;     // too few to judge by
constexpr double smallShare = 1.0 / 32.0;   // of the format's values
constexpr std::size_t valuesOfByte = 256;
constexpr double wordLimit = 65535.0;

// Which whole values occur.
std::vector<bool> metValues(const HeightSamples& samples)
{
    std::vector<bool> met(static_cast<std::size_t>(wordLimit) + 1, false);
    for (const float value : samples.values)
        if (value >= 0.0f && static_cast<double>(value) <= wordLimit)
            met[static_cast<std::size_t>(value)] = true;
    return met;
}

// Whether each value that occurs is a multiple of `factor`.
bool areMultiples(const std::vector<bool>& met, std::size_t factor)
{
    for (std::size_t value = 0; value < met.size(); ++value)
        if (met[value] && value % factor != 0)
            return false;
    return true;
}

// Samples of 8 or 16 bits.
void hintAtWords(const HeightSamples& samples, const std::string& place, Diagnostics& diagnostics)
{
    const std::vector<bool> met = metValues(samples);
    const auto distinct = static_cast<std::size_t>(std::count(met.begin(), met.end(), true));
    std::size_t low = 0;
    while (low < met.size() && !met[low])
        ++low;
    std::size_t high = met.size() - 1;
    while (high > low && !met[high])
        --high;
    if (distinct < 2)
        return;
    const bool isWide = samples.full > 255.0;
    for (const std::size_t factor : {std::size_t(257), std::size_t(256)})
        if (isWide && areMultiples(met, factor)) {
            diagnostics.warn("{}: 8 bits in 16: each height is a multiple of {}, {} values of {} "
                             "occur, which makes terraces; export the heightmap with 16 bits",
                             place, factor, distinct, samples.full + 1.0);
            return;
        }
    const double share = static_cast<double>(high - low) / samples.full;
    if (share < smallShare)
        diagnostics.warn("{}: its heights use {:.3g} % of the range of {} bits, from {} to {}{}; "
                         "--height MIN:MAX are the heights of 0 and {}",
                         place, 100.0 * share, isWide ? 16 : 8, low, high,
                         isWide && high < valuesOfByte ? " (bytes in words of 16 bits, which makes "
                                                         "terraces)"
                                                       : "",
                         samples.full);
    else if (isWide && distinct <= valuesOfByte && samples.values.size() > 16 * valuesOfByte)
        diagnostics.warn("{}: {} of {} values occur, which makes terraces; export the heightmap "
                         "with 16 bits",
                         place, distinct, samples.full + 1.0);
}

// Samples in metres that are shares of a range instead.
void hintAtShares(const HeightSamples& samples, const std::string& place, Diagnostics& diagnostics)
{
    float low = 1.0f;
    float high = 0.0f;
    for (const float value : samples.values) {
        if (std::isnan(value))
            continue;
        if (value < 0.0f || value > 1.0f)
            return;
        low = std::min(low, value);
        high = std::max(high, value);
    }
    if (high > low)
        diagnostics.warn("{}: its heights lie between {:.6g} and {:.6g} m; if they are shares of a "
                         "range, --height MIN:MAX tells it",
                         place, low, high);
}

} // namespace

void hintAtFewHeights(const HeightSamples& samples, const std::string& place,
                      Diagnostics& diagnostics)
{
    if (samples.values.size() <= fewSamples)
        return;
    if (samples.isMetric)
        hintAtShares(samples, place, diagnostics);
    else
        hintAtWords(samples, place, diagnostics);
}

} // namespace sward::terrain
