// A field with seeds: blades near the eye are sown while it is drawn.
#include "gpu/frame/likeness.h"
#include "gpu/frame/picture.h"
#include "gpu/frame/sowing/sown_meadow.h"
#include "shaders/shared/culling.h"
#include "support/gpu/gpu_fixture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <set>
#include <vector>

namespace sward::render {
namespace {

constexpr glm::uvec2 sowingSize(160, 100);

class SowingTest : public test::GpuTest {
protected:
    static const test::SownMeadow& meadow()
    {
        static const test::SownMeadow made = test::sownMeadow(60.0, 20, 60.0, 1.0 / 16.0);
        return made;
    }

    static FieldRenderer::Settings rasterised()
    {
        FieldRenderer::Settings settings;
        settings.samples = 1;
        settings.geometry = Geometry::raster;
        settings.rastersForCpu = false;
        settings.largestTarget = sowingSize;
        settings.waitsForDisk = true;
        return settings;
    }

    static Camera lookingFrom(glm::dvec3 eye, glm::dvec3 target)
    {
        Camera camera;
        camera.eye = eye;
        camera.target = target;
        camera.fovY = 40.0f;
        return camera;
    }

    static Camera here() { return lookingFrom({-20.0, 4.0, -20.0}, {0.0, 0.0, -4.0}); }
    static Camera there() { return lookingFrom({22.0, 4.0, 20.0}, {8.0, 0.0, -10.0}); }

    // The leaf-area limit looks at whole subtrees, which are others in a field that is stored.
    static FrameSettings settings()
    {
        FrameSettings result = FrameSettings::of(field::viewOf(meadow().seeded));
        result.maxLeafArea = 0.0f;
        result.exposure = 1.0f;
        return result;
    }
};

TEST_F(SowingTest, DrawsTheFieldThatGrowsFromTheSeeds)
{
    FieldRenderer whole(device(), field::viewOf(meadow().whole), rasterised());
    FieldRenderer sown(device(), field::viewOf(meadow().seeded), rasterised());
    ASSERT_TRUE(sown.isSown());
    EXPECT_FALSE(whole.isSown());
    test::Picture picture(context(), sowingSize);
    const std::vector<std::byte> black(std::size_t(sowingSize.x) * sowingSize.y * 4);
    for (const Camera& camera : {here(), there()}) {
        picture.draw(whole, camera, settings(), 1.0);
        const auto expected = picture.pixels();
        picture.draw(sown, camera, settings(), 1.0);
        // Ranks lie evenly between those of a patch's first and last blade; patches differ.
        EXPECT_NEAR(double(sown.stats().drawn) / double(whole.stats().drawn), 1.0, 0.005);
        EXPECT_GT(sown.stats().drawn, 3000U);
        // The leaf area around a blade is known from the stored sixteenth.
        const test::Likeness alike = test::likeness(picture.pixels(), expected, black, sowingSize);
        EXPECT_GT(alike.psnr, 30.0);
        EXPECT_LT(std::abs(alike.worstTile), 10.0);
        EXPECT_EQ(sown.stats().total, sown.stats().resident + sown.stats().streamedOut);
    }
    // Without seeds it is another picture.
    FieldRenderer::Settings bare = rasterised();
    bare.sownBytes = 0;
    FieldRenderer stored(device(), field::viewOf(meadow().seeded), bare);
    picture.draw(whole, here(), settings(), 1.0);
    const auto expected = picture.pixels();
    picture.draw(stored, here(), settings(), 1.0);
    EXPECT_GT(test::differingPixels(picture.pixels(), expected), sowingSize.x * sowingSize.y / 10);
}

TEST_F(SowingTest, APictureDependsOnThePlaceOfTheEyeAlone)
{
    // Room for a third of what one place wants.
    FieldRenderer::Settings wanted = rasterised();
    wanted.sownBytes = std::uint64_t(1) << 20;
    FieldRenderer sown(device(), field::viewOf(meadow().seeded), wanted);
    test::Picture picture(context(), sowingSize);
    picture.draw(sown, here(), settings(), 1.0);
    const auto first = picture.pixels();
    const std::uint64_t drawn = sown.stats().drawn;
    picture.draw(sown, there(), settings(), 1.0);
    EXPECT_GT(test::differingPixels(picture.pixels(), first), sowingSize.x * sowingSize.y / 4);
    picture.draw(sown, here(), settings(), 1.0);
    EXPECT_EQ(sown.stats().drawn, drawn);
    EXPECT_EQ(test::differingPixels(picture.pixels(), first), 0U);
}

TEST_F(SowingTest, AFlightEndsAtThePictureOfItsPlace)
{
    FieldRenderer whole(device(), field::viewOf(meadow().seeded), rasterised());
    test::Picture picture(context(), sowingSize);
    picture.draw(whole, there(), settings(), 1.0);
    const auto expected = picture.pixels();
    FieldRenderer::Settings wanted = rasterised();
    wanted.waitsForDisk = false;
    wanted.sowThreads = 3;
    wanted.sowsOnDevice = true;
    FieldRenderer sown(device(), field::viewOf(meadow().seeded), wanted);
    // Each frame asks anew for what its workers have in hand.
    for (int i = 0; i < 60; ++i) {
        const double along = i / 59.0;
        const auto between = [&](const glm::dvec3& a, const glm::dvec3& b) {
            return a + along * (b - a);
        };
        picture.draw(
            sown,
            lookingFrom(between(here().eye, there().eye), between(here().target, there().target)),
            settings(), 1.0);
    }
    std::size_t differing = 1;
    for (int i = 0; i < 3000 && differing > 0; ++i) {
        picture.draw(sown, there(), settings(), 1.0);
        differing = test::differingPixels(picture.pixels(), expected);
    }
    EXPECT_EQ(differing, 0U);
}

TEST_F(SowingTest, ArrivesUnitByUnitAndEndsAtTheSamePicture)
{
    FieldRenderer whole(device(), field::viewOf(meadow().seeded), rasterised());
    test::Picture picture(context(), sowingSize);
    picture.draw(whole, here(), settings(), 1.0);
    const auto expected = picture.pixels();
    for (const bool onDevice : {false, true}) {
        const std::uint32_t threads = onDevice ? 1 : 0;
        FieldRenderer::Settings wanted = rasterised();
        wanted.waitsForDisk = false;
        wanted.sowThreads = threads;
        wanted.sowsOnDevice = onDevice;
        FieldRenderer sown(device(), field::viewOf(meadow().seeded), wanted);
        std::uint64_t before = 0;
        std::size_t differing = 1;
        int frames = 0;
        for (; frames < 3000 && differing > 0; ++frames) {
            picture.draw(sown, here(), settings(), 1.0);
            EXPECT_GE(sown.stats().resident, before) << "nothing leaves while there is room";
            before = sown.stats().resident;
            differing = test::differingPixels(picture.pixels(), expected);
        }
        EXPECT_EQ(differing, 0U) << onDevice;
        EXPECT_GT(frames, 2) << onDevice;
    }
}

TEST_F(SowingTest, TellsOfSownBladesByTheKeysAndPlacesThatGrow)
{
    const field::FieldView whole = field::viewOf(meadow().whole);
    // Ribbons have the key of their stalk, and stand on it.
    std::multimap<std::uint64_t, glm::dvec3> grown;
    for (const shared::Patch& cell : whole.patches)
        for (std::uint32_t i = 0; i < cell.bladeCount; ++i)
            grown.emplace(
                whole.idOf(cell.firstBlade + i),
                whole.origin +
                    glm::dvec3(shared::unpackBlade(whole.blades[cell.firstBlade + i], cell).root));
    const auto distanceTo = [&](std::uint64_t id, const glm::dvec3& root) {
        double nearest = std::numeric_limits<double>::infinity();
        for (auto [one, end] = grown.equal_range(id); one != end; ++one)
            nearest = std::min(nearest, glm::distance(one->second, root));
        return nearest;
    };

    FieldRenderer::Settings wanted = rasterised();
    wanted.recordCullResults = true;
    const field::FieldView seeded = field::viewOf(meadow().seeded);
    FieldRenderer sown(device(), seeded, wanted);
    EXPECT_TRUE(sown.sownPatches().empty()) << "nothing is there before the first frame";
    test::Picture picture(context(), sowingSize);
    FrameSettings all = settings();
    all.leavesThinned = false;
    picture.draw(sown, here(), all, 1.0);
    const FrameStats stats = sown.stats();
    EXPECT_EQ(stats.sown + seeded.blades.size(), stats.resident);

    const auto records = sown.dumpBlades(seeded);
    ASSERT_EQ(records.size(), stats.resident);
    std::uint64_t drawn = 0;
    for (std::size_t i = 0; i < records.size(); ++i) {
        // Places of ribbons are those on bent stalks.
        ASSERT_LT(distanceTo(records[i].id, records[i].root), 1.0) << i;
        drawn += records[i].cullResult == shared::cullResultDrawn ? 1U : 0U;
        EXPECT_EQ(records[i].lodWidth > 0.0f, records[i].cullResult == shared::cullResultDrawn)
            << i;
    }
    EXPECT_EQ(drawn, stats.drawn);

    // What picking reads says the same, in the same order.
    const std::vector<SownPatch> patches = sown.sownPatches();
    std::size_t first = seeded.blades.size();
    std::size_t stalks = 0;
    for (std::size_t p = 0; p < patches.size(); ++p) {
        const SownDump dump = sown.dumpSown(seeded, patches[p]);
        ASSERT_EQ(dump.records.size(), dump.blades.size());
        for (std::uint32_t i = 0; i < dump.records.size(); i += 97) {
            const std::size_t index = first + i;
            EXPECT_EQ(dump.records[i].v2, records[index].v2);
            EXPECT_EQ(dump.records[i].cullResult, records[index].cullResult);
            if (i == 97 && p % 16 == 0) {
                EXPECT_EQ(field::bladeId(sown.keyOf(patches[p], i)), records[index].id);
            }
            // The quantisation of roots in the patches of both.
            const glm::dvec3 root = seeded.origin + glm::dvec3(dump.blades[i].root);
            EXPECT_LT(distanceTo(records[index].id, root), 1e-3);
            ++stalks;
        }
        first += dump.records.size();
    }
    EXPECT_EQ(first, records.size());
    EXPECT_GT(stalks, 300U);

    // Layers have the same keys: each of one blade, which stands where the layer sees it.
    std::map<std::uint64_t, std::vector<glm::dvec3>> standing;
    std::set<std::uint64_t> sownIds;
    for (std::size_t i = 0; i < records.size(); ++i) {
        const std::uint64_t id = LayerId::of(records[i].id);
        standing[id].push_back(records[i].root);
        if (i >= seeded.blades.size())
            sownIds.insert(id);
        else
            EXPECT_FALSE(sownIds.contains(id)) << "stored and sown";
    }
    for (const auto& [id, roots] : standing)
        for (const glm::dvec3& root : roots)
            ASSERT_LT(glm::distance(root, roots.front()), 1.0)
                << "only ribbons of a plant share one";
    constexpr LayerMask wantedLayers =
        bitOf(Layer::blade) | bitOf(Layer::plant) | bitOf(Layer::depth);
    picture.drawLayers(sown, here(), all, 1.0, wantedLayers);
    const FrameLayers layers = layersOf(sown.layerWords(seeded), seeded);
    const auto ids = layers.as<std::uint64_t>(Layer::blade);
    const auto plants = layers.as<std::uint64_t>(Layer::plant);
    const auto depths = layers.as<float>(Layer::depth);
    std::size_t ofBlades = 0, ofSown = 0;
    for (std::size_t i = 0; i < ids.size(); ++i) {
        if (ids[i] == 0)
            continue;
        ++ofBlades;
        ASSERT_TRUE(standing.contains(ids[i])) << i;
        ASSERT_TRUE(standing.contains(plants[i])) << i;
        ofSown += sownIds.contains(ids[i]) ? 1U : 0U;
        double nearest = std::numeric_limits<double>::infinity();
        for (const glm::dvec3& root : standing.at(plants[i]))
            nearest = std::min(nearest, std::abs(glm::distance(root, here().eye) - depths[i]));
        EXPECT_LT(nearest, 1.0) << "farther than a blade is high";
    }
    EXPECT_GT(ofBlades, 2000U);
    EXPECT_GT(ofSown, ofBlades * 3 / 4) << "both kinds are seen, and most blades are sown";
    EXPECT_LT(ofSown, ofBlades);

    // A unit that has gone has no blades; the same place has others.
    FieldRenderer::Settings little = wanted;
    little.sownBytes = std::uint64_t(1) << 20;
    FieldRenderer cramped(device(), seeded, little);
    picture.draw(cramped, here(), all, 1.0);
    const std::vector<SownPatch> before = cramped.sownPatches();
    picture.draw(cramped, there(), all, 1.0);
    std::size_t gone = 0;
    for (const SownPatch& patch : before)
        gone += cramped.dumpSown(seeded, patch).records.empty() ? 1U : 0U;
    EXPECT_GT(gone, 0U);
}

} // namespace
} // namespace sward::render
