// The wind at any time against formulas in double precision, whose cells are numbered by 64 bits.

#include "core/error.h"
#include "render/frame/frame_time.h"
#include "render/frame/wind_phase.h"
#include "shaders/shared/update_rate.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

namespace sward::render {
namespace {

using glm::dvec3;

constexpr double turn = 2.0 * std::numbers::pi;

/// A minute, a day, 11 days, seconds since 1970, the largest, and before the origin.
constexpr double times[] = {0.0, 100.0, 86'400.0, 1e6, 1.8e9, longestTime, -3.0, -1.8e9};

std::uint32_t modulo(double whole)
{
    return static_cast<std::uint32_t>(static_cast<std::int64_t>(whole));
}

double noiseOf(dvec3 place)
{
    const dvec3 cell = glm::floor(place);
    const dvec3 f = place - cell;
    const dvec3 s = f * f * (3.0 - 2.0 * f);
    double sum = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        const dvec3 at(corner & 1, corner >> 1 & 1, corner >> 2);
        const std::uint32_t point = modulo(cell.x + at.x) * shared::latticeX +
                                    modulo(cell.y + at.y) * shared::latticeY +
                                    modulo(cell.z + at.z) * shared::latticeZ;
        const dvec3 weight = glm::mix(1.0 - s, s, at);
        sum += weight.x * weight.y * weight.z * double(shared::latticeHeight(point));
    }
    return sum / 4294967296.0;
}

/// The wind of a source over level ground, by the formulas of docs/algorithms/wind.md.
dvec3 windOf(const WindSource& wind, dvec3 place, double time)
{
    const WindPattern& source = wind.source;
    const dvec3 d = glm::normalize(dvec3(source.direction));
    const dvec3 side = glm::normalize(glm::cross(d, dvec3(0.0, 1.0, 0.0)));
    const double size = double(source.size);
    const double speed = double(source.speed);
    const double along = glm::dot(place, d);
    const dvec3 arm = place - wind.centre;
    const double distance = glm::length(arm);
    const dvec3 away = arm / (distance + 0.01 * size);
    double amount = 0.0;
    switch (source.kind) {
    case shared::windNoise: {
        const dvec3 q = 0.5 / size * (place + d * (along - 2.0 * speed * time));
        const double n = 0.65 * noiseOf(q) + 0.35 * noiseOf(double(shared::fineNoiseScale) * q +
                                                            double(shared::fineNoiseStart));
        amount = 2.0 * n * n;
        break;
    }
    case shared::windTurning: {
        const double angle = double(source.turn) * time;
        const dvec3 turned =
            d * std::cos(angle) + glm::cross(dvec3(0.0, 1.0, 0.0), d) * std::sin(angle);
        return double(source.strength) *
               std::sin(double(source.rate) * time - turn / size * along) * turned;
    }
    case shared::windWave: {
        const double a = turn / size * (along - speed * time);
        const double b = turn / size * glm::dot(place, side);
        const double sum = std::cos(0.9 * a + 0.4 * b) + std::sin(0.55 * a - 0.25 * b) +
                           std::sin(0.3 * a + 0.6 * b);
        amount = std::pow(1.0 - std::max(sum / 3.0, 0.0), 2.0);
        break;
    }
    case shared::windRadial: {
        const double unit = 75.0 / size;
        const double fade = std::max(1.0 - 0.25 * std::log2(0.2 * unit * distance + 1.0), 0.0);
        const double ring = std::sin(0.4 * unit * (distance - speed * time));
        return double(source.strength) * fade * (1.0 - std::max(ring, 0.0)) * away;
    }
    case shared::windSwirl: {
        const double unit = 30.0 / size;
        const double fade = std::max(1.0 - 0.25 * std::log2(0.5 * unit * distance + 1.0), 0.0);
        const double ring = std::pow(std::sin(0.1 * unit * (distance - speed * time)), 3.0);
        const dvec3 around = glm::cross(dvec3(0.0, 1.0, 0.0), away);
        return double(source.strength) * fade * ring * (away + 1.5 * (1.0 - fade * fade) * around);
    }
    default: {
        const dvec3 across = (place - d * along) / size;
        const double bend = 0.8 * (noiseOf(0.7 * across + 5.1) - 0.5);
        const double fronts = (speed * time - along) / size + bend;
        const double front = std::floor(fronts);
        const double s = fronts - front;
        const double rise = glm::clamp(s / 0.12, 0.0, 1.0);
        const double fall = glm::clamp((1.0 - s) / 0.88, 0.0, 1.0);
        const double own = noiseOf(across + dvec3(0.0, 0.0, 7.0 * front));
        amount =
            rise * rise * (3.0 - 2.0 * rise) * fall * fall * glm::clamp(2.0 * own - 0.2, 0.0, 1.0);
        break;
    }
    }
    return double(source.strength) * amount * d;
}

WindSource sourceOf(std::uint32_t kind)
{
    WindSource wind = windSource(kind);
    wind.centre = {4.0, 0.0, -3.0};
    if (kind == shared::windTurning) {
        wind.source.size = 9.0f;
        wind.source.turn = 0.3f;
    }
    return wind;
}

/// The wind as shaders compute it in the frame at `time`, `since` seconds after it.
dvec3 shaded(const WindSource& source, dvec3 place, double time, double since)
{
    shared::Wind wind = together(blowing({source}, dvec3(0.0)), 0.0f);
    moveTo(wind, std::span(&source, 1), time);
    return dvec3(
        shared::windAt(wind, glm::vec3(place), {0.0f, 1.0f, 0.0f}, static_cast<float>(since)));
}

dvec3 placeOf(int i)
{
    return {0.37 * i - 20.0, 0.0, 17.0 - 0.29 * (i * 7 % 101)};
}

TEST(WindTime, FollowsItsFormulaAtEveryTimeAsAtTheFirst)
{
    for (std::uint32_t kind = 0; kind < shared::windKinds; ++kind) {
        const WindSource source = sourceOf(kind);
        for (const double begin : times)
            for (int i = 0; i < 200; ++i) {
                const double time = begin - (begin > 0.0 ? 0.137 : -0.137) * i;
                const dvec3 place = placeOf(i);
                ASSERT_LT(
                    glm::length(shaded(source, place, time, 0.0) - windOf(source, place, time)),
                    1e-4 * double(source.source.strength))
                    << "kind " << kind << ", " << begin << " s, " << i;
            }
    }
}

TEST(WindTime, MovesBySixtiethsOfASecondAfterYearsAsAfterAMinute)
{
    constexpr double step = 1.0 / 60.0;
    for (std::uint32_t kind = 0; kind < shared::windKinds; ++kind) {
        const WindSource source = sourceOf(kind);
        const double strength = double(source.source.strength);
        double motion[2] = {0.0, 0.0};
        for (int early = 0; early < 2; ++early)
            for (int i = 0; i < 2000; ++i) {
                const double time = (early == 1 ? 100.0 : 1.8e9) + i * step;
                const dvec3 place = placeOf(i % 200);
                const dvec3 moved =
                    shaded(source, place, time + step, 0.0) - shaded(source, place, time, 0.0);
                const dvec3 expected =
                    windOf(source, place, time + step) - windOf(source, place, time);
                ASSERT_LT(glm::length(moved - expected), 1e-4 * strength)
                    << "kind " << kind << ", " << time << " s";
                motion[early] += glm::length(moved) / 2000.0;
            }
        EXPECT_GT(motion[1], 1e-3 * strength) << "kind " << kind;
        EXPECT_NEAR(motion[0], motion[1], 0.4 * motion[1]) << "kind " << kind;
    }
}

TEST(WindTime, WithinAStepIsThatOfTheFramesBetween)
{
    // Blades that were last moved some seconds ago ask for the wind since.
    for (std::uint32_t kind = 0; kind < shared::windKinds; ++kind) {
        const WindSource source = sourceOf(kind);
        for (const double time : times)
            for (int i = 0; i < 100; ++i) {
                const double before = 0.12 * i;
                const dvec3 place = placeOf(i);
                ASSERT_LT(glm::length(shaded(source, place, time, -before) -
                                      shaded(source, place, time - before, 0.0)),
                          2e-4 * double(source.source.strength))
                    << "kind " << kind << ", " << before << " s before " << time;
            }
    }
}

TEST(WindTime, EddiesMoveOnAfterYearsAsAfterAMinute)
{
    // On the ground that the wind meets head-on there is nothing else.
    const WindSource source = windSource(shared::windWave);
    const glm::vec3 up = glm::normalize(source.source.direction);
    double motion[2] = {0.0, 0.0};
    for (int early = 0; early < 2; ++early)
        for (int i = 0; i < 2000; ++i) {
            glm::vec3 flow[2];
            for (int later = 0; later < 2; ++later) {
                shared::Wind wind = together(blowing({source}, dvec3(0.0)), 40.0f);
                moveTo(wind, std::span(&source, 1),
                       (early == 1 ? 100.0 : 1.8e9) + (i + later) / 60.0);
                flow[later] = shared::windEddies(wind.eddySize, wind.eddySpeed, wind.eddyPhase,
                                                 8.0f * up, 0.0f);
            }
            const double moved = double(glm::length(flow[1] - flow[0]));
            ASSERT_LT(moved, 0.2);
            motion[early] += moved / 2000.0;
        }
    EXPECT_GT(motion[1], 1e-3);
    EXPECT_NEAR(motion[0], motion[1], 0.1 * motion[1]);
}

TEST(WindTime, HasAPhaseForAnyFiniteSource)
{
    for (std::uint32_t kind = 0; kind < shared::windKinds; ++kind)
        for (const float speed : {0.0f, -5.0f, 1e30f, std::numeric_limits<float>::max()})
            for (const double time : times) {
                WindSource wind = sourceOf(kind);
                wind.source.speed = speed;
                wind.source.size = kind % 2 == 0 ? 0.0f : 1e-3f;
                const shared::WindPhase phase = phaseAt(wind, time);
                ASSERT_LE(std::abs(phase.angle), 63.0f);
                ASSERT_LE(std::abs(phase.turned), 3.2f);
                for (int axis = 0; axis < 3; ++axis) {
                    ASSERT_LE(std::abs(phase.shift[axis]), 0.51f);
                    ASSERT_LE(std::abs(phase.fineShift[axis]), 17.5f);
                }
            }
}

TEST(FrameTime, IsRefusedBeyondTheMicrosecondsOfDoublePrecision)
{
    for (const double time : {0.0, -1.8e9, longestTime, -longestTime})
        EXPECT_NO_THROW(requireValidTime(time)) << time;
    constexpr double infinity = std::numeric_limits<double>::infinity();
    for (const double time : {std::nextafter(longestTime, infinity), -1e12, infinity, -infinity,
                              std::numeric_limits<double>::quiet_NaN()})
        EXPECT_THROW(requireValidTime(time), Error) << time;
    EXPECT_LE(longestTime - std::nextafter(longestTime, 0.0), 1e-6);
}

TEST(FrameTime, StepsAreTheSameInTicksAtAnyTime)
{
    for (const double time : times)
        for (const double step : {1e-3, 1.0 / 240.0, 1.0 / 60.0, 0.4, 12.0, longestTimeStep})
            EXPECT_NEAR(double(shared::secondsBetween(tickOf(time), tickOf(time + step))), step,
                        4e-6 + 1e-7 * step)
                << time << " s, " << step << " s";
}

TEST(FrameTime, MovesOnForwardsAndByNoMoreThanItCounts)
{
    EXPECT_TRUE(movesOn(5.0, 5.0));
    EXPECT_TRUE(movesOn(1.8e9, 1.8e9 + 0.016));
    EXPECT_TRUE(movesOn(0.0, longestTimeStep));
    EXPECT_FALSE(movesOn(0.0, longestTimeStep + 1.0));
    EXPECT_FALSE(movesOn(1.8e9, 1.8e9 - 0.016));
    EXPECT_FALSE(movesOn(0.0, 1.8e9));
}

} // namespace
} // namespace sward::render
