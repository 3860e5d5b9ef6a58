#include "bake/filter/root_filter.h"
#include "core/random.h"
#include "support/meshes.h"
#include "terrain/heightmap/heightfield.h"
#include "unit/bake/bake_settings.h"
#include "unit/bake/sample/place_trial.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace sward::bake {
namespace {

using tests::plainSettings;
using tests::Trial;
using tests::tryRoots;

// A level ground of `side` metres whose triangles are small.
terrain::GroundMesh meadow(double side, std::uint32_t cells = 16)
{
    return terrain::heightfield({glm::dvec2(side), glm::uvec2(cells)},
                                [](double, double) { return 0.0; });
}

terrain::GroundMesh occluding(terrain::GroundMesh mesh)
{
    std::fill(mesh.bears.begin(), mesh.bears.end(), std::uint8_t(0));
    return mesh;
}

glm::dvec3 placeOf(const terrain::GroundMesh& mesh, const RootSample& root)
{
    return mesh.origin + glm::dvec3(root.position);
}

TEST(BorderFilter, KeepsTheRimOfAnOpenSquareBare)
{
    for (const terrain::GroundMesh& mesh : {meadow(10.0), meshes::square(10.0)}) {
        BakeSettings settings = plainSettings(1.0);
        settings.border = parseSoftMinimum("--border", "1.5");
        const Trial trial = tryRoots(mesh, settings, 100.0);
        for (const RootSample& root : trial.kept)
            ASSERT_LE(std::max(std::fabs(root.position.x), std::fabs(root.position.z)), 3.5001f);
        EXPECT_NEAR(trial.share(), 0.49, 0.01);
        EXPECT_EQ(trial.count(Reject::border), trial.tried - trial.kept.size());
    }
}

TEST(BorderFilter, FadesOverItsSoftEdge)
{
    BakeSettings settings = plainSettings(1.0);
    settings.border = parseSoftMinimum("--border", "1~2");
    const Trial trial = tryRoots(meadow(10.0), settings, 400.0);
    double half = 0.0;
    for (const RootSample& root : trial.kept) {
        const double rim =
            5.0 - double(std::max(std::fabs(root.position.x), std::fabs(root.position.z)));
        ASSERT_GE(rim, 0.999);
        half += rim > 1.5 && rim < 2.5 ? 1.0 : 0.0;
    }
    // Between 1.5 and 2.5 m half of all stay.
    EXPECT_NEAR(half / (400.0 * (49.0 - 25.0)), 0.5, 0.03);
}

TEST(BorderFilter, RejectsNothingOnAClosedMesh)
{
    BakeSettings settings = plainSettings(1.0);
    settings.border = parseSoftMinimum("--border", "5");
    for (const terrain::GroundMesh& mesh : {meshes::sphere(64, 1.0), meshes::cube(2.0)}) {
        const Trial trial = tryRoots(mesh, settings, 200.0);
        EXPECT_EQ(trial.kept.size(), trial.tried);
    }
}

TEST(IslandFilter, RejectsPiecesBelowTheArea)
{
    // A thousand islands in a grid, island i of side 1 + i/1000.
    terrain::GroundMesh mesh = meshes::square(1.0);
    for (int i = 1; i < 1000; ++i)
        append(mesh, meshes::moved(meshes::square(1.0 + i / 1000.0),
                                   {3.0 * (i % 32), 0, 3.0 * (i / 32)}));
    BakeSettings settings = plainSettings(1.0);
    settings.minIsland = 2.25; // of side 1.5: islands 500 to 999
    const Trial trial = tryRoots(mesh, settings, 4.0);
    for (const RootSample& root : trial.kept)
        ASSERT_GE(root.triangle / 2, 500U);
    EXPECT_EQ(trial.count(Reject::border), trial.tried - trial.kept.size());
    double large = 0.0;
    for (std::size_t t = 1000; t < 2000; ++t)
        large += mesh.area(t);
    EXPECT_NEAR(trial.share(), large / meshes::totalArea(mesh), 0.01);
}

TEST(CurvatureFilter, TellsRidgesFromHollows)
{
    // A wave along x: y = cos x, curvature −y″/2 at its crests and troughs.
    const terrain::GroundMesh mesh =
        terrain::heightfield({glm::dvec2(12.566370614359172, 4.0), glm::uvec2(256, 32)},
                             [](double x, double) { return std::cos(x); });
    BakeSettings settings = plainSettings(1.0);
    settings.curvature = {0.2, unbounded, 0.0};
    const Trial ridges = tryRoots(mesh, settings, 100.0);
    ASSERT_GT(ridges.kept.size(), 100U);
    for (const RootSample& root : ridges.kept)
        ASSERT_GT(root.position.y, 0.3f);
    settings.curvature = {-unbounded, -0.2, 0.0};
    const Trial hollows = tryRoots(mesh, settings, 100.0);
    for (const RootSample& root : hollows.kept)
        ASSERT_LT(root.position.y, -0.3f);
    EXPECT_NEAR(double(hollows.kept.size()), double(ridges.kept.size()), 150.0);
    EXPECT_EQ(hollows.count(Reject::curvature), hollows.tried - hollows.kept.size());
}

TEST(CurvatureFilter, IsThatOfTheSideTheRootIsOn)
{
    const terrain::GroundMesh mesh = meshes::sphere(64, 1.0);
    BakeSettings settings = plainSettings(1.0);
    settings.curvature = {0.5, 1.5, 0.0};
    const tests::Place place(mesh, settings);
    for (RootSample root : tests::evenRoots(mesh, 20.0)) {
        Reject reason = Reject::spacing;
        EXPECT_EQ(place.filter().weigh(root, 0.0, reason), 1.0);
        root.candidate |= backSide;
        root.normal = -root.normal;
        EXPECT_EQ(place.filter().weigh(root, 0.0, reason), 0.0);
        EXPECT_EQ(reason, Reject::curvature);
    }
}

TEST(WaterFilter, LetsNothingGrowBelowTheLevel)
{
    const terrain::GroundMesh mesh = terrain::heightfield({glm::dvec2(10.0), glm::uvec2(64U)},
                                                          [](double x, double) { return x; });
    BakeSettings settings = plainSettings(1.0);
    settings.water = parseSoftMinimum("--above-water", "1~2");
    const Trial trial = tryRoots(mesh, settings, 100.0);
    double half = 0.0;
    for (const RootSample& root : trial.kept) {
        ASSERT_GE(root.position.y, 1.0f);
        half += root.position.y > 1.5f && root.position.y < 2.5f ? 1.0 : 0.0;
    }
    EXPECT_EQ(trial.count(Reject::water), trial.tried - trial.kept.size());
    EXPECT_NEAR(half / (100.0 * 10.0 * std::sqrt(2.0)), 0.5, 0.05);
}

TEST(WaterFilter, MeasuresFromAPlanetsCentre)
{
    BakeSettings settings = plainSettings(1.0);
    settings.groundUp.radial = true;
    settings.water = parseSoftMinimum("--above-water", "2.5");
    EXPECT_EQ(tryRoots(meshes::sphere(48, 2.0), settings, 20.0).share(), 0.0);
    EXPECT_EQ(tryRoots(meshes::sphere(48, 3.0), settings, 20.0).share(), 1.0);
}

TEST(Clearance, LeavesTheFootprintOfABoxBareToTheMillimetre)
{
    // The box, 2 m wide, is 1 m above the ground: part of the scene, then an occluder.
    for (const bool bears : {true, false}) {
        terrain::GroundMesh mesh = meshes::boxAbovePlane();
        for (std::size_t t = 2; t < mesh.bears.size(); ++t)
            mesh.bears[t] = bears ? 1 : 0;
        BakeSettings settings = plainSettings(1.0);
        settings.clearance = 2.0;
        const tests::Place place(mesh, settings);
        const RootSample any = tests::evenRoots(mesh, 1.0).front();
        int inside = 0;
        for (std::uint64_t i = 0; i < 20'000; ++i) {
            // Place the roots around the edge.
            const double rim = 1.0 + 0.004 * (uniform(1, i, 0) - 0.5);
            const double along = 2.0 * uniform(1, i, 1) - 1.0;
            RootSample root = any;
            root.position = i % 2 == 0 ? glm::vec3(glm::dvec3(rim, 0, along * rim))
                                       : glm::vec3(glm::dvec3(along * rim, 0, -rim));
            root.normal = glm::vec3(0, 1, 0);
            const bool free = !place.filter().obstacle(root);
            if (rim < 0.999) {
                ASSERT_FALSE(free) << "root " << i;
            }
            if (rim > 1.001) {
                ASSERT_TRUE(free) << "root " << i;
            }
            inside += free ? 0 : 1;
        }
        EXPECT_NEAR(inside, 10'000, 500);

        const Trial trial = tryRoots(mesh, settings, 50.0);
        for (const RootSample& root : trial.kept)
            ASSERT_FALSE(root.position.y == 0.0f && std::fabs(root.position.x) < 0.999f &&
                         std::fabs(root.position.z) < 0.999f);
        EXPECT_EQ(trial.count(Reject::clearance), trial.tried - trial.kept.size());
        // Below the box, and on its lower face if that bears.
        EXPECT_NEAR(double(trial.count(Reject::clearance)), bears ? 400.0 : 200.0, 40.0);
    }
}

TEST(Clearance, IsMeasuredTheWayBladesGrow)
{
    // A roof over half of a ramp: upward it is 2 m away, along the normal less.
    const double slope = 0.7;
    terrain::GroundMesh ramp = terrain::heightfield({glm::dvec2(10.0), glm::uvec2(16U)},
                                                    [&](double x, double) { return slope * x; });
    terrain::GroundMesh roof = terrain::heightfield(
        {glm::dvec2(40.0), glm::uvec2(4U)}, [&](double x, double) { return slope * x + 2.0; });
    append(ramp, occluding(roof));
    BakeSettings settings = plainSettings(1.0);
    settings.clearance = 1.9;
    EXPECT_EQ(tryRoots(ramp, settings, 5.0).share(), 0.0);
    settings.align.vertical = 1.0;
    EXPECT_EQ(tryRoots(ramp, settings, 5.0).share(), 1.0);
}

TEST(SkyFilter, AsksForTheOpenAndForTheShade)
{
    // A wide roof over half of the ground, half a metre above it.
    terrain::GroundMesh mesh = meadow(10.0);
    append(mesh, occluding(meshes::moved(meadow(10.0, 2), {5.0, 0.5, 0.0})));
    BakeSettings settings = plainSettings(1.0);
    settings.exposureRays = 16;
    settings.sky = {0.5, 1.0, 0.0};
    const Trial open = tryRoots(mesh, settings, 20.0);
    ASSERT_GT(open.kept.size(), 500U);
    // Ignore the roof's other sides.
    for (const RootSample& root : open.kept)
        ASSERT_FALSE(root.position.x > 0.5f && root.position.x < 3.0f &&
                     std::fabs(root.position.z) < 3.0f);
    EXPECT_EQ(open.count(Reject::exposure), open.tried - open.kept.size());
    settings.sky = {0.0, 0.5, 0.0};
    const Trial shade = tryRoots(mesh, settings, 20.0);
    for (const RootSample& root : shade.kept)
        ASSERT_GT(root.position.x, -0.5f);
    EXPECT_NEAR(open.share() + shade.share(), 1.0, 0.05) << "few see exactly half";
}

TEST(ExcludedArea, IsTheFootprintOfAMeshAlongGroundUp)
{
    const auto excluded = [](const glm::dvec3& at, double margin) {
        return ExcludedArea{
            "cube", margin,
            std::make_shared<terrain::GroundMesh>(meshes::moved(meshes::cube(2.0), at))};
    };
    const terrain::GroundMesh mesh = meadow(10.0);
    for (const double height : {-50.0, -1.0, 0.0, 0.5, 30.0}) {
        BakeSettings settings = plainSettings(1.0);
        settings.excluded = {excluded({1.0, height, 0.0}, 0.0)};
        const Trial trial = tryRoots(mesh, settings, 50.0);
        for (const RootSample& root : trial.kept)
            ASSERT_FALSE(root.position.x > 0.001f && root.position.x < 1.999f &&
                         std::fabs(root.position.z) < 0.999f);
        EXPECT_EQ(trial.count(Reject::excluded), trial.tried - trial.kept.size());
        EXPECT_NEAR(double(trial.count(Reject::excluded)), 200.0, 30.0) << height;
    }

    // 1 m around it, the corners round: 4 + 4·2 + π m² at the height of the ground.
    BakeSettings settings = plainSettings(1.0);
    settings.excluded = {excluded({1.0, 0.0, 0.0}, 1.0)};
    EXPECT_NEAR(double(tryRoots(mesh, settings, 50.0).count(Reject::excluded)),
                50.0 * (12.0 + 3.14159), 60.0);
    // Far above it the margin does not reach the ground, the footprint still does.
    settings.excluded = {excluded({1.0, 9.0, 0.0}, 1.0)};
    EXPECT_NEAR(double(tryRoots(mesh, settings, 50.0).count(Reject::excluded)), 200.0, 30.0);
}

TEST(ExcludedArea, MayLieFlatOnTheGround)
{
    // A path as a polygon in the ground's own plane.
    const terrain::GroundMesh mesh = meadow(10.0);
    BakeSettings settings = plainSettings(1.0);
    settings.excluded = {{"path", 0.0, std::make_shared<terrain::GroundMesh>(meshes::square(4.0))}};
    const Trial trial = tryRoots(mesh, settings, 50.0);
    EXPECT_NEAR(double(trial.count(Reject::excluded)), 50.0 * 16.0, 60.0);
    for (const RootSample& root : trial.kept)
        ASSERT_FALSE(std::fabs(root.position.x) < 1.999f && std::fabs(root.position.z) < 1.999f);
}

TEST(ExcludedArea, OnAPlanetDoesNotReachThroughIt)
{
    const terrain::GroundMesh mesh = meshes::moved(meshes::sphere(64, 5.0), {100.0, 0.0, 0.0});
    BakeSettings settings = plainSettings(1.0);
    settings.groundUp.radial = true;
    settings.groundUp.centre = {100.0, 0.0, 0.0};
    // 2 m wide, 10 m above the centre: seen from there, 1/10 of a radian.
    settings.excluded = {{"cube", 0.0,
                          std::make_shared<terrain::GroundMesh>(
                              meshes::moved(meshes::cube(2.0), {100.0, 11.0, 0.0}))}};
    const Trial trial = tryRoots(mesh, settings, 50.0);
    EXPECT_GT(trial.count(Reject::excluded), 30U);
    EXPECT_EQ(trial.count(Reject::excluded), trial.tried - trial.kept.size());
    for (const RootSample& root : trial.kept) {
        const glm::dvec3 offset = placeOf(mesh, root) - settings.groundUp.centre;
        const double reach = std::max(std::fabs(offset.x), std::fabs(offset.z)) / offset.y;
        ASSERT_FALSE(offset.y > 0.0 && reach < 0.099);
    }
    std::size_t below = 0;
    for (const RootSample& root : trial.kept)
        below += root.position.y < 0.0f ? 1 : 0;
    EXPECT_NEAR(double(below), 0.5 * double(trial.tried), 0.02 * double(trial.tried));
}

TEST(Occluder, BuriesWhatIsInsideOrUnderIt)
{
    const auto buried = [](const terrain::GroundMesh& occluder) {
        terrain::GroundMesh mesh = meadow(10.0);
        append(mesh, occluding(occluder));
        const Trial trial = tryRoots(mesh, plainSettings(1.0), 50.0);
        EXPECT_EQ(trial.count(Reject::occluder), trial.tried - trial.kept.size());
        return double(trial.count(Reject::occluder));
    };
    // A cube half in the ground; a slab upon it, and one half a millimetre above it.
    EXPECT_NEAR(buried(meshes::cube(2.0)), 200.0, 30.0);
    EXPECT_NEAR(buried(meshes::moved(meshes::cube(2.0), {0, 1.0, 0})), 200.0, 30.0);
    EXPECT_NEAR(buried(meshes::moved(meshes::cube(2.0), {0, 1.0005, 0})), 200.0, 30.0);
    // A rock without a base.
    terrain::GroundMesh dome = meshes::sphere(48, 1.5);
    for (std::size_t t = 0; t < dome.triangles.size(); ++t)
        if (dome.positions[dome.triangles[t].x].y < -0.5f)
            dome.triangles[t] = glm::uvec3(dome.triangles[t].x);
    EXPECT_NEAR(buried(dome), 50.0 * 3.14159 * 2.25, 40.0);
    // None under a box in the air or under a roof of either orientation.
    EXPECT_EQ(buried(meshes::moved(meshes::cube(2.0), {0, 1.5, 0})), 0.0);
    EXPECT_EQ(buried(meshes::square(4.0, 0.5)), 0.0);
    terrain::GroundMesh ceiling = meshes::square(4.0, 0.5);
    for (glm::uvec3& t : ceiling.triangles)
        std::swap(t.y, t.z);
    EXPECT_EQ(buried(ceiling), 0.0);
}

TEST(RootFilter, AnswersOnAPartAsOnTheWhole)
{
    // Hills with a roof, and the part around the centre with its halo.
    terrain::GroundMesh whole =
        terrain::heightfield({glm::dvec2(40.0), glm::uvec2(80U)},
                             [](double x, double z) { return std::sin(x) * std::cos(0.7 * z); });
    append(whole, occluding(meshes::moved(meadow(6.0, 3), {3.0, 2.0, 0.0})));
    BakeSettings settings = plainSettings(1.0);
    settings.slope = {0.0, 25.0, 10.0};
    settings.curvature = {-0.5, 0.5, 0.2};
    settings.border = parseSoftMinimum("--border", "13~6");
    settings.minIsland = 100.0;
    settings.clearance = 1.0;
    settings.exposureRays = 8;
    settings.rayLength = 2.0;
    settings.sky = {0.6, 1.0, 0.3};

    const double half = 4.0;
    const double halo = reachOf(whole, settings, 1.0, 0.0);
    ASSERT_GE(halo, OccluderTest::reach) << "there are occluders";
    terrain::GroundMesh part = whole;
    std::vector<std::uint32_t> vertices(whole.positions.size());
    std::vector<std::uint32_t> triangles;
    for (std::uint32_t v = 0; v < vertices.size(); ++v)
        vertices[v] = v;
    part.triangles.clear();
    part.materialOf.clear();
    part.nodeOf.clear();
    part.bears.clear();
    for (std::uint32_t t = 0; t < whole.triangles.size(); ++t) {
        // Rays of this test reach 2 m, and the roof is in the part.
        const glm::vec3 at = whole.positions[whole.triangles[t].x];
        if (std::max(std::fabs(at.x), std::fabs(at.z)) > float(half) + 4.0f)
            continue;
        triangles.push_back(t);
        part.triangles.push_back(whole.triangles[t]);
        part.materialOf.push_back(0);
        part.nodeOf.push_back(0);
        part.bears.push_back(whole.bears[t]);
        part.sourceOf.push_back(t);
    }
    ASSERT_LT(part.triangles.size(), whole.triangles.size() / 4);

    const terrain::SurfaceFeatures all =
        findFeatures(whole, terrain::analyse(whole), featuresFor(settings));
    Aabb box;
    box.add(glm::vec3(-half, -2.0f, -half));
    box.add(glm::vec3(half, 2.0f, half));
    const terrain::SurfaceFeatures some =
        partOf(all, vertices, triangles, box, settings.border.low);
    const terrain::SurfaceQuery allRays(whole);
    const terrain::SurfaceQuery someRays(part);
    const RootFilter onWhole(whole, settings, &allRays, &all);
    const RootFilter onPart(part, settings, &someRays, &some);

    int kept = 0;
    int tried = 0;
    for (RootSample root : tests::evenRoots(part, 20.0)) {
        if (std::max(std::fabs(root.position.x), std::fabs(root.position.z)) > float(half))
            continue;
        ++tried;
        RootSample same = root;
        same.triangle = part.source(root.triangle);
        Reject reason = Reject::spacing;
        Reject sameReason = Reject::spacing;
        const double weight = onPart.weigh(root, 0.0, reason);
        ASSERT_EQ(weight, onWhole.weigh(same, 0.0, sameReason));
        ASSERT_EQ(reason, sameReason);
        ASSERT_EQ(onPart.obstacle(root), onWhole.obstacle(same));
        kept += weight > 0.0 && !onPart.obstacle(root) ? 1 : 0;
    }
    EXPECT_GT(kept, tried / 10);
    EXPECT_LT(kept, tried - tried / 10);
}

} // namespace
} // namespace sward::bake
