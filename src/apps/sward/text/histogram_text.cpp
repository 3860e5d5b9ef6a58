#include "apps/sward/text/histogram_text.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <vector>

namespace sward::apps {
namespace {

using nlohmann::ordered_json;

// Length of the longest bar.
constexpr std::size_t barColumns = 40;

struct Row {
    const char* key;   // in JSON
    const char* title; // heading
    const char* counted;
    const field::Histogram* histogram;
};

std::vector<Row> rowsOf(const field::Distributions& all)
{
    return {
        {"height_m", "height [m]", "blades", &all.height},
        {"width_m", "width [m]", "blades", &all.width},
        {"stiffness", "stiffness", "blades", &all.stiffness},
        {"exposure", "exposure", "blades", &all.exposure},
        {"slope_deg", "slope of the up-vectors [degrees]", "blades", &all.slope},
        {"blades_per_patch", "blades of a patch", "patches", &all.bladesPerPatch},
        {"nearest_neighbour_m", "distance of the nearest root [m]", "sampled roots",
         &all.nearestNeighbour},
        {"density_per_m2", "density [1/m²]", "occupied cells", &all.density},
    };
}

// Lower bound of bar `index`.
double edge(const field::Histogram& histogram, std::size_t index)
{
    return histogram.low() +
           (histogram.high() - histogram.low()) * double(index) / double(histogram.bars().size());
}

std::string barsText(const field::Histogram& histogram)
{
    const auto& bars = histogram.bars();
    const std::uint64_t tallest = *std::max_element(bars.begin(), bars.end());
    if (tallest == 0)
        return {};
    // Omit empty bars before the first and after the last nonempty one.
    const auto isSome = [](std::uint64_t count) { return count > 0; };
    const auto first =
        static_cast<std::size_t>(std::find_if(bars.begin(), bars.end(), isSome) - bars.begin());
    const auto beyond = static_cast<std::size_t>(
        std::find_if(bars.rbegin(), bars.rend(), isSome).base() - bars.begin());
    std::string text;
    for (std::size_t i = first; i < beyond; ++i) {
        const auto length =
            static_cast<std::size_t>(double(bars[i]) / double(tallest) * double(barColumns) + 0.5);
        const std::string line =
            fmt::format("    {:>10.4g} to {:<10.4g} {:>11}  {}", edge(histogram, i),
                        edge(histogram, i + 1), bars[i], std::string(length, '#'));
        text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
    }
    return text;
}

} // namespace

std::string histogramText(const field::Distributions& distributions)
{
    std::string text;
    for (const Row& row : rowsOf(distributions)) {
        const field::Histogram& histogram = *row.histogram;
        text += fmt::format("  {}: {} {}", row.title, histogram.count(), row.counted);
        if (row.histogram == &distributions.density)
            text += fmt::format(" of {:g} m", distributions.cell);
        if (histogram.count() > 0)
            text += fmt::format(", {:.4g} to {:.4g}, mean {:.4g}", histogram.least(),
                                histogram.largest(), histogram.mean());
        text += "\n" + barsText(histogram);
    }
    return text;
}

ordered_json histogramJson(const field::Distributions& distributions)
{
    ordered_json all;
    for (const Row& row : rowsOf(distributions)) {
        const field::Histogram& histogram = *row.histogram;
        ordered_json entry = {
            {"count", histogram.count()},
            {"least", histogram.least()},
            {"mean", histogram.mean()},
            {"largest", histogram.largest()},
            {"bars",
             {{"low", histogram.low()}, {"high", histogram.high()}, {"counts", histogram.bars()}}}};
        if (row.histogram == &distributions.density)
            entry["cell_m"] = distributions.cell;
        all[row.key] = std::move(entry);
    }
    return all;
}

} // namespace sward::apps
