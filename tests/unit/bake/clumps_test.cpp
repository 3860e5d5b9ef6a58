#include "bake/blades/clumps.h"
#include "core/random.h"
#include "support/meshes.h"
#include "terrain/heightmap/heightfield.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace sward::bake {
namespace {

terrain::GroundMesh ground(double side, std::uint32_t cells)
{
    return terrain::heightfield({glm::dvec2(side), glm::uvec2(cells)},
                                [](double x, double z) { return 0.4 * std::sin(x) * std::cos(z); });
}

glm::vec3 placeOn(const terrain::GroundMesh& mesh, std::uint64_t i)
{
    const auto t = static_cast<std::size_t>(uniform(4, i, 0) * double(mesh.triangles.size()));
    return mesh.positions[mesh.triangles[t].x];
}

TEST(Clumps, StandAboutTheirSpacingApart)
{
    // Triangles far larger and far smaller than clumps.
    for (const std::uint32_t cells : {4U, 400U}) {
        const terrain::GroundMesh mesh = ground(20.0, cells);
        double clumps = 0.0;
        for (std::uint64_t seed = 0; seed < 10; ++seed)
            clumps += double(Clumps(mesh, 0.5, seed).size());
        const double expected = 10.0 * meshes::totalArea(mesh) / 0.25;
        EXPECT_NEAR(clumps, expected, 5.0 * std::sqrt(expected)) << cells;
    }
    EXPECT_EQ(Clumps(ground(20.0, 4), 0.0, 1).size(), 0U);
}

TEST(Clumps, NearestIsNearest)
{
    const terrain::GroundMesh mesh = ground(12.0, 50);
    const double spacing = 0.7;
    const Clumps clumps(mesh, spacing, 3);
    // All clumps that are nearest to some position.
    std::map<std::uint64_t, glm::vec3> all;
    for (std::uint64_t i = 0; i < 50'000; ++i)
        if (const Clumps::Clump* found = clumps.nearest(placeOn(mesh, i)))
            all.emplace(found->key, found->centre);
    EXPECT_GT(double(all.size()), 0.9 * double(clumps.size()));
    int lonely = 0;
    for (std::uint64_t i = 0; i < 2000; ++i) {
        const glm::vec3 place = placeOn(mesh, i);
        double best = clumps.reach();
        for (const auto& [key, centre] : all)
            best = std::min(best, glm::length(glm::dvec3(centre) - glm::dvec3(place)));
        const Clumps::Clump* const found = clumps.nearest(place);
        lonely += found == nullptr ? 1 : 0;
        if (found != nullptr) {
            ASSERT_NEAR(glm::length(glm::dvec3(found->centre) - glm::dvec3(place)), best, 1e-6);
        }
    }
    EXPECT_LT(lonely, 10);
}

TEST(Clumps, NearestOfSeveralRootsIsThatOfEach)
{
    const terrain::GroundMesh mesh = ground(12.0, 50);
    for (const double spacing : {0.05, 0.7, 20.0}) {
        const Clumps clumps(mesh, spacing, 3);
        for (const double width : {0.0, 0.01, 0.2, 3.0, 40.0})
            for (std::uint64_t set = 0; set < 20; ++set) {
                // A group of roots of this width, here and there beyond the ground.
                const auto count = static_cast<std::size_t>(1 + set * 5);
                const glm::vec3 middle = placeOn(mesh, set);
                std::vector<RootSample> roots(count);
                for (std::size_t i = 0; i < count; ++i)
                    roots[i].position =
                        middle + glm::vec3(float(width * (uniform(set, i, 5) - 0.5)),
                                           float(0.1 * width * uniform(set, i, 6)),
                                           float(width * (uniform(set, i, 7) - 0.5)));
                std::vector<const Clumps::Clump*> found(count);
                clumps.nearest(roots, found);
                for (std::size_t i = 0; i < count; ++i)
                    ASSERT_EQ(found[i], clumps.nearest(roots[i].position))
                        << spacing << " " << width << " " << i;
            }
    }
}

TEST(Clumps, OfAPartAreThoseOfTheWhole)
{
    const terrain::GroundMesh whole = ground(30.0, 60);
    terrain::GroundMesh part = whole;
    part.triangles.clear();
    part.bears.clear();
    for (std::uint32_t t = 0; t < whole.triangles.size(); ++t)
        if (std::fabs(whole.positions[whole.triangles[t].x].x) < 8.0f) {
            part.triangles.push_back(whole.triangles[t]);
            part.bears.push_back(1);
            part.sourceOf.push_back(t);
        }
    const Clumps all(whole, 0.8, 5);
    const Clumps some(part, 0.8, 5);
    ASSERT_LT(some.size(), 2 * all.size() / 3);
    for (std::uint64_t i = 0; i < 5000; ++i) {
        const glm::vec3 place = placeOn(whole, i);
        if (std::fabs(place.x) > 5.0f)
            continue;
        const Clumps::Clump* const a = all.nearest(place);
        const Clumps::Clump* const b = some.nearest(place);
        ASSERT_EQ(a == nullptr, b == nullptr);
        if (a != nullptr) {
            ASSERT_EQ(a->key, b->key);
            ASSERT_EQ(a->centre, b->centre);
            ASSERT_EQ(a->direction(whole), b->direction(part));
        }
    }
}

TEST(Clumps, LookAlongTheGround)
{
    const terrain::GroundMesh mesh = meshes::sphere(64, 3.0);
    const Clumps clumps(mesh, 0.4, 5);
    for (std::uint64_t i = 0; i < 500; ++i)
        if (const Clumps::Clump* found = clumps.nearest(placeOn(mesh, i))) {
            const glm::dvec3 direction = found->direction(mesh);
            ASSERT_NEAR(glm::length(direction), 1.0, 1e-9);
            ASSERT_NEAR(glm::dot(direction, glm::normalize(glm::dvec3(found->centre))), 0.0, 0.08);
        }
}

TEST(ClumpSpacing, GrowsWhereThereWouldBeTooMany)
{
    EXPECT_EQ(clumpSpacing(0.5, 1000.0), 0.5);
    EXPECT_EQ(clumpSpacing(0.0, 1e12), 0.0);
    EXPECT_DOUBLE_EQ(clumpSpacing(0.5, 2e6), 1.0);
}

} // namespace
} // namespace sward::bake
