// The share of the sun and of the sky that reaches the places an eye sees: true rays beside the
// formulas of shaders/shared/cover.h. Prints a table for each density. docs/algorithms/truth.md

#include "core/random.h"
#include "shaders/shared/cover.h"
#include "unit/render/light/traced_meadow.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace sward::test {
namespace {

using Formula = std::function<double(const SeenPlace&)>;

struct Sun {
    std::string name;
    double azimuth;   ///< [degrees] from −z, where the eye looks, towards x
    double elevation; ///< [degrees]

    glm::dvec3 direction() const
    {
        const double a = glm::radians(azimuth);
        const double e = glm::radians(elevation);
        return {std::sin(a) * std::cos(e), std::sin(e), -std::cos(a) * std::cos(e)};
    }
};

const std::array views{MeadowView{"mid", 1.6, 26.8, 24.0}, MeadowView{"graze", 0.9, 14.0, 10.0},
                       MeadowView{"top", 4.0, 89.9, 24.0}};
const std::array suns{Sun{"60°", 135.0, 60.0}, Sun{"20° beside", 90.0, 20.0},
                      Sun{"15° behind", 0.0, 15.0}};

constexpr double pixelSize = 0.09;  ///< [degrees]: of 270 rows over 24°
constexpr double sunRadius = 0.265; ///< [degrees]
constexpr std::size_t pixels = 3000;
constexpr std::size_t samples = 4;

/// Side of the meadow [m]: a sun at 15° reaches no place in sight over its edge.
constexpr double side = 6.0;

/// A unit direction in the sun's disk.
glm::dvec3 inDisk(const glm::dvec3& sun, std::size_t number)
{
    const glm::dvec3 a = glm::normalize(glm::cross(sun, glm::dvec3(0.3, 0.1, 0.9)));
    const glm::dvec3 b = glm::cross(sun, a);
    const double r = std::sqrt(uniform(5, number, 0)) * std::tan(glm::radians(sunRadius));
    const double phi = 2.0 * std::numbers::pi * uniform(5, number, 1);
    return glm::normalize(sun + r * (std::cos(phi) * a + std::sin(phi) * b));
}

/// A unit direction around a unit normal, with a density proportional to the cosine.
glm::dvec3 aroundNormal(const glm::dvec3& normal, std::size_t number)
{
    const glm::dvec3 other = std::abs(normal.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
    const glm::dvec3 a = glm::normalize(glm::cross(normal, other));
    const glm::dvec3 b = glm::cross(normal, a);
    const double square = uniform(6, number, 0);
    const double phi = 2.0 * std::numbers::pi * uniform(6, number, 1);
    return std::sqrt(1.0 - square) * normal +
           std::sqrt(square) * (std::cos(phi) * a + std::sin(phi) * b);
}

/// Mean and contrast over pixels, and the shares of lit and dark ones.
struct Shares {
    double mean = 0.0;
    double contrast = 0.0; ///< standard deviation over mean
    double lit = 0.0;      ///< share of pixels with 0.9 and more
    double dark = 0.0;     ///< share of pixels below 0.1
};

Shares sharesOf(const std::vector<SeenPlace>& places, const std::vector<double>& values)
{
    Shares shares;
    double squares = 0.0;
    double count = 0.0;
    for (std::size_t i = 0; i < places.size();) {
        double sum = 0.0;
        std::size_t end = i;
        for (; end < places.size() && places[end].pixel == places[i].pixel; ++end)
            sum += values[end];
        const double pixel = sum / static_cast<double>(end - i);
        shares.mean += pixel;
        squares += pixel * pixel;
        shares.lit += pixel >= 0.9 ? 1.0 : 0.0;
        shares.dark += pixel < 0.1 ? 1.0 : 0.0;
        count += 1.0;
        i = end;
    }
    shares.mean /= count;
    shares.lit /= count;
    shares.dark /= count;
    shares.contrast =
        std::sqrt(std::max(squares / count - shares.mean * shares.mean, 0.0)) / shares.mean;
    return shares;
}

Shares sharesOf(const std::vector<SeenPlace>& places, const Formula& formula)
{
    std::vector<double> values(places.size());
    std::transform(places.begin(), places.end(), values.begin(), formula);
    return sharesOf(places, values);
}

double meanOf(const std::vector<SeenPlace>& places, const Formula& formula)
{
    double sum = 0.0;
    for (const SeenPlace& place : places)
        sum += formula(place);
    return sum / static_cast<double>(places.size());
}

/// Leaf area above a place as the shaders have it: by its height, from a curve of 16 steps.
double leafAreaOfShader(const SeenPlace& place)
{
    return place.leafArea * place.shaderShare;
}

/// The same by its height over the ground.
double leafAreaByHeight(const SeenPlace& place)
{
    return place.leafArea * place.shareAbove;
}

/// The sun's share by the shaders' formula, with their `projection` of the meadow's leaves.
Formula sunOfShader(float projection, double cosine)
{
    return [=](const SeenPlace& place) {
        return static_cast<double>(shared::sunBelow(
            projection, static_cast<float>(leafAreaOfShader(place)), static_cast<float>(cosine)));
    };
}

/// The sun's share by leaf area by height, with the shaders' lowest cosine.
Formula sunByHeight(double extinction, double cosine)
{
    return [=](const SeenPlace& place) {
        return std::exp(-extinction * leafAreaByHeight(place) /
                        std::max(cosine, static_cast<double>(shared::lowestSun)));
    };
}

/// A meadow, and what rays say of it.
struct Meadow {
    std::string name;
    double density;  ///< [1/m²]
    double overhead; ///< projection of its blades for a sun at the zenith …
    double level;    ///< … and at the horizon
    double sky;      ///< extinction of the sky's light on the side that is seen
};

/// Mean |normal · sun| of the meadow's blades, as of blades that stand and blades that lie.
double projectionFit(const Meadow& meadow, double cosine)
{
    return std::hypot(meadow.overhead * cosine, meadow.level * std::sqrt(1.0 - cosine * cosine));
}

/// The sun's share by height with the projection of the blades as extinction (Nilson 1971).
Formula sunByProjection(const Meadow& meadow, double cosine)
{
    const double perLeafArea = projectionFit(meadow, cosine) / std::max(cosine, 0.1);
    return [=](const SeenPlace& place) { return std::exp(-perLeafArea * leafAreaByHeight(place)); };
}

/// The argument in [0, limit] at which a falling mean is `wanted`.
double fitted(double wanted, double limit, const std::function<double(double)>& mean)
{
    double low = 0.0;
    double high = limit;
    for (int i = 0; i < 30; ++i)
        (mean(0.5 * (low + high)) > wanted ? low : high) = 0.5 * (low + high);
    return low;
}

/// What true rays say of the sun in one view.
struct SunTruth {
    Shares shares;
    double weighted; ///< mean share, weighted by |normal · sun|
};

SunTruth sunTruth(const TracedMeadow& meadow, const std::vector<SeenPlace>& places, const Sun& sun)
{
    const glm::dvec3 direction = sun.direction();
    std::vector<double> seen(places.size());
    double light = 0.0;
    double unshaded = 0.0;
    for (std::size_t i = 0; i < places.size(); ++i) {
        seen[i] = meadow.seesSky(places[i].position, inDisk(direction, i)) ? 1.0 : 0.0;
        const double facing = std::abs(glm::dot(places[i].normal, direction));
        light += facing * seen[i];
        unshaded += facing;
    }
    return {sharesOf(places, seen), light / unshaded};
}

/// The line below the head of a table.
std::string rule(int columns)
{
    std::string line;
    for (int i = 0; i < columns; ++i)
        line += " --- |";
    return line;
}

constexpr std::array extinctions{0.40, 0.46, 0.50, 0.55};

void printSun(const Meadow& meadow, float projection, const std::string& view, const Sun& sun,
              const std::vector<SeenPlace>& places, const SunTruth& truth)
{
    const double cosine = sun.direction().y;
    const Shares& real = truth.shares;
    const Shares now = sharesOf(places, sunOfShader(projection, cosine));
    std::vector<double> flecks(places.size());
    const Formula chance = sunByProjection(meadow, cosine);
    for (std::size_t i = 0; i < places.size(); ++i)
        flecks[i] = uniform(9, i, 0) < chance(places[i]) ? 1.0 : 0.0;
    std::string row = fmt::format("| {} | {} | {:.3f} | {:.3f} | {:.3f} | {:.2f} / {:.2f} | {:.0f} "
                                  "/ {:.0f} | {:.0f} / {:.0f} "
                                  "|",
                                  view, sun.name, real.mean, truth.weighted, now.mean,
                                  real.contrast, now.contrast, 100.0 * real.lit, 100.0 * now.lit,
                                  100.0 * real.dark, 100.0 * now.dark);
    for (const double extinction : extinctions)
        row += fmt::format(" {:.3f} |", sharesOf(places, sunByHeight(extinction, cosine)).mean);
    const double best = fitted(real.mean, 3.0, [&](double extinction) {
        return sharesOf(places, sunByHeight(extinction, cosine)).mean;
    });
    fmt::print("{} {:.2f} | {:.3f} | {:.2f} |\n", row, best, sharesOf(places, chance).mean,
               sharesOf(places, flecks).contrast);
}

/// Built-in meadows at blade scale 1.
const std::array meadows{
    Meadow{"grass", 800.0, 0.30, 0.58, 1.2}, Meadow{"grass", 2400.0, 0.30, 0.58, 1.2},
    Meadow{"lawn", 4000.0, 0.11, 0.62, 1.5}, Meadow{"hay", 1600.0, 0.335, 0.56, 1.08}};

/// The meadow's rays, made once.
const TracedMeadow& traced(const Meadow& meadow)
{
    static std::map<std::pair<std::string, double>, TracedMeadow> made;
    const auto key = std::make_pair(meadow.name, meadow.density);
    const auto at = made.find(key);
    if (at != made.end())
        return at->second;
    return made.try_emplace(key, meadow.name, meadow.density, side).first->second;
}

class SunShare : public testing::TestWithParam<Meadow> {};

TEST_P(SunShare, IsThatOfRays)
{
    const TracedMeadow& meadow = traced(GetParam());
    fmt::print("\n{}, {:.0f} blades per m², leaf area index {:.2f}\n\n"
               "| view | sun | rays | weighted | shader | contrast rays / shader | lit % | dark % "
               "| k 0.40 | 0.46 | 0.50 | 0.55 | fitted k | projection | its flecks |\n"
               "|{}\n",
               GetParam().name, GetParam().density, meadow.leafAreaIndex(), rule(15));
    for (std::size_t v = 0; v < views.size(); ++v) {
        const std::vector<SeenPlace> places = meadow.seenFrom(views[v], pixelSize, pixels, samples);
        ASSERT_GT(places.size(), pixels / 2);
        for (std::size_t s = 0; s < suns.size(); ++s) {
            const double cosine = suns[s].direction().y;
            const SunTruth truth = sunTruth(meadow, places, suns[s]);
            printSun(GetParam(), meadow.shaderProjection(), views[v].name, suns[s], places, truth);
            const std::string name = views[v].name + ", " + suns[s].name;

            // Tall leaves stand in clumps, between which a flat sun shines: see "graze".
            const double flat = v == 1 && s > 0 ? 0.12 : 0.09;
            EXPECT_NEAR(sharesOf(places, sunOfShader(meadow.shaderProjection(), cosine)).mean,
                        truth.shares.mean, flat)
                << name;
            // With the meadow's own curve and the projection of the blades. The plants of hay stand
            // in colonies, and the curve is one for all.
            EXPECT_NEAR(sharesOf(places, sunByProjection(GetParam(), cosine)).mean,
                        truth.shares.mean, GetParam().name == "hay" ? 0.06 : 0.05)
                << name;
        }
    }
}

TEST_P(SunShare, NeedsTheProjectionOfTheBladesAsExtinction)
{
    const TracedMeadow& meadow = traced(GetParam());
    for (const double elevation : {89.0, 75.0, 60.0, 45.0, 30.0, 20.0, 15.0, 8.0})
        for (const double azimuth : {0.0, 90.0, 210.0}) {
            const glm::dvec3 sun = Sun{"", azimuth, elevation}.direction();
            EXPECT_NEAR(meadow.projection(sun), projectionFit(GetParam(), sun.y), 0.02)
                << elevation << "°";
            // The shaders know one number of it.
            EXPECT_NEAR(
                meadow.projection(sun),
                shared::leafProjectionAlong(meadow.shaderProjection(), static_cast<float>(sun.y)),
                0.04)
                << elevation << "°";
        }
}

TEST_P(SunShare, OfTheSkyFallsWithLeafAreaByHeight)
{
    const TracedMeadow& meadow = traced(GetParam());
    fmt::print("\n{}, {:.0f} blades per m²\n\n"
               "| view | sky, seen side | other side | shader, seen side | c | c of both |\n|{}\n",
               GetParam().name, GetParam().density, rule(6));
    for (const MeadowView& view : views) {
        const std::vector<SeenPlace> places = meadow.seenFrom(view, pixelSize, pixels, samples);
        double seen = 0.0;
        double other = 0.0;
        for (std::size_t i = 0; i < places.size(); ++i) {
            const auto open = [&](const glm::dvec3& normal, std::size_t number) {
                return meadow.seesSky(places[i].position, aroundNormal(normal, number)) ? 1.0 : 0.0;
            };
            seen += open(places[i].normal, 2 * i);
            other += open(-places[i].normal, 2 * i + 1);
        }
        seen /= static_cast<double>(places.size());
        other /= static_cast<double>(places.size());

        // Without blades, a side sees the sky by (1 + n·up)/2.
        const auto sky = [&](double sign, const Formula& open) {
            return meanOf(places, [&](const SeenPlace& place) {
                return (0.5 + 0.5 * sign * place.normal.y) * open(place);
            });
        };
        const auto byHeight = [](double c) -> Formula {
            return [c](const SeenPlace& place) { return std::exp(-c * leafAreaByHeight(place)); };
        };
        const Formula shader = [](const SeenPlace& place) {
            return static_cast<double>(
                shared::skyBelow(static_cast<float>(leafAreaOfShader(place))));
        };
        const double c = fitted(seen, 30.0, [&](double q) { return sky(1.0, byHeight(q)); });
        // Of the light of both sides, weighted by reflection and transmission of a blade.
        const double through =
            0.8 * meanOf(places, [](const SeenPlace& place) { return place.translucency; });
        const double both = fitted(seen + through * other, 30.0, [&](double q) {
            return sky(1.0, byHeight(q)) + through * sky(-1.0, byHeight(q));
        });
        fmt::print("| {} | {:.3f} | {:.3f} | {:.3f} | {:.2f} | {:.2f} |\n", view.name, seen, other,
                   sky(1.0, shader), c, both);
        EXPECT_NEAR(sky(1.0, byHeight(GetParam().sky)), seen, 0.025) << view.name;
        EXPECT_NEAR(sky(1.0, shader), seen, 0.08) << view.name;
    }
}

INSTANTIATE_TEST_SUITE_P(OfMeadows, SunShare, testing::ValuesIn(meadows), [](const auto& one) {
    return fmt::format("{}{:.0f}", one.param.name, one.param.density);
});

} // namespace
} // namespace sward::test
