#include "bake/blades/blade_traits.h"
#include "bake/blades/slow_waves.h"
#include "bake/plan/sward_cover.h"
#include "core/math/wide_registers.h"
#include "core/random.h"
#include "shaders/shared/noise.h"
#include "support/meshes.h"
#include "terrain/heightmap/heightfield.h"
#include "unit/bake/bake_settings.h"
#include "unit/bake/sample/place_trial.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>
#include <string_view>
#include <vector>

namespace sward::bake {
namespace {

terrain::GroundMesh plain(double side)
{
    return terrain::heightfield({glm::dvec2(side), glm::uvec2(32U)},
                                [](double, double) { return 0.0; });
}

BakeSettings meadowWith(double heightWaves, double drifts)
{
    BakeSettings settings = tests::plainSettings(1.0);
    settings.meadow = loadMeadow("grass");
    settings.meadow.heightWaves = heightWaves;
    settings.meadow.drifts = drifts;
    settings.meadow.wideVariation = 0.0;
    return settings;
}

std::vector<shared::Blade> sown(const terrain::GroundMesh& mesh, const BakeSettings& settings,
                                const std::vector<RootSample>& roots, double scale = 1.0)
{
    const tests::Place place(mesh, settings, scale);
    const BladeGrower grower(mesh, settings, {scale, meshes::totalArea(mesh)}, place.filter(),
                             &place.query());
    std::vector<shared::Blade> blades;
    for (const RootSample& root : roots)
        blades.push_back(grower.grow(root, {}));
    return blades;
}

TEST(SlowWaves, AreBoundedWhereverTheGroundLies)
{
    for (const double far : {1e6, 1e12, 1e30, -1e300}) {
        const double wave = slowWaves(glm::dvec3(far, 0.3, -far), 2.5, 7.0, 1);
        EXPECT_GE(wave, -1.0) << far;
        EXPECT_LE(wave, 1.0) << far;
    }
}

TEST(SlowWaves, HaveTheSameBitsWithWideRegistersAndInABlock)
{
    PlaceBlock places;
    BlockOfFloats narrow;
    BlockOfFloats wide;
    for (std::uint64_t block = 0; block < 300; ++block) {
        // Near the origin, far away, on cell borders, and beyond the farthest numbered cell.
        const double reach = std::array{5.0, 3e7, 1e16}[block % 3];
        for (std::size_t i = 0; i < PlaceBlock::size; ++i) {
            const auto at = [&](std::uint32_t axis) {
                const double x = reach * (2.0 * uniform(block, i, axis) - 1.0);
                return i % 8 == 0 ? 2.5 * std::floor(x) : x;
            };
            places.set(i, {at(0), at(1), at(2)});
        }
        slowWaves(places, 2.5, 7.0, block, narrow, false);
        if (hasWideRegisters()) {
            slowWaves(places, 2.5, 7.0, block, wide, true);
            ASSERT_EQ(narrow, wide) << block;
        }
        for (std::size_t i = 0; i < PlaceBlock::size; ++i)
            ASSERT_EQ(double(narrow[i]),
                      slowWaves({places.x[i], places.y[i], places.z[i]}, 2.5, 7.0, block));
    }
}

TEST(SlowWaves, AreTheSumOfTwoValueNoises)
{
    // The lattice in double precision, place by place.
    const auto noise = [](glm::dvec3 place, double length, std::uint64_t key) {
        const glm::dvec3 p = place / length;
        const glm::dvec3 cell = glm::floor(p);
        const glm::dvec3 f = p - cell;
        const glm::dvec3 s = f * f * (3.0 - 2.0 * f);
        double sum = 0.0;
        for (unsigned corner = 0; corner < 8; ++corner) {
            std::uint32_t point = 0;
            double weight = 1.0;
            const std::array steps{shared::latticeX, shared::latticeY, shared::latticeZ};
            for (glm::length_t axis = 0; axis < 3; ++axis) {
                const std::uint32_t beyond = corner >> axis & 1U;
                const auto number = static_cast<std::int64_t>(cell[axis]);
                point += (static_cast<std::uint32_t>(number) +
                          static_cast<std::uint32_t>(hashBits(key, std::uint64_t(axis))) + beyond) *
                         steps[static_cast<std::size_t>(axis)];
                weight *= beyond != 0 ? s[axis] : 1.0 - s[axis];
            }
            sum += weight * double(shared::latticeHeight(point));
        }
        return 2.0 * sum * double(shared::latticeUnit) - 1.0;
    };
    for (std::uint64_t i = 0; i < 20'000; ++i) {
        const double reach = i % 2 == 0 ? 30.0 : 1e6;
        const glm::dvec3 place(reach * (uniform(i, 0, 0) - 0.5), reach * (uniform(i, 0, 1) - 0.5),
                               reach * (uniform(i, 0, 2) - 0.5));
        const double sum =
            0.75 * noise(place, 2.5, hashBits(i, 0)) + 0.5 * noise(place, 7.0, hashBits(i, 1));
        ASSERT_NEAR(slowWaves(place, 2.5, 7.0, i), std::clamp(sum, -1.0, 1.0), 2e-6) << i;
    }
}

TEST(SlowWaves, AreEvenAroundZeroAndSmooth)
{
    for (const std::uint64_t seed : {0U, 1U, 77U}) {
        double sum = 0.0;
        double squares = 0.0;
        double steepest = 0.0;
        constexpr int side = 300;
        // Far from the origin too, where single precision has steps of a metre.
        const glm::dvec3 from(seed == 77U ? 1.5e7 : -300.0, 3.0, -300.0);
        for (int i = 0; i < side; ++i)
            for (int j = 0; j < side; ++j) {
                const glm::dvec3 place = from + glm::dvec3(2.1 * i, 0.0, 2.1 * j);
                const double wave = slowWaves(place, 3.0, 20.0, seed);
                EXPECT_LE(std::fabs(wave), 1.0);
                sum += wave;
                squares += wave * wave;
                steepest = std::max(
                    steepest,
                    std::fabs(slowWaves(place + glm::dvec3(0.01, 0.0, 0.0), 3.0, 20.0, seed) -
                              wave));
            }
        const double count = double(side) * side;
        EXPECT_NEAR(sum / count, 0.0, 0.03);
        EXPECT_NEAR(std::sqrt(squares / count), 0.36, 0.05);
        // Cubic steps of 1.5 over 3 m and of 1 over 20 m: 1.5 · (1.5/3 + 1/20) per metre.
        EXPECT_LT(steepest, 0.0083);
        EXPECT_GT(steepest, 0.002);
    }
}

TEST(SlowWaves, DifferByTheirSeeds)
{
    double product = 0.0;
    for (int i = 0; i < 10000; ++i) {
        const glm::dvec3 place(3.1 * (i % 100), 0.0, 3.3 * (i / 100));
        product += slowWaves(place, 3.0, 20.0, 1) * slowWaves(place, 3.0, 20.0, 2);
    }
    EXPECT_NEAR(product / 10000.0, 0.0, 0.03);
}

TEST(HeightWaves, RaiseAndLowerTheSameBladesWithinTheirShare)
{
    const terrain::GroundMesh mesh = plain(100.0);
    const std::vector<RootSample> roots = tests::evenRoots(mesh, 4.0);
    const std::vector<shared::Blade> even = sown(mesh, meadowWith(0.0, 0.0), roots);
    const std::vector<shared::Blade> waved = sown(mesh, meadowWith(0.15, 0.0), roots);
    double sum = 0.0;
    double low = 1.0;
    double high = 1.0;
    for (std::size_t i = 0; i < roots.size(); ++i) {
        const double factor = double(waved[i].height) / double(even[i].height);
        EXPECT_EQ(waved[i].width, even[i].width);
        sum += factor;
        low = std::min(low, factor);
        high = std::max(high, factor);
    }
    EXPECT_NEAR(sum / double(roots.size()), 1.0, 0.01);
    EXPECT_NEAR(low, 0.85, 1e-6);
    EXPECT_NEAR(high, 1.15, 1e-6);
}

TEST(HeightWaves, ScaleWithTheBlades)
{
    // The same ground a hundred times smaller has the same waves.
    const terrain::GroundMesh large = plain(64.0);
    terrain::GroundMesh small = large;
    for (glm::vec3& position : small.positions)
        position *= 1.0f / 64.0f;
    const std::vector<RootSample> roots = tests::evenRoots(large, 1.0);
    std::vector<RootSample> near = roots;
    for (RootSample& root : near)
        root.position *= 1.0f / 64.0f;
    const std::vector<shared::Blade> a = sown(large, meadowWith(0.15, 0.8), roots);
    const std::vector<shared::Blade> b = sown(small, meadowWith(0.15, 0.8), near, 1.0 / 64.0);
    std::size_t same = 0;
    for (std::size_t i = 0; i < roots.size(); ++i)
        same += a[i].species == b[i].species &&
                        std::fabs(a[i].height - 64.0f * b[i].height) < 1e-4f * a[i].height
                    ? 1U
                    : 0U;
    EXPECT_GT(same, roots.size() * 99 / 100);
}

TEST(Drifts, KeepSharesAndGatherSpecies)
{
    const terrain::GroundMesh mesh = plain(240.0);
    const std::vector<RootSample> roots = tests::evenRoots(mesh, 4.0);
    constexpr std::size_t cells = 60; // of 4 m
    // Standard deviation over the cells of the share of each species, and its mean.
    const auto spread = [&](double drifts, std::size_t slot) {
        std::vector<glm::dvec2> counts(cells * cells, glm::dvec2(0.0));
        double all = 0.0;
        for (const shared::Blade& blade : sown(mesh, meadowWith(0.0, drifts), roots)) {
            const auto column = std::size_t((double(blade.root.x) + 120.0) / 4.0);
            const auto row = std::size_t((double(blade.root.z) + 120.0) / 4.0);
            const double own = blade.species == slot ? 1.0 : 0.0;
            counts[std::min(row, cells - 1) * cells + std::min(column, cells - 1)] +=
                glm::dvec2(own, 1.0);
            all += own / double(roots.size());
        }
        double squares = 0.0;
        for (const glm::dvec2& count : counts)
            squares += std::pow(count.x / std::max(count.y, 1.0) - all, 2.0);
        return std::pair(all, std::sqrt(squares / double(counts.size())));
    };
    const std::array<double, 3> shares{0.62, 0.3, 0.08};
    for (std::size_t slot = 0; slot < shares.size(); ++slot) {
        const auto [even, evenSpread] = spread(0.0, slot);
        const auto [share, driftSpread] = spread(0.8, slot);
        EXPECT_NEAR(even, shares[slot], 0.02);
        EXPECT_NEAR(share, shares[slot], 0.02) << slot;
        EXPECT_GT(driftSpread, 1.1 * evenSpread) << slot;
    }
}

TEST(Drifts, GatherPlantsInColoniesAndKeepTheirNumber)
{
    const terrain::GroundMesh mesh = plain(240.0);
    const std::vector<RootSample> roots = tests::evenRoots(mesh, 4.0);
    BakeSettings settings = meadowWith(0.0, 0.8);
    settings.meadow = loadMeadow("meadow");
    for (const std::string_view name : {"buttercup", "ox-eye daisy", "bent"}) {
        const auto species =
            std::find_if(settings.meadow.species.begin(), settings.meadow.species.end(),
                         [&](const auto& one) { return one.name == name; });
        ASSERT_NE(species, settings.meadow.species.end());
        species->share = 0.1;
    }
    const auto all =
        std::accumulate(settings.meadow.species.begin(), settings.meadow.species.end(), 0.0,
                        [](double sum, const auto& one) { return sum + one.share; });
    constexpr std::size_t cells = 80; // of 3 m, with 3 plants of each kind
    std::array<std::vector<double>, 5> counts;
    counts.fill(std::vector<double>(cells * cells, 0.0));
    for (const shared::Blade& blade : sown(mesh, settings, roots)) {
        const auto column = std::min(std::size_t((double(blade.root.x) + 120.0) / 3.0), cells - 1);
        const auto row = std::min(std::size_t((double(blade.root.z) + 120.0) / 3.0), cells - 1);
        counts[blade.species][row * cells + column] += 1.0;
    }
    for (std::size_t slot = 2; slot < counts.size(); ++slot) {
        std::vector<double>& each = counts[slot];
        const double sum = std::accumulate(each.begin(), each.end(), 0.0);
        EXPECT_NEAR(sum / double(roots.size()), 0.1 / all, 0.01 / all) << slot;
        // Evenly spread, the fullest quarter of the cells would hold less than half of the plants.
        std::sort(each.begin(), each.end(), std::greater<>());
        const double inColonies =
            std::accumulate(each.begin(), each.begin() + cells * cells / 4, 0.0);
        EXPECT_GT(inColonies / sum, 0.58) << slot;
        EXPECT_LT(inColonies / sum, 0.9) << "some stand alone, " << slot;
    }
}

// Mean cover from above of the cells of 1 m of a square, if its blades stood closedDensity().
double coverFromAbove(const terrain::GroundMesh& mesh, const BakeSettings& settings, double side,
                      std::uint64_t seed)
{
    constexpr double density = 60.0;
    const Meadow& meadow = settings.meadow;
    std::vector<double> planShare; // of a blade's height times width
    for (const SpeciesTraits& one : meadow.species)
        planShare.push_back(coverOf(one).plan * 4.0 /
                            ((one.height.x + one.height.y) * (one.width.x + one.width.y)));
    const auto cells = static_cast<std::size_t>(side);
    std::vector<double> plan(cells * cells, 0.0);
    for (const shared::Blade& blade : sown(mesh, settings, tests::evenRoots(mesh, density, seed))) {
        const auto column = std::size_t(double(blade.root.x) + 0.5 * side);
        const auto row = std::size_t(double(blade.root.z) + 0.5 * side);
        plan[std::min(row, cells - 1) * cells + std::min(column, cells - 1)] +=
            planShare[blade.species] * double(blade.height) * double(blade.width);
    }
    double cover = 0.0;
    for (const double one : plan)
        cover += 1.0 - std::exp(-one * closedDensity(meadow) / density);
    return cover / double(plan.size());
}

TEST(SlowVariation, KeepsTheCoverFromAboveWithinTwoPercent)
{
    for (const double side : {20.0, 60.0}) {
        const terrain::GroundMesh mesh = plain(side);
        for (const std::uint64_t seed : {0U, 1U, 2U, 3U}) {
            BakeSettings even = meadowWith(0.0, 0.0);
            BakeSettings varied = meadowWith(0.15, 0.8);
            even.seed = varied.seed = seed;
            const double cover = coverFromAbove(mesh, even, side, seed);
            EXPECT_NEAR(cover, 0.88, 0.03);
            EXPECT_NEAR(coverFromAbove(mesh, varied, side, seed) / cover, 1.0, 0.02)
                << side << " m, seed " << seed;
        }
    }
}

} // namespace
} // namespace sward::bake
