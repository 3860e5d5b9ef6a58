#include "bake/plan/root_source.h"
#include "bake/poisson/poisson_region.h"
#include "core/math/exact_math.h"
#include "support/meshes.h"
#include "unit/bake/bake_settings.h"

#include <glm/gtc/quaternion.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

// Every unit of area gets the expected density, independent of the borders of cells.
namespace sward::bake {
namespace {

constexpr double pi = 3.14159265358979323846;

Roots rootsOf(const terrain::GroundMesh& ground, double density, Spread spread)
{
    BakeSettings settings = tests::plainSettings(density);
    settings.spread = spread;
    Diagnostics diagnostics;
    Progress progress;
    const RootFilter filter(ground, settings, nullptr);
    const Plan plan = planBake(meshes::totalArea(ground), 1.0, settings, diagnostics);
    const RootPlan roots = planRoots(ground, settings, filter, plan, progress);
    return sampleRoots(ground, settings, filter, roots, progress).roots;
}

// Counts in bands × sectors cells of equal area on a sphere (Archimedes).
std::vector<double> countsOnSphere(const Roots& roots, std::size_t bands, std::size_t sectors)
{
    std::vector<double> counts(bands * sectors, 0.0);
    const auto cell = [](double share, std::size_t cells) {
        return std::min(static_cast<std::size_t>(share * double(cells)), cells - 1);
    };
    for (const RootSample& root : roots) {
        const glm::dvec3 place = glm::normalize(glm::dvec3(root.position));
        const double turn = std::atan2(place.z, place.x) / (2.0 * pi) + 0.5;
        counts[cell(0.5 * (place.y + 1.0), bands) * sectors + cell(turn, sectors)] += 1.0;
    }
    return counts;
}

TEST(Density, IsRightWithinOnePerCentInEveryCellOfTenThousandRoots)
{
    const terrain::GroundMesh sphere = meshes::sphere(256, 10.0);
    const double expected = 10'000.0;
    const double density = 64.0 * expected / meshes::totalArea(sphere);
    for (const Spread spread : {Spread::uniform, Spread::poisson})
        for (const double count : countsOnSphere(rootsOf(sphere, density, spread), 8, 8))
            EXPECT_NEAR(count / expected, 1.0, 0.01);
}

TEST(Density, IsStratifiedFarBelowChance)
{
    // Independent roots have z = (χ² − k) / √(2k) near 0; Open3D's, stratified, about −13.
    const terrain::GroundMesh sphere = meshes::sphere(288, 10.0);
    const double total = 1e6;
    const std::vector<double> counts =
        countsOnSphere(rootsOf(sphere, total / meshes::totalArea(sphere), Spread::uniform), 32, 32);
    const auto cells = double(counts.size());
    double chiSquare = 0.0;
    for (const double count : counts)
        chiSquare += (count - total / cells) * (count - total / cells) / (total / cells);
    EXPECT_LE((chiSquare - cells) / std::sqrt(2.0 * cells), -10.0);
}

// Counts in 64 strips across an axis, folded by a pitch and relative to their mean. Uses only a
// square of whole pitches.
std::vector<double> strips(const Roots& roots, glm::length_t axis, double pitch, double offset)
{
    std::vector<double> counts(64, 0.0);
    const double half = 64.0;
    const double pitches = std::floor(2.0 * half / pitch);
    double total = 0.0;
    for (const RootSample& root : roots) {
        const double across = (double(root.position[axis]) + half - offset) / pitch;
        if (std::abs(double(root.position[2 - axis])) > half || across < 0.0 || across >= pitches)
            continue;
        counts[static_cast<std::size_t>(64.0 * (across - std::floor(across)))] += 1.0;
        total += 1.0;
    }
    for (double& count : counts)
        count *= 64.0 / total;
    return counts;
}

TEST(Density, HasNoSeamAtTheBordersOfCells)
{
    // The mesh is rotated, so that none of its lines coincides with a border.
    const terrain::GroundMesh ground =
        meshes::rotated(meshes::grid(96, 192.0), glm::angleAxis(0.3, glm::dvec3(0.0, 1.0, 0.0)));
    const double density = 40.0;
    for (const Spread spread : {Spread::uniform, Spread::poisson}) {
        const Roots roots = rootsOf(ground, density, spread);
        // Cells of 32 m (tiles, patches) and 4 m (patches), and cubes of disks (decision 0015): 20
        // of the 23.5 parts of a root's reach.
        BakeSettings settings = tests::plainSettings(density);
        settings.spread = spread;
        RootPlan plan;
        plan.spacing = std::sqrt(tuningOf(settings).yield / density);
        const double cube = rootReach(settings, plan) * 20.0 / 23.5;
        for (const double pitch : {32.0, 4.0, cube})
            for (glm::length_t axis = 0; pitch > 0.0 && axis < 3; axis += 2) {
                const double offset = pitch == cube ? std::fmod(64.0 + 0.377 * cube, cube) : 0.0;
                const std::vector<double> found = strips(roots, axis, pitch, offset);
                // Five standard deviations of independent roots; at the border, of better ones.
                for (const double strip : found)
                    EXPECT_NEAR(strip, 1.0, 0.05) << pitch;
                EXPECT_NEAR(0.5 * (found.front() + found.back()), 1.0, 0.02) << pitch;
            }
    }
}

} // namespace
} // namespace sward::bake
