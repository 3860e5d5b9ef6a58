#include "core/error.h"
#include "core/random.h"
#include "interchange/tiles/earth_bend.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vector_relational.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace sward::interchange {
namespace {

constexpr double bendRadius = 6371000.0; // [m] of the map's sphere

// Mercator's map of a sphere: true to angles, its scale grows with the latitude.
std::vector<glm::dvec2> mercatorDegrees(std::vector<glm::dvec2> places)
{
    for (glm::dvec2& place : places)
        place = {glm::degrees(place.x / bendRadius),
                 glm::degrees(2.0 * std::atan(std::exp(place.y / bendRadius))) - 90.0};
    return places;
}

const MapToEarth mercator{.name = "Mercator", .degreesOf = mercatorDegrees, .height = 12.0};

// Forty kilometres at 48° north, of hills.
const glm::dvec3 bendOrigin(1.0e6, 320.0, -6.0e6);
const DAabb bendRoots{glm::dvec3(-2.0e4, -100.0, -1.0e4), glm::dvec3(2.0e4, 900.0, 3.0e4)};

Geodetic geodeticOf(const glm::dvec3& place)
{
    const glm::dvec3 world = bendOrigin + place;
    const glm::dvec2 degrees = mercatorDegrees({{world.x, -world.z}}).front();
    return {.longitude = degrees.x, .latitude = degrees.y, .height = world.y + mercator.height};
}

glm::dvec3 randomIn(const DAabb& box, std::uint64_t index)
{
    return box.low + box.size() * glm::dvec3(uniform(7, index, 0), uniform(7, index, 1),
                                             uniform(7, index, 2));
}

TEST(EarthBend, PlacesAreThoseOfTheProjection)
{
    const EarthBend bend(mercator, bendOrigin, bendRoots);
    double worst = 0.0;
    for (std::uint64_t i = 0; i < 3000; ++i) {
        const glm::dvec3 place = randomIn(bendRoots, i);
        const glm::dvec3 there(bend.toEarth() * glm::dvec4(bend.moved(place), 1.0));
        worst = std::max(worst, glm::length(there - earthCentred(geodeticOf(place))));
    }
    EXPECT_LT(worst, 1e-4);
}

TEST(EarthBend, AFieldTouchesTheFlatOneInItsMiddle)
{
    const EarthBend bend(mercator, bendOrigin, bendRoots);
    const glm::dvec3 middle = bendRoots.centre();
    EXPECT_LT(glm::length(bend.moved(middle) - middle), 1e-6);
    EXPECT_GT(bend.turn(middle).w, 1.0 - 1e-12);
    // It is turned and shifted, and neither scaled nor mirrored.
    const glm::dmat3 turn(bend.toEarth());
    EXPECT_NEAR(glm::determinant(turn), 1.0, 1e-12);
    EXPECT_NEAR(glm::length(turn[0]), 1.0, 1e-12);
}

TEST(EarthBend, WhatIsUprightStaysUprightAndLooksAlongTheMap)
{
    const EarthBend bend(mercator, bendOrigin, bendRoots);
    for (std::uint64_t i = 0; i < 300; ++i) {
        const glm::dvec3 place = randomIn(bendRoots, i);
        const glm::dmat3 toEarth(bend.toEarth());
        const glm::dmat4 axes = eastNorthUp(geodeticOf(place));
        // North of Mercator's map is north.
        EXPECT_LT(glm::length(toEarth * (bend.turn(place) * glm::dvec3(0.0, 1.0, 0.0)) -
                              glm::dvec3(axes[2])),
                  1e-6);
        EXPECT_LT(glm::length(toEarth * (bend.turn(place) * glm::dvec3(0.0, 0.0, -1.0)) -
                              glm::dvec3(axes[1])),
                  1e-5);
    }
}

TEST(EarthBend, BoxesHoldAllThatIsBent)
{
    const EarthBend bend(mercator, bendOrigin, bendRoots);
    for (std::uint64_t b = 0; b < 40; ++b) {
        DAabb box;
        box.add(randomIn(bendRoots, 2 * b));
        box.add(randomIn(bendRoots, 2 * b + 1));
        const DAabb bent = bend.moved(box);
        for (std::uint64_t i = 0; i < 200; ++i) {
            const glm::dvec3 place = bend.moved(randomIn(box, 1000 * b + i));
            EXPECT_TRUE(glm::all(glm::lessThanEqual(bent.low, place)) &&
                        glm::all(glm::lessThanEqual(place, bent.high)));
        }
    }
}

TEST(EarthBend, APlaceThatIsNowhereIsRefused)
{
    MapToEarth half = mercator;
    half.degreesOf = [](std::vector<glm::dvec2> places) {
        std::vector<glm::dvec2> degrees = mercatorDegrees(places);
        for (std::size_t i = 0; i < places.size(); ++i)
            if (places[i].x > bendOrigin.x + 1.0e4)
                degrees[i] = glm::dvec2(std::numeric_limits<double>::infinity());
        return degrees;
    };
    EXPECT_THROW(EarthBend(half, bendOrigin, bendRoots), Error);
}

} // namespace
} // namespace sward::interchange
