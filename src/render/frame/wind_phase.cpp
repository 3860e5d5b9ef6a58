#include "render/frame/wind_phase.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace sward::render {
namespace {

constexpr double turn = 2.0 * std::numbers::pi;

/// Lattice points and fronts are numbered modulo 2³².
constexpr double numbers = 4294967296.0;

/// Common period of the three sines of a wave, whose lengths are multiples of a twentieth [waves].
constexpr double wavePeriod = 20.0;

/// Common period of the sines of radial and swirling winds, of 0.4 and 0.1 of it [rad].
constexpr double ringPeriod = 10.0 * turn;

/// A product without the rounding of double precision: the sum of both.
struct Product {
    double rounded = 0.0;
    double lost = 0.0;
};

Product product(double a, double b)
{
    const double rounded = a * b;
    // Beyond 2⁵² a double holds whole numbers alone. No wind that can be seen is so fast.
    if (!(std::abs(rounded) < 4503599627370496.0))
        return {};
    return {rounded, std::fma(a, b, -rounded)};
}

/// `rate` · `time` less the nearest whole number of periods.
double lessWhole(double rate, double time, double period)
{
    const Product x = product(rate, time);
    return std::remainder(x.rounded, period) + x.lost;
}

std::uint32_t numberOf(double whole)
{
    return static_cast<std::uint32_t>(static_cast<std::int64_t>(std::fmod(whole, numbers)));
}

/// The phases of the noise: both lattices move against the wind.
void moveNoise(shared::WindPhase& phase, const WindPace& pace, double time)
{
    std::uint32_t cell[3];
    std::uint32_t fineCell[3];
    for (int axis = 0; axis < 3; ++axis) {
        const Product cells = product(-pace.direction[axis] * pace.perSecond, time);
        const double whole = std::nearbyint(cells.rounded);
        phase.shift[axis] = static_cast<float>((cells.rounded - whole) + cells.lost);
        cell[axis] = numberOf(whole);

        // What the shader adds to its own finer cells: those of the whole coarser ones.
        const double fine = lessWhole(double(shared::fineNoiseScale), whole, numbers) +
                            double(shared::fineNoiseStart);
        const double wholeFine = std::nearbyint(fine);
        phase.fineShift[axis] = static_cast<float>(fine - wholeFine);
        fineCell[axis] = numberOf(wholeFine);
    }
    const auto point = [](const std::uint32_t(&place)[3]) {
        return place[0] * shared::latticeX + place[1] * shared::latticeY +
               place[2] * shared::latticeZ;
    };
    phase.cell = point(cell);
    phase.fineCell = point(fineCell);
}

} // namespace

WindPace paceOf(const WindPattern& source)
{
    const glm::dvec3 direction(source.direction);
    const double length = glm::length(direction);
    return {.direction = length > 0.0 ? direction / length : glm::dvec3(1.0, 0.0, 0.0),
            .perSecond = double(source.speed) / double(std::max(source.size, smallestWindSize))};
}

shared::WindPhase phaseAt(const WindSource& wind, double time)
{
    const WindPace pace = wind.pace.value_or(paceOf(wind.source));
    shared::WindPhase phase = shared::windPhaseAtZero();
    const auto ringAngle = [&](float extent) {
        return static_cast<float>(lessWhole(double(extent) * pace.perSecond, time, ringPeriod));
    };
    switch (wind.source.kind) {
    case shared::windNoise:
        moveNoise(phase, pace, time);
        break;
    case shared::windTurning:
        phase.angle = static_cast<float>(lessWhole(double(wind.source.rate), time, turn));
        phase.turned = static_cast<float>(lessWhole(double(wind.source.turn), time, turn));
        break;
    case shared::windWave:
        phase.angle = static_cast<float>(turn * lessWhole(pace.perSecond, time, wavePeriod));
        break;
    case shared::windRadial:
        phase.angle = ringAngle(shared::radialExtent);
        break;
    case shared::windSwirl:
        phase.angle = ringAngle(shared::swirlExtent);
        break;
    case shared::windGusts: {
        const Product fronts = product(pace.perSecond, time);
        const double whole = std::nearbyint(fronts.rounded);
        phase.shift.x = static_cast<float>((fronts.rounded - whole) + fronts.lost);
        phase.cell = shared::gustRows * numberOf(whole) * shared::latticeZ;
        break;
    }
    default:
        break;
    }
    return phase;
}

void moveTo(shared::Wind& wind, std::span<const WindSource> sources, double time)
{
    const std::vector<WindSource> blown = withStrength(sources);
    for (std::size_t i = 0; i < blown.size(); ++i)
        wind.phases[i] = phaseAt(blown[i], time);
    const double perSecond = double(wind.eddySpeed) / double(wind.eddySize);
    for (int axis = 0; axis < 3; ++axis)
        wind.eddyPhase[axis] =
            static_cast<float>(lessWhole(double(shared::eddyDrift[axis]) * perSecond, time, 1.0));
}

} // namespace sward::render
