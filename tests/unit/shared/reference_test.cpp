// The moving tip against the same model in double precision: fine steps, no stored state, curve
// length by fine quadrature, independent code for wind and pose.

#include "unit/shared/random_vectors.h"
#include "unit/shared/winds.h"

#include <glm/vec3.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace sward::shared {
namespace {

constexpr Gravity referenceGravity{vec3(0, -1, 0), 6.5f, vec3(0.0f), 0.0f, forwardShare};
constexpr float referenceRecovery = 6.0f;

double wave(const WindSource& source, dvec3 place, double time)
{
    const dvec3 direction(source.direction);
    const dvec3 side = normalize(cross(direction, dvec3(0, 1, 0)));
    const double k = 2.0 * std::acos(-1.0) / double(source.size);
    const double a = k * (dot(place, direction) - double(source.speed) * time);
    const double b = k * dot(place, side);
    const double sum =
        std::cos(0.9 * a + 0.4 * b) + std::sin(0.55 * a - 0.25 * b) + std::sin(0.3 * a + 0.6 * b);
    const double height = 1.0 - std::max(sum / 3.0, 0.0);
    return height * height;
}

double lattice(dvec3 p)
{
    const dvec3 cell = floor(p);
    const dvec3 f = p - cell;
    const dvec3 s = f * f * (dvec3(3.0) - 2.0 * f);
    double sum = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        const int x = corner & 1;
        const int y = (corner >> 1) & 1;
        const int z = corner >> 2;
        sum += (x == 1 ? s.x : 1.0 - s.x) * (y == 1 ? s.y : 1.0 - s.y) *
               (z == 1 ? s.z : 1.0 - s.z) *
               double(latticeValue(int(cell.x) + x, int(cell.y) + y, int(cell.z) + z));
    }
    return sum;
}

double noise(const WindSource& source, dvec3 place, double time)
{
    const dvec3 direction(source.direction);
    const dvec3 carried = place - direction * (double(source.speed) * time);
    const dvec3 across = carried - direction * dot(carried, direction);
    const dvec3 p = (carried - 0.5 * across) / double(source.size);
    const double gust = 0.65 * lattice(p) + 0.35 * lattice(2.7 * p + dvec3(17.3));
    return 2.0 * gust * gust;
}

/// Length of the curve over v1 = up·height and the unit vector `direction`.
double curveLength(dvec3 v1, dvec3 direction)
{
    constexpr int panels = 64;
    double sum = 0.0;
    for (int i = 0; i <= panels; ++i) {
        const double t = double(i) / panels;
        const double weight = i == 0 || i == panels ? 1.0 : i % 2 == 1 ? 4.0 : 2.0;
        sum += weight * length(2.0 * ((1.0 - t) * v1 + t * (direction - v1)));
    }
    return sum / (3.0 * panels);
}

/// The tip after validation, in heights.
dvec3 valid(dvec3 up, dvec3 tip)
{
    const dvec3 direction = normalize(tip - up * std::min(dot(up, tip), 0.0));
    const double side = length(direction - up * dot(direction, up));
    return direction / curveLength(up * std::max(1.0 - side, 0.05), direction);
}

/// The tip of a blade on level ground after a step of `dt` to `time`.
dvec3 moved(const Blade& blade, dvec3 tip, const WindSource (&sources)[2], double time, double dt)
{
    const dvec3 up(blade.up);
    const dvec3 root(blade.root);
    const dvec3 front(frontOf(blade.up, widthAxis(blade.up, blade.facing)));
    const double b = 1.0 - double(blade.stiffness);
    const double k = double(referenceRecovery) * (1.0 - 0.25 * b);
    const double pull = double(referenceGravity.strength);
    dvec3 force = pull * (dvec3(referenceGravity.direction) + 0.25 * front);
    for (const WindSource& source : sources) {
        const double amount =
            source.kind == windWave ? wave(source, root, time) : noise(source, root, time);
        const dvec3 direction(source.direction);
        const double along = std::abs(dot(direction, tip)) / length(tip);
        force += (double(source.strength) * amount * (1.0 - along) * std::max(dot(tip, up), 0.0)) *
                 direction;
    }
    const dvec3 rest = up + b / k * force;
    return valid(up, rest + (tip - rest) * std::exp(-k * dt));
}

/// Root mean square of the tip's error in heights over `seconds` of frames at `rate` [1/s].
double tipError(int rate, int seconds)
{
    const WindSource sources[2] = {tests::windSourceOf(windNoise, 3.0f),
                                   tests::windSourceOf(windWave, 2.0f)};
    const tests::EnvironmentTables tables({sources[0], sources[1]});
    const int fine = std::max(480 / rate, 1);
    tests::Dice dice(11);
    double squares = 0.0;
    int compared = 0;
    for (int i = 0; i < 60; ++i) {
        Blade blade = {};
        blade.root = vec3(dice.number(-20, 20), 0.0f, dice.number(-20, 20));
        blade.up = vec3(0, 1, 0);
        blade.facing = dice.number(0.0f, twoPi);
        blade.stiffness = dice.number(0.1f, 0.9f);
        blade.height = 0.5f;
        const vec3 front = frontOf(blade.up, widthAxis(blade.up, blade.facing));
        BladeState state = BladeState{0, 0.0f};
        dvec3 tip = valid(dvec3(blade.up), dvec3(blade.up));
        for (int frame = 1; frame <= rate * seconds; ++frame) {
            state =
                advanceBlade(blade, tables.environment(referenceGravity, referenceRecovery),
                             noColliders(), state, float(double(frame) / rate), float(1.0 / rate));
            for (int step = 1; step <= fine; ++step)
                tip = moved(blade, tip, sources, (frame - 1.0 + double(step) / fine) / rate,
                            1.0 / (rate * fine));
            const dvec3 error = dvec3(poseOfState(axesTowards(blade.up, front), state).v2) - tip;
            squares += dot(error, error);
            ++compared;
        }
    }
    return std::sqrt(squares / compared);
}

TEST(PhysicsReference, TwentySecondsOfWindMoveTheTipAsDoublePrecisionDoes)
{
    const double error = tipError(60, 20);
    RecordProperty("rms_percent_of_height", std::to_string(100.0 * error));
    EXPECT_LT(error, 0.005);
}

TEST(PhysicsReference, TenFramesASecondDoNoWorse)
{
    const double error = tipError(10, 10);
    RecordProperty("rms_percent_of_height", std::to_string(100.0 * error));
    EXPECT_LT(error, 0.005);
}

} // namespace
} // namespace sward::shared
