#include "field/measure/distributions.h"

#include "core/random.h"
#include "field/measure/nearest_root.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <compare>
#include <limits>
#include <unordered_map>
#include <utility>

namespace sward::field {
namespace {

// Enough to show a shape, few enough for a terminal.
constexpr std::size_t barCount = 16;

// One bar per ten degrees.
constexpr std::size_t slopeBars = 18;

// Edge of a cell in median neighbour distances. For random roots the median is 0.47/√density, for
// the densest blue noise about 0.9/√density: a full cell has 57 to 830 blades.
constexpr double cellDistances = 16.0;

// Patches that all searches together may visit; a search usually visits about 40.
constexpr std::uint64_t maxVisits = 4'000'000;

// A cube of roots whose up-vectors are nearest to one direction.
struct Cube {
    int direction = 0; // 2·axis, plus 1 if the up-vectors point against the axis
    std::int64_t x = 0;
    std::int64_t y = 0;
    std::int64_t along = 0; // the axis

    auto operator<=>(const Cube&) const = default;
};

struct CubeHash {
    std::size_t operator()(const Cube& cube) const
    {
        const auto bits = [](std::int64_t number) { return static_cast<std::uint64_t>(number); };
        return hashBits(hashBits(bits(cube.x), bits(cube.y)),
                        hashBits(bits(cube.along), bits(cube.direction)));
    }
};

// Minimum of `low` and maximum of `low + steps · step` over all patches that own blades.
template <typename Low, typename Step>
std::pair<double, double> rangeOf(const FieldView& field, Low low, Step step, float steps)
{
    std::pair<double, double> range{std::numeric_limits<double>::max(), 0.0};
    for (const shared::Patch& patch : field.patches)
        if (patch.bladeCount > 0) {
            range.first = std::min(range.first, double(patch.*low));
            range.second = std::max(range.second, double(patch.*low + steps * patch.*step));
        }
    return range.first > range.second ? std::pair{0.0, 0.0} : range;
}

// Angle [degrees] between up-vector and the direction against gravity.
double slopeOf(const FieldView& field, const shared::Blade& blade)
{
    const Defaults& defaults = *field.defaults;
    const glm::dvec3 towards = defaults.attractor - field.origin - glm::dvec3(blade.root);
    const double distance = glm::length(towards);
    const glm::dvec3 pull = distance > 1e-6 ? towards / distance : glm::dvec3(0.0);
    const glm::dvec3 against =
        -glm::mix(glm::dvec3(defaults.gravityDirection), pull, double(defaults.attractorBlend));
    const glm::dvec3 up(blade.up);
    return std::atan2(glm::length(glm::cross(up, against)), glm::dot(up, against)) *
           (180.0 / 3.14159265358979323846);
}

// Distances from sampled roots to their nearest neighbours, in ascending order.
std::vector<double> sampledDistances(const FieldView& field)
{
    const std::size_t blades = field.blades.size();
    const std::size_t samples = std::min(blades, neighbourSamples);
    std::vector<double> distances;
    RootSearch search(field);
    for (std::size_t k = 0; k < samples && search.visited() < maxVisits; ++k) {
        // One sample from each of equal stretches of the file.
        const double within = samples == blades ? 0.5 : uniform(0, k, 0);
        const double at = (double(k) + within) * double(blades) / double(samples);
        const std::size_t index = std::min(static_cast<std::size_t>(at), blades - 1);
        if (field.isRibbon(index))
            continue;
        if (const std::optional<double> distance = search.nearest(index))
            distances.push_back(*distance);
    }
    std::sort(distances.begin(), distances.end());
    return distances;
}

double cellEdge(const std::vector<double>& distances)
{
    const double median = distances.empty() ? 0.0 : distances[distances.size() / 2];
    return median > 0.0 ? std::exp2(std::ceil(std::log2(cellDistances * median))) : 1.0;
}

// Sums per cell the share of a square that a blade's piece of ground covers, seen along the cell's
// axis.
class Cells {
public:
    explicit Cells(double edge)
        : edge_(edge)
    {
    }

    void add(const shared::Blade& blade)
    {
        const glm::vec3 size = glm::abs(blade.up);
        const glm::length_t axis = size.y >= size.x && size.y >= size.z ? 1
                                   : size.x >= size.z                   ? 0
                                                                        : 2;
        const auto place = [&](glm::length_t side) { return cellOf(double(blade.root[side % 3])); };
        const int direction = 2 * static_cast<int>(axis) + (blade.up[axis] < 0.0f ? 1 : 0);
        sums_[{direction, place(axis + 1), place(axis + 2), place(axis)}] += double(size[axis]);
    }

    Histogram densities() const
    {
        // Join touching cubes of a column: sloping ground passes through several.
        std::vector<std::pair<Cube, double>> cubes(sums_.begin(), sums_.end());
        std::sort(cubes.begin(), cubes.end());
        std::vector<double> densities;
        for (std::size_t i = 0; i < cubes.size(); ++i) {
            Cube below = cubes[i].first;
            --below.along;
            if (i == 0 || cubes[i - 1].first != below)
                densities.push_back(0.0);
            densities.back() += cubes[i].second / (edge_ * edge_);
        }

        Histogram histogram(
            0.0, densities.empty() ? 0.0 : *std::max_element(densities.begin(), densities.end()),
            barCount);
        for (const double density : densities)
            histogram.add(density);
        return histogram;
    }

private:
    std::int64_t cellOf(double x) const
    {
        // Coordinates beyond all cells, and NaN, go into the outermost cell.
        constexpr double outermost = 1e18;
        const double cell = std::floor(x / edge_);
        return static_cast<std::int64_t>(cell > -outermost ? std::min(cell, outermost)
                                                           : -outermost);
    }

    double edge_;
    std::unordered_map<Cube, double, CubeHash> sums_;
};

} // namespace

Histogram::Histogram(double low, double high, std::size_t bars)
    : low_(low)
    , high_(high)
    , bars_(bars)
{
}

void Histogram::add(double value)
{
    const double last = double(bars_.size() - 1);
    const double place = (value - low_) / (high_ - low_) * double(bars_.size());
    // If both edges are equal, `place` is NaN.
    ++bars_[place > 0.0 ? static_cast<std::size_t>(std::min(place, last)) : 0];
    least_ = count_ == 0 ? value : std::min(least_, value);
    largest_ = count_ == 0 ? value : std::max(largest_, value);
    sum_ += value;
    ++count_;
}

Distributions distributionsOf(const FieldView& field)
{
    const auto [heightLow, heightHigh] =
        rangeOf(field, &shared::Patch::heightLow, &shared::Patch::heightStep, 255.0f);
    const auto [widthLow, widthHigh] =
        rangeOf(field, &shared::Patch::widthLow, &shared::Patch::widthStep, 63.0f);
    const std::vector<double> distances = sampledDistances(field);
    const double farthest = distances.empty() ? 0.0 : distances.back();
    const double cell = cellEdge(distances);
    Distributions result{Histogram(heightLow, heightHigh, barCount),
                         Histogram(widthLow, widthHigh, barCount),
                         Histogram(0.0, 1.0, barCount),
                         Histogram(0.0, 1.0, barCount),
                         Histogram(0.0, 180.0, slopeBars),
                         Histogram(0.0, double(shared::maxPatchBlades), barCount),
                         Histogram(0.0, farthest, barCount),
                         Histogram(0.0, 0.0, barCount),
                         cell};
    for (const double distance : distances)
        result.nearestNeighbour.add(distance);

    Cells cells(cell);
    for (const shared::Patch& patch : field.patches) {
        std::uint32_t rooted = 0;
        for (std::size_t i = patch.firstBlade; i < patch.firstBlade + patch.bladeCount; ++i) {
            if (field.isRibbon(i))
                continue;
            ++rooted;
            const shared::Blade blade = shared::unpackBlade(field.blades[i], patch);
            result.height.add(double(blade.height));
            result.width.add(double(blade.width));
            result.stiffness.add(double(blade.stiffness));
            result.exposure.add(double(blade.exposure));
            result.slope.add(slopeOf(field, blade));
            cells.add(blade);
        }
        if (patch.bladeCount > 0)
            result.bladesPerPatch.add(double(rooted));
    }
    result.density = cells.densities();
    return result;
}

BladeSize meanBladeSize(const FieldView& field)
{
    glm::dvec2 sum(0.0);
    double count = 0.0;
    for (const shared::Patch& cell : field.patches) {
        const double blades = cell.bladeCount;
        sum += blades * glm::dvec2(cell.heightLow + 127.5f * cell.heightStep,
                                   cell.widthLow + 31.5f * cell.widthStep);
        count += blades;
    }
    if (count == 0.0)
        return {};
    return {static_cast<float>(sum.x / count), static_cast<float>(sum.y / count)};
}

} // namespace sward::field
