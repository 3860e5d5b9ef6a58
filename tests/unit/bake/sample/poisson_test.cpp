#include "bake/bake.h"
#include "bake/plan/root_source.h"
#include "bake/poisson/disk_map.h"
#include "bake/poisson/poisson_disk.h"
#include "core/error.h"
#include "core/random.h"
#include "shaders/shared/blade.h"
#include "support/meshes.h"
#include "unit/bake/bake_settings.h"
#include "unit/bake/sample/spread.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <map>
#include <numeric>
#include <set>

namespace sward::bake {
namespace {

BakeSettings poisson(double spacing, Spread spread = Spread::poisson)
{
    BakeSettings settings = tests::plainSettings(1.0);
    settings.density.reset();
    settings.spacing = spacing;
    settings.spread = spread;
    return settings;
}

Sampling sampleOf(const terrain::GroundMesh& ground, const BakeSettings& settings)
{
    Progress progress;
    const RootFilter filter(ground, settings, nullptr);
    return PoissonDisk(ground, settings, filter, *settings.spacing, filter.needsAnything(),
                       tuningOf(settings))
        .sample(progress);
}

std::uint64_t rejections(const Sampling& sampling)
{
    return std::accumulate(sampling.rejected.begin(), sampling.rejected.end(), std::uint64_t(0));
}

std::vector<glm::dvec3> placesOf(const Roots& roots)
{
    std::vector<glm::dvec3> places;
    for (const RootSample& root : roots)
        places.emplace_back(root.position);
    return places;
}

// Share of uniform random ground points without a root within the spacing.
double uncovered(const terrain::GroundMesh& ground, const Roots& roots, double spacing)
{
    std::map<std::array<int, 3>, std::vector<glm::dvec3>> cells;
    const auto cellOf = [&](const glm::dvec3& p) {
        return std::array<int, 3>{int(std::floor(p.x / spacing)), int(std::floor(p.y / spacing)),
                                  int(std::floor(p.z / spacing))};
    };
    for (const glm::dvec3& place : placesOf(roots))
        cells[cellOf(place)].push_back(place);
    const BakeSettings settings = tests::plainSettings(20'000.0 / meshes::totalArea(ground));
    const RootFilter filter(ground, settings, nullptr);
    Progress progress;
    const Roots probes =
        SurfaceSampler(ground, settings, filter).sample({*settings.density}, progress).roots;
    std::size_t open = 0;
    for (const glm::dvec3& probe : placesOf(probes)) {
        bool covered = false;
        const auto cell = cellOf(probe);
        for (int x = -1; x <= 1; ++x)
            for (int y = -1; y <= 1; ++y)
                for (int z = -1; z <= 1; ++z)
                    if (const auto found = cells.find({cell[0] + x, cell[1] + y, cell[2] + z});
                        found != cells.end())
                        for (const glm::dvec3& place : found->second)
                            covered = covered || glm::distance(place, probe) <= spacing;
        open += covered ? 0 : 1;
    }
    return double(open) / double(probes.size());
}

TEST(PoissonDisk, KeepsTheSpacingAndLeavesHardlyAGap)
{
    const terrain::GroundMesh sphere = meshes::sphere(128, 1.0);
    const double area = meshes::totalArea(sphere);
    const Sampling fast = sampleOf(sphere, poisson(0.02));
    EXPECT_GE(tests::smallestDistance(placesOf(fast.roots), 0.04), 0.02);
    EXPECT_GE(tests::relativeRadius(placesOf(fast.roots), area), 0.70);
    EXPECT_LE(uncovered(sphere, fast.roots, 0.02), 0.01);

    const Sampling dense = sampleOf(sphere, poisson(0.02, Spread::poissonDense));
    EXPECT_GE(tests::smallestDistance(placesOf(dense.roots), 0.04), 0.02);
    EXPECT_GE(tests::relativeRadius(placesOf(dense.roots), area), 0.74);
    EXPECT_LE(uncovered(sphere, dense.roots, 0.02), 0.003);
}

TEST(PoissonDisk, YieldsTheNumberThatItsTuningSays)
{
    const terrain::GroundMesh ground = meshes::square(10.0);
    for (const Spread spread : {Spread::poisson, Spread::poissonDense}) {
        const BakeSettings settings = poisson(0.04, spread);
        const double expected = tuningOf(settings).yield * 100.0 / (0.04 * 0.04);
        EXPECT_NEAR(double(sampleOf(ground, settings).roots.size()) / expected, 1.0, 0.01);
    }
}

TEST(PoissonDisk, HasNoDirectionOnARowOrderedGrid)
{
    // |ψm|: mean of exp(imθ) over the directions from roots to near neighbours.
    const terrain::GroundMesh ground = meshes::grid(200, 10.0);
    const std::vector<glm::dvec3> places = placesOf(sampleOf(ground, poisson(0.05)).roots);
    std::map<std::pair<int, int>, std::vector<glm::dvec3>> cells;
    for (const glm::dvec3& p : places)
        cells[{int(std::floor(p.x / 0.1)), int(std::floor(p.z / 0.1))}].push_back(p);
    std::complex<double> sum[3];
    double bonds = 0.0;
    for (const glm::dvec3& p : places)
        for (int x = -1; x <= 1; ++x)
            for (int z = -1; z <= 1; ++z)
                for (const glm::dvec3& q :
                     cells[{int(std::floor(p.x / 0.1)) + x, int(std::floor(p.z / 0.1)) + z}]) {
                    const glm::dvec3 offset = q - p;
                    const double distance = glm::length(offset);
                    if (distance <= 0.0 || distance > 1.5 * 0.05)
                        continue;
                    const double angle = std::atan2(offset.z, offset.x);
                    for (int m = 0; m < 3; ++m)
                        sum[m] += std::polar(1.0, 2.0 * (m + 1) * angle);
                    bonds += 1.0;
                }
    for (const std::complex<double>& psi : sum)
        EXPECT_LE(std::abs(psi) / bonds, 0.03);
}

TEST(PoissonDisk, DoesNotLetTheTwoSidesOfASheetRepelEachOther)
{
    const terrain::GroundMesh ground = meshes::square(4.0);
    BakeSettings settings = poisson(0.05);
    const std::size_t front = sampleOf(ground, settings).roots.size();
    settings.sides = Sides::both;
    const Sampling both = sampleOf(ground, settings);
    EXPECT_NEAR(double(both.roots.size()), 2.0 * double(front), 0.02 * double(front));
}

TEST(PoissonDisk, KeepsTheSpacingRoundSharpEdges)
{
    const terrain::GroundMesh ground = meshes::cube(2.0);
    const Sampling sampling = sampleOf(ground, poisson(0.05));
    // Faces that meet at a right angle are two sheets; on one face the spacing holds.
    for (glm::length_t axis = 0; axis < 3; ++axis)
        for (const float side : {-1.0f, 1.0f}) {
            std::vector<glm::dvec3> face;
            for (const RootSample& root : sampling.roots)
                if (side * root.normal[axis] > 0.9f)
                    face.emplace_back(root.position);
            EXPECT_GT(face.size(), 700U);
            EXPECT_GE(tests::smallestDistance(face, 0.1), 0.05);
        }
}

TEST(PoissonDisk, IsTheSameForAnyNumberOfThreads)
{
    const terrain::GroundMesh ground = meshes::sphere(48, 1.0);
    const auto keysWith = [&](std::size_t threads) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        std::vector<std::uint64_t> keys;
        for (const RootSample& root : sampleOf(ground, poisson(0.03)).roots)
            keys.push_back(keyBits(keyOf(ground, root)));
        return keys;
    };
    const std::vector<std::uint64_t> one = keysWith(1);
    EXPECT_EQ(one, keysWith(2));
    EXPECT_EQ(one, keysWith(7));
    EXPECT_EQ(std::set<std::uint64_t>(one.begin(), one.end()).size(), one.size());
}

TEST(PoissonDisk, ThinsEvenlyUnderAMask)
{
    // Density is proportional to the mask, and sparse areas have wider spacings.
    terrain::GroundMesh ground = meshes::square(8.0);
    ground.hasColors = true;
    const std::size_t full = sampleOf(ground, poisson(0.05)).roots.size();
    for (const double weight : {0.5, 0.25, 0.1, 0.03}) {
        for (glm::vec4& color : ground.colors)
            color = glm::vec4(static_cast<float>(weight));
        BakeSettings settings = poisson(0.05);
        settings.masks = {{.channel = 0}};
        const Sampling sampling = sampleOf(ground, settings);
        const double expected = double(full) * weight;
        EXPECT_NEAR(double(sampling.roots.size()), expected,
                    0.015 * expected + 4.0 * std::sqrt(expected))
            << weight;
        const double widest = std::min(1.0 / std::sqrt(weight), 4.0);
        EXPECT_GE(tests::smallestDistance(placesOf(sampling.roots), 0.3), 0.0499 * widest);
    }
}

TEST(PoissonDisk, MeetsACountExactly)
{
    const terrain::GroundMesh ground = meshes::sphere(96, 1.0);
    for (const std::uint64_t count : {1ULL, 10ULL, 777ULL, 30'000ULL}) {
        BakeSettings settings = poisson(1.0);
        settings.spacing.reset();
        settings.count = count;
        settings.slope = {0.0, 120.0, 0.0};
        const RootFilter filter(ground, settings, nullptr);
        Progress progress;
        const RootPlan plan = planRoots(ground, settings, filter, {}, progress);
        const Sampling sampling = sampleRoots(ground, settings, filter, plan, progress);
        ASSERT_EQ(sampling.roots.size(), count);
        if (count > 10'000) {
            // Three quarters of the sphere's area bear.
            const double area = 0.75 * meshes::totalArea(ground);
            EXPECT_GE(tests::relativeRadius(placesOf(sampling.roots), area), 0.69);
        }
    }
}

TEST(PoissonDisk, RefusesATriangleThatIsTooLargeForTheSpacing)
{
    EXPECT_THROW(sampleOf(meshes::square(100.0), poisson(0.001)), Error);
}

TEST(PoissonDisk, HasTheSameRootsWithoutMapsAndBounds)
{
    // Smooth regions, sheets on each other, folded regions; with and without filters.
    terrain::GroundMesh stack = meshes::square(20.0);
    append(stack, meshes::square(20.0, 0.02));
    const terrain::GroundMesh grounds[] = {meshes::sphere(128, 8.0), meshes::hills(20.0, 40),
                                           std::move(stack), meshes::cube(2.0)};
    for (const terrain::GroundMesh& ground : grounds)
        for (const Spread spread : {Spread::poisson, Spread::poissonDense})
            for (const bool filtered : {false, true}) {
                BakeSettings settings = poisson(0.1, spread);
                if (filtered)
                    settings.slope = {0.0, 60.0, 30.0};
                const RootFilter filter(ground, settings, nullptr);
                Progress progress;
                PoissonTuning tuning = tuningOf(settings);
                const auto sampled = [&] {
                    return PoissonDisk(ground, settings, filter, 0.1, filter.needsAnything(),
                                       tuning)
                        .sample(progress);
                };
                const Roots mapped = sampled().roots;
                ASSERT_GT(mapped.size(), 100U);
                const auto expectSame = [&](const Roots& others) {
                    ASSERT_EQ(mapped.size(), others.size());
                    for (std::size_t i = 0; i < mapped.size(); ++i) {
                        ASSERT_EQ(keyBits(keyOf(ground, mapped[i])),
                                  keyBits(keyOf(ground, others[i])));
                        ASSERT_EQ(mapped[i].position, others[i].position);
                    }
                };
                tuning.maps = false;
                expectSame(sampled().roots);
                tuning.bounds = false;
                const Sampling unbounded = sampled();
                expectSame(unbounded.roots);
                tuning.bounds = true;
                // Darts that bare parts save are counted.
                const Sampling bounded = sampled();
                EXPECT_EQ(bounded.proposed, bounded.roots.size() + rejections(bounded));
                if (spread == Spread::poisson) {
                    EXPECT_NEAR(double(bounded.proposed) / double(unbounded.proposed), 1.0, 1e-3);
                }
            }
}

TEST(DiskMap, IsSureOnlyOfWhatADiskBlocks)
{
    constexpr double spacing = 0.05;
    RegionFrame frame;
    frame.spacing = spacing;
    frame.rounding = 1e-7;
    frame.axes = glm::dmat3(DiskMap::cellsPerSpacing / spacing);
    frame.origin = glm::dvec3(-2.0);
    frame.cells = glm::ivec2(240);
    DiskMap map;
    map.clear(frame);
    std::vector<glm::vec3> disks;
    std::size_t sure = 0;
    for (std::uint64_t i = 0; i < 60'000; ++i) {
        // A slope of 1 : 2, up to a tenth of a spacing rough.
        const double x = 3.0 * uniform(1, i, 0) - 1.5;
        const double y = 3.0 * uniform(1, i, 1) - 1.5;
        const glm::vec3 place(glm::dvec3(x, y, 0.5 * x + 0.1 * spacing * uniform(1, i, 2)));
        const glm::vec3 local(frame.place(glm::dvec3(place)));
        const bool blocked = std::any_of(disks.begin(), disks.end(), [&](const glm::vec3& disk) {
            return glm::distance(disk, place) < static_cast<float>(spacing);
        });
        EXPECT_EQ(map.blocks(place, local, static_cast<float>(spacing)), blocked);
        if (DiskMap::Look(map).surelyBlocks(local)) {
            EXPECT_TRUE(blocked);
            ++sure;
        }
        if (map.surelyCovers(local, local + glm::vec3(1, 0, 0), local + glm::vec3(0, 1, 0))) {
            const glm::vec3 inside = local + glm::vec3(0.3f, 0.6f, 0.0f);
            const glm::vec3 there(frame.origin +
                                  glm::dvec3(inside) * spacing / double(DiskMap::cellsPerSpacing));
            EXPECT_TRUE(map.blocks(there, inside, static_cast<float>(spacing)));
        }
        if (!blocked) {
            ASSERT_TRUE(
                map.insert({place, static_cast<float>(spacing), glm::vec3(0, 0, 1)}, local));
            disks.push_back(place);
        }
    }
    // Hardly a blocked dart needs a second look.
    EXPECT_GE(double(sure), 0.9 * double(60'000 - disks.size()));
}

TEST(PoissonDisk, ACountIsEvenInItsFile)
{
    // As measured from the packed blades: neither packing nor counting may cost more.
    const terrain::GroundMesh ground = meshes::sphere(256, 10.0);
    for (const Spread spread : {Spread::poisson, Spread::poissonDense}) {
        BakeSettings settings = poisson(1.0, spread);
        settings.spacing.reset();
        settings.count = 300'000;
        Diagnostics diagnostics;
        Progress progress;
        const field::Field field = bakeField(ground, settings, 2, diagnostics, progress).field;
        std::vector<glm::dvec3> places;
        for (const shared::Patch& patch : field.patches)
            for (std::uint32_t i = 0; i < patch.bladeCount; ++i)
                places.emplace_back(
                    shared::unpackBlade(field.blades[patch.firstBlade + i], patch).root);
        EXPECT_EQ(places.size(), 300'000U);
        EXPECT_GE(tests::relativeRadius(places, meshes::totalArea(ground)),
                  spread == Spread::poisson ? 0.70 : 0.735);
    }
}

TEST(PoissonDisk, APlanSamplesTheSameRootsAgain)
{
    const terrain::GroundMesh ground = meshes::sphere(96, 1.0);
    BakeSettings settings = poisson(1.0);
    settings.spacing.reset();
    settings.count = 10'000;
    const RootFilter filter(ground, settings, nullptr);
    Progress progress;
    const RootPlan plan = planRoots(ground, settings, filter, {}, progress);
    ASSERT_NE(plan.sampled, nullptr);
    const Sampling first = sampleRoots(ground, settings, filter, plan, progress);
    const Sampling second = sampleRoots(ground, settings, filter, plan, progress);
    ASSERT_EQ(first.roots.size(), second.roots.size());
    EXPECT_EQ(first.proposed, second.proposed);
    for (std::size_t i = 0; i < first.roots.size(); ++i)
        ASSERT_EQ(keyBits(keyOf(ground, first.roots[i])), keyBits(keyOf(ground, second.roots[i])));
}

TEST(PoissonLattice, KeepsRegionsOfOneKindApart)
{
    const double apart = 1.0;
    const PoissonLattice lattice(16.0, 3.3, apart, 100.0);
    struct Place {
        glm::dvec3 at;
        PoissonLattice::Key key;
    };
    std::array<std::vector<Place>, 4> kinds;
    for (std::uint64_t i = 0; i < 30'000; ++i) {
        // Many of them near planes.
        const auto coordinate = [&](std::uint32_t axis) {
            const double x = uniform(1, i, axis);
            const double plane = 3.3 + 16.0 * std::floor(uniform(1, i, axis + 3) * 3.0);
            return i % 2 == 0 ? plane + (x - 0.5) * 8.0 : 40.0 * x;
        };
        const glm::dvec3 place(coordinate(0), coordinate(1), coordinate(2));
        const PoissonLattice::Key key = lattice.regionOf(place);
        kinds[std::size_t(PoissonLattice::kindOf(key))].push_back({place, key});

        // The regions of a box include those of its points.
        std::vector<PoissonLattice::Key> keys;
        lattice.addRegionsOf(place - 0.3, place + 0.1, keys);
        ASSERT_EQ(std::count(keys.begin(), keys.end(), key), 1);
        const DAabb box = lattice.boxOf(key);
        ASSERT_EQ(glm::clamp(place, box.low, box.high), place);
    }
    for (const std::vector<Place>& places : kinds) {
        ASSERT_GT(places.size(), 100U);
        for (std::size_t i = 0; i < std::min<std::size_t>(places.size(), 4000); ++i)
            for (std::size_t j = 0; j < i; ++j)
                if (places[i].key != places[j].key) {
                    ASSERT_GE(glm::distance(places[i].at, places[j].at), apart);
                }
    }
}

} // namespace
} // namespace sward::bake
