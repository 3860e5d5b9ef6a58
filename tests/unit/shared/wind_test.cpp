#include "shaders/shared/wind.h"
#include "unit/shared/random_vectors.h"
#include "unit/shared/winds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

namespace sward::shared {
namespace {

constexpr vec3 levelUp(0, 1, 0);
constexpr float windPi = 3.14159265f;

/// Kinds that have a direction.
constexpr std::uint32_t alongKinds[] = {windNoise, windTurning, windWave, windGusts};

/// The wind of one source of a kind over level ground.
vec3 one(const WindSource& source, vec3 place, float time, vec3 up = levelUp)
{
    const tests::EnvironmentTables tables({source});
    return windAt(tables.wind(), place, up, time);
}

/// Speeds along a line in steps of `step`.
std::vector<double> speedsAlong(const WindSource& source, vec3 line, float step, std::size_t count)
{
    std::vector<double> speeds;
    for (std::size_t i = 0; i < count; ++i)
        speeds.push_back(double(length(one(source, float(i) * step * line, 2.0f))));
    return speeds;
}

/// Correlation of a series with itself `lag` later.
double correlation(const std::vector<double>& series, std::size_t lag)
{
    double mean = 0.0;
    for (const double x : series)
        mean += x / double(series.size());
    double product = 0.0;
    double square = 0.0;
    for (std::size_t i = 0; i + lag < series.size(); ++i) {
        product += (series[i] - mean) * (series[i + lag] - mean);
        square += (series[i] - mean) * (series[i] - mean);
    }
    return product / square;
}

/// Power of a series at each of its frequencies but 0.
std::vector<double> spectrum(const std::vector<double>& series)
{
    const std::size_t n = series.size();
    std::vector<double> power(n / 2, 0.0);
    for (std::size_t k = 1; k < n / 2; ++k) {
        double re = 0.0;
        double im = 0.0;
        for (std::size_t i = 0; i < n; ++i) {
            const double angle = 2.0 * double(windPi) * double(k * i % n) / double(n);
            re += series[i] * std::cos(angle);
            im += series[i] * std::sin(angle);
        }
        power[k] = re * re + im * im;
    }
    return power;
}

TEST(Wind, BlowsAlongTheGroundAndIsBounded)
{
    tests::Dice dice(1);
    for (std::uint32_t kind = 0; kind < windKinds; ++kind) {
        const WindSource source = tests::windSourceOf(kind, 2.0f);
        for (int i = 0; i < 5000; ++i) {
            const vec3 up = dice.direction();
            const vec3 w = one(source, 30.0f * dice.direction(), dice.number(0, 100), up);
            ASSERT_LT(std::abs(dot(w, up)), 1e-5f) << "kind " << kind;
            // Noise reaches twice its strength; eddies add up to twice as much again.
            ASSERT_LE(length(w), 6.0f * source.strength) << "kind " << kind;
        }
    }
}

TEST(Wind, IsContinuousInSpaceAndTime)
{
    tests::Dice dice(2);
    for (std::uint32_t kind = 0; kind < windKinds; ++kind) {
        const WindSource source = tests::windSourceOf(kind, 2.0f);
        for (int i = 0; i < 5000; ++i) {
            const vec3 place = 30.0f * dice.direction();
            const float time = dice.number(0, 100);
            const vec3 here = one(source, place, time);
            ASSERT_LT(length(one(source, place + 0.01f * dice.direction(), time) - here), 0.2f)
                << "kind " << kind;
            ASSERT_LT(length(one(source, place, time + 0.004f) - here), 0.2f) << "kind " << kind;
        }
    }
}

TEST(Wind, OfEveryKindVariesAndTogetherTheyAddUp)
{
    tests::Dice dice(3);
    std::vector<WindSource> all;
    for (std::uint32_t kind = 0; kind < windKinds; ++kind)
        all.push_back(tests::windSourceOf(kind, 1.0f + float(kind)));
    const tests::EnvironmentTables mixture({all[5], all[2], all[0], all[4], all[1], all[3]});
    std::vector<float> low(windKinds, 1e9f);
    std::vector<float> high(windKinds, 0.0f);
    for (int i = 0; i < 3000; ++i) {
        const vec3 place(dice.number(-30, 30), 0.0f, dice.number(-30, 30));
        const float time = dice.number(0, 60);
        vec3 sum(0.0f);
        for (std::uint32_t kind = 0; kind < windKinds; ++kind) {
            const vec3 w = one(all[kind], place, time);
            low[kind] = std::min(low[kind], length(w) / all[kind].strength);
            high[kind] = std::max(high[kind], length(w) / all[kind].strength);
            sum += w;
        }
        ASSERT_LT(length(windAt(mixture.wind(), place, levelUp, time) - sum), 1e-4f);
    }
    for (std::uint32_t kind = 0; kind < windKinds; ++kind) {
        EXPECT_LT(low[kind], 0.25f) << "kind " << kind;
        EXPECT_GT(high[kind], 0.6f) << "kind " << kind;
    }
}

TEST(Wind, OfSourcesThatBlowAlikeIsFeltAsOfEachOfThem)
{
    tests::Dice dice(9);
    const auto felt = [](const std::vector<WindSource>& sources, const BladeAxes& axes, vec3 place,
                         vec3 direction, float time) {
        const tests::EnvironmentTables tables(sources);
        return windAlongAxes(tables.wind(), place, axes, direction, time);
    };
    int alike = 0;
    for (int i = 0; i < 3000; ++i) {
        std::vector<WindSource> sources = {tests::windSourceOf(windNoise, dice.number(0.5f, 3)),
                                           tests::windSourceOf(windWave, dice.number(0.5f, 3)),
                                           tests::windSourceOf(windGusts, dice.number(0.5f, 3))};
        const float lift = dice.number(0, 1);
        const float alignment = dice.number(0, 1);
        for (WindSource& source : sources) {
            source.lift = lift;
            source.alignment = alignment;
        }
        // One of three differs in a property and must not be merged with the others.
        switch (i % 6) {
        case 1:
            sources[1].lift = 0.5f * lift;
            break;
        case 2:
            sources[2].alignment = 0.5f * alignment;
            break;
        case 3:
            sources[2].direction = dice.direction();
            break;
        case 4:
            sources.push_back(tests::windSourceOf(windTurning, 1.0f));
            break;
        default:
            break;
        }
        alike += (tests::EnvironmentTables(sources).wind().counts & windsAlike) != 0u ? 1 : 0;
        const vec3 up = dice.direction();
        const BladeAxes axes = axesTowards(up, tangentOf(up));
        const vec3 place = 20.0f * dice.direction();
        vec3 direction = dice.direction();
        direction.z = std::abs(direction.z);
        const float time = dice.number(0, 60);
        vec3 sum(0.0f);
        for (const WindSource& source : sources)
            sum += felt({source}, axes, place, direction, time);
        ASSERT_LT(length(felt(sources, axes, place, direction, time) - sum), 2e-5f)
            << "mixture " << i;
    }
    EXPECT_EQ(alike, 1000);
}

TEST(Wind, TravelsAgainstThePlaceAtItsSpeed)
{
    // The current local wind was upstream before.
    tests::Dice dice(4);
    for (const std::uint32_t kind : {windNoise, windWave, windGusts}) {
        const WindSource source = tests::windSourceOf(kind, 2.0f);
        for (int i = 0; i < 1000; ++i) {
            const vec3 place(dice.number(-10, 10), 0.0f, dice.number(-10, 10));
            const vec3 before = one(source, place - source.direction * source.speed, 4.0f);
            ASSERT_LT(length(one(source, place, 5.0f) - before), 4e-3f) << "kind " << kind;
        }
    }
}

TEST(Wind, NoiseIsFinerAlongThanAcrossAndHasNoFineGrain)
{
    const WindSource source = tests::windSourceOf(windNoise, 2.0f);
    const vec3 side = cross(source.direction, levelUp);
    // Eight samples to a size, over 256 sizes.
    const float step = source.size / 8.0f;
    const auto along = speedsAlong(source, source.direction, step, 2048);
    const auto across = speedsAlong(source, side, step, 2048);

    // Near points are correlated, far points are not.
    EXPECT_GT(correlation(along, 1), 0.85);
    EXPECT_LT(std::abs(correlation(along, 32)), 0.2);
    // The same pattern is twice as long across.
    EXPECT_GT(correlation(across, 4), correlation(along, 4) + 0.2);
    EXPECT_NEAR(correlation(across, 6), correlation(along, 3), 0.15);

    // Lattices of 1 and 2.7 cells a size hold all but a hundredth of the power below 3 per size.
    const auto power = spectrum(along);
    double all = 0.0;
    double fine = 0.0;
    for (std::size_t k = 1; k < power.size(); ++k) {
        all += power[k];
        fine += k > 3 * 256 ? power[k] : 0.0;
    }
    EXPECT_LT(fine, 0.01 * all);
}

TEST(Wind, WavesHaveTheirLength)
{
    // Alone along the wind its three sines have 0.9, 0.55 and 0.3 waves a size; the strongest line
    // of the spectrum is one of them, or their sums and differences that the square makes.
    const WindSource source = tests::windSourceOf(windWave, 2.0f);
    const auto power = spectrum(speedsAlong(source, source.direction, source.size / 8.0f, 2048));
    double below = 0.0;
    double all = 0.0;
    for (std::size_t k = 1; k < power.size(); ++k) {
        all += power[k];
        below += k <= 2 * 256 ? power[k] : 0.0;
    }
    EXPECT_GT(below, 0.97 * all);
}

TEST(Wind, OnABallHasNoPlaceThatIsAlwaysCalm)
{
    // Where the wind meets the sphere head-on it is deflected: over a minute the mean speed of
    // every point is between half and twice the overall mean.
    for (const std::uint32_t kind : {windNoise, windWave, windGusts}) {
        const WindSource source = tests::windSourceOf(kind, 2.0f);
        const auto meanSpeed = [&](vec3 up) {
            float sum = 0.0f;
            for (int i = 0; i < 300; ++i)
                sum += length(one(source, 8.0f * up, 0.4f * float(i), up)) / 300.0f;
            return sum;
        };
        tests::Dice dice(5);
        float mean = 0.0f;
        for (int i = 0; i < 200; ++i)
            mean += meanSpeed(dice.direction()) / 200.0f;
        for (const float sign : {1.0f, -1.0f}) {
            const float pole = meanSpeed(sign * source.direction);
            EXPECT_GT(pole, 0.5f * mean) << "kind " << kind;
            EXPECT_LT(pole, 2.0f * mean) << "kind " << kind;
        }
    }
}

TEST(Wind, OnABallIsAsSmoothAroundItsPolesAsElsewhere)
{
    tests::Dice dice(6);
    for (const std::uint32_t kind : alongKinds) {
        const WindSource source = tests::windSourceOf(kind, 2.0f);
        const auto steepest = [&](const std::function<vec3()>& place) {
            float largest = 0.0f;
            for (int i = 0; i < 4000; ++i) {
                const vec3 up = place();
                const vec3 beside = normalize(up + 1e-3f * dice.direction());
                const float time = dice.number(0, 30);
                const vec3 difference =
                    one(source, 8.0f * up, time, up) - one(source, 8.0f * beside, time, beside);
                largest = std::max(largest, length(difference) / (8.0f * length(up - beside)));
            }
            return largest;
        };
        const float everywhere = steepest([&] { return dice.direction(); });
        const float poles =
            steepest([&] { return normalize(source.direction + 0.05f * dice.direction()); });
        EXPECT_LT(poles, 1.3f * everywhere) << "kind " << kind;
    }
}

TEST(Wind, TurningIsTheSineOfTheKnownSystem)
{
    // vec3(2, 4, 2)·sin(0.1 t)
    WindSource source = tests::windSourceOf(windTurning, std::sqrt(24.0f));
    source.direction = normalize(vec3(2, 4, 2));
    source.size = 1e9f;
    source.rate = 0.1f;
    source.turn = 0.0f;
    source.lift = 1.0f;
    for (const float time : {0.0f, 3.0f, 20.0f, 50.0f})
        EXPECT_LT(length(one(source, vec3(3, 0, 4), time) - vec3(2, 4, 2) * std::sin(0.1f * time)),
                  1e-4f);
    // The direction rotates about the up-vector when set.
    source.direction = vec3(1, 0, 0);
    source.turn = 0.1f;
    const vec3 turned = one(source, vec3(0.0f), 5.0f * windPi);
    EXPECT_GT(dot(normalize(turned), vec3(0, 0, -1)), 0.999f);
}

TEST(Wind, RadialBlowsAwayAndEndsAtItsSize)
{
    const WindSource source = tests::windSourceOf(windRadial, 3.0f);
    tests::Dice dice(7);
    for (int i = 0; i < 2000; ++i) {
        const float angle = dice.number(0, 2.0f * windPi);
        const vec3 away(std::cos(angle), 0.0f, std::sin(angle));
        const vec3 w = one(source, dice.number(0.1f, 39.0f) * away, dice.number(0, 20));
        ASSERT_LT(length(cross(w, away)), 1e-4f);
        ASSERT_GE(dot(w, away), 0.0f);
        ASSERT_LT(length(one(source, 40.1f * away, 3.0f)), 1e-4f);
    }
    EXPECT_EQ(one(source, source.centre, 1.0f), vec3(0.0f));
}

TEST(Wind, SwirlGoesAroundItsCentre)
{
    const WindSource source = tests::windSourceOf(windSwirl, 3.0f);
    float turning = 0.0f;
    float along = 0.0f;
    for (int i = 0; i < 400; ++i) {
        const vec3 w = one(source, vec3(20, 0, 0), 0.1f * float(i));
        turning += std::abs(w.z);
        along += std::abs(w.x);
    }
    EXPECT_GT(turning, along);
    EXPECT_GT(along, 0.0f);
    EXPECT_EQ(one(source, source.centre, 1.0f), vec3(0.0f));
}

TEST(Wind, AGustRisesFasterThanItFalls)
{
    const WindSource source = tests::windSourceOf(windGusts, 3.0f);
    float rise = 0.0f;
    float fall = 0.0f;
    for (int place = 0; place < 40; ++place) {
        float before = length(one(source, vec3(float(place), 0, 0), 0.0f));
        for (int i = 1; i < 600; ++i) {
            const float now = length(one(source, vec3(float(place), 0, 0), 0.02f * float(i)));
            rise = std::max(rise, now - before);
            fall = std::max(fall, before - now);
            before = now;
        }
    }
    EXPECT_GT(rise, 3.0f * fall);
}

TEST(Wind, ABladeAlongItEscapesAndOneThatLiesFeelsNone)
{
    WindSource source = tests::windSourceOf(windTurning, 3.0f);
    source.turn = 0.0f;
    const auto force = [&](vec3 tip) {
        const tests::EnvironmentTables tables({source});
        return windForce(tables.wind(), vec3(0.0f), levelUp, tip, 1.0f);
    };
    const float standing = length(force(levelUp));
    const vec3 leaning = normalize(levelUp + source.direction);
    EXPECT_NEAR(length(force(leaning)), standing * leaning.y * (1.0f - std::sqrt(0.5f)), 1e-4f);
    EXPECT_EQ(force(vec3(0, 0, 1)), vec3(0.0f));
    source.alignment = 0.0f;
    EXPECT_NEAR(length(force(leaning)), standing * leaning.y, 1e-4f);
}

TEST(ValueNoise, MeetsItsLatticeAndStaysInRange)
{
    tests::Dice dice(8);
    for (int i = 0; i < 20'000; ++i) {
        const float n = valueNoise(50.0f * dice.direction());
        ASSERT_GE(n, 0.0f);
        ASSERT_LE(n, 1.0f);
    }
    for (int x = -3; x < 3; ++x)
        EXPECT_NEAR(valueNoise(vec3(float(x), 2.0f, -1.0f)), latticeValue(x, 2, -1), 1e-6f);
}

TEST(ValueNoise, LatticePointsHaveNothingToDoWithTheirNeighbours)
{
    // Of independent numbers the correlation of n pairs is 1/√n, one in a million beyond 5 of that.
    constexpr int n = 32;
    const auto value = [](int x, int y, int z) { return double(latticeValue(x, y, z)) - 0.5; };
    for (const int corner : {0, -1000, 100'000}) {
        double sum = 0.0;
        double squares = 0.0;
        double worst = 0.0;
        for (int dx = 0; dx <= 2; ++dx)
            for (int dy = -2; dy <= 2; ++dy)
                for (int dz = -2; dz <= 2; ++dz) {
                    double products = 0.0;
                    for (int x = 0; x < n; ++x)
                        for (int y = 0; y < n; ++y)
                            for (int z = 0; z < n; ++z)
                                products += value(corner + x, y, z) *
                                            value(corner + x + dx, y + dy, z + dz);
                    if (dx == 0 && dy == 0 && dz == 0)
                        squares = products;
                    else
                        worst = std::max(worst, std::abs(products));
                }
        for (int x = 0; x < n; ++x)
            for (int y = 0; y < n; ++y)
                for (int z = 0; z < n; ++z)
                    sum += value(corner + x, y, z);
        const double count = double(n) * n * n;
        EXPECT_LT(std::abs(sum / count), 5.0 * std::sqrt(1.0 / 12.0 / count));
        EXPECT_NEAR(squares / count, 1.0 / 12.0, 0.002);
        EXPECT_LT(worst * 12.0 / count, 5.0 / std::sqrt(count)) << "from " << corner;
    }
}

} // namespace
} // namespace sward::shared
