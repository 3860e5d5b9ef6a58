#include "terrain/heightmap/height_samples.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace sward::terrain {
namespace {

// No-data values of surveys, besides non-finite and out-of-range values.
constexpr std::array<float, 4> surveyGaps = {-9999.0f, -32767.0f, -32768.0f, -99999.0f};
constexpr float reach = 1e6f; // [m]

// Values that stand for no data where samples are whole numbers: the least, the largest, and the
// two's complements of −32768, −32767 and −9999 in 16 bits.
constexpr std::array<float, 6> wholeGaps = {0.0f, 255.0f, 65535.0f, 32768.0f, 32769.0f, 55537.0f};

// A gap holds this share of the samples, and the steps at its rim are so many times as high as
// elsewhere, and this share of the whole range.
constexpr double minShare = 1e-3;
constexpr double cliffFactor = 20.0;
constexpr double cliffShare = 0.05;

struct Steps {
    double sum = 0.0;
    std::size_t count = 0;
    double mean() const { return count == 0 ? 0.0 : sum / static_cast<double>(count); }
};

// Passes each pair of neighbours along x and z that both have a height.
template <typename Visit>
void forEachPair(const HeightSamples& samples, Visit visit)
{
    const std::size_t width = samples.size.x;
    const auto pair = [&](float a, float b) {
        if (!std::isnan(a) && !std::isnan(b))
            visit(a, b);
    };
    for (std::size_t i = 0; i < samples.values.size(); ++i) {
        if (i % width + 1 < width)
            pair(samples.values[i], samples.values[i + 1]);
        if (i + width < samples.values.size())
            pair(samples.values[i], samples.values[i + width]);
    }
}

} // namespace

double reliefOf(const HeightSamples& samples)
{
    float low = std::numeric_limits<float>::max();
    float high = std::numeric_limits<float>::lowest();
    for (const float value : samples.values)
        if (!std::isnan(value)) {
            low = std::min(low, value);
            high = std::max(high, value);
        }
    return low <= high ? static_cast<double>(high) - static_cast<double>(low) : 0.0;
}

bool isNoHeight(float value)
{
    // The negation also catches NaN.
    return !(std::fabs(value) < reach) ||
           std::find(surveyGaps.begin(), surveyGaps.end(), value) != surveyGaps.end();
}

void dropNoData(HeightSamples& samples, const std::string& place, Diagnostics& diagnostics)
{
    std::size_t holes = 0;
    for (float& value : samples.values)
        if (isNoHeight(value)) {
            value = std::numeric_limits<float>::quiet_NaN();
            ++holes;
        }
    if (holes > 0)
        diagnostics.warn("{}: {} of {} samples have no height and become holes", place, holes,
                         samples.values.size());
}

void hintAtNoData(const HeightSamples& samples, const std::string& place, Diagnostics& diagnostics)
{
    if (samples.isMetric || samples.values.empty())
        return;
    const double range = reliefOf(samples);
    for (const float gap : wholeGaps) {
        const auto count = std::count(samples.values.begin(), samples.values.end(), gap);
        if (double(count) < minShare * double(samples.values.size()))
            continue;
        Steps rim;
        Steps elsewhere;
        forEachPair(samples, [&](float a, float b) {
            if (a == gap && b == gap)
                return;
            Steps& steps = a == gap || b == gap ? rim : elsewhere;
            steps.sum += std::fabs(double(a) - double(b));
            ++steps.count;
        });
        if (rim.count == 0 || elsewhere.count == 0 || rim.mean() < cliffShare * range ||
            rim.mean() < cliffFactor * elsewhere.mean())
            continue;
        diagnostics.warn("{}: {} of {} samples are {} and end in cliffs; if that stands for no "
                         "height, --no-data {} makes holes of them",
                         place, count, samples.values.size(), gap, gap);
        return;
    }
}

} // namespace sward::terrain
