// A host's fields larger than their budgets: blades that any view sees come gradually.

#include "core/error.h"
#include "field/read.h"
#include "field/write.h"
#include "gpu/recording/frame_ring.h"
#include "host_picture.h"
#include "shaders/shared/passes.h"

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace sward::render {
namespace {

using test::HostPicture;

HostView viewFrom(glm::dvec3 eye, glm::dvec3 target, Geometry geometry = Geometry::tessellation)
{
    return {.worldToClip =
                test::perspective(true) * glm::lookAt(eye, target, glm::dvec3(0.0, 1.0, 0.0)),
            .size = test::hostSize,
            .geometry = geometry};
}

/// Over two opposite corners: a small part of the field is visible from each.
HostView atCorner(Geometry geometry = Geometry::tessellation)
{
    return viewFrom({-27.0, 1.6, -27.0}, {-31.0, 0.3, -31.0}, geometry);
}
HostView atOtherCorner(Geometry geometry = Geometry::tessellation)
{
    return viewFrom({27.0, 1.6, 27.0}, {31.0, 0.3, 31.0}, geometry);
}

/// Along the field; all of it is visible.
HostView along(Geometry geometry = Geometry::tessellation)
{
    return viewFrom({-31.0, 1.0, -31.0}, {20.0, -4.0, 20.0}, geometry);
}

class GrassStreamingTest : public test::GrassTest {
protected:
    static const std::shared_ptr<const field::Field>& ownedMeadow()
    {
        static const auto field =
            std::make_shared<const field::Field>(test::makeField({.blades = 120'000,
                                                                  .extent = 64.0f,
                                                                  .widthLow = 0.03f,
                                                                  .widthHigh = 0.05f,
                                                                  .seed = 26}));
        return field;
    }

    static const field::Field& meadow() { return *ownedMeadow(); }

    static std::shared_ptr<ResidentField> uploaded(const FieldBudget& budget)
    {
        auto lawn = std::make_shared<ResidentField>(context(), ownedMeadow(), budget);
        gpu::submitAndWait(context(),
                           [&](VkCommandBuffer commands) { lawn->recordUpload(commands); });
        lawn->releaseStaging();
        return lawn;
    }

    /// A budget of the patch tree and so large a share of all blades.
    static FieldBudget budgetFor(double share, FieldBudget budget = {})
    {
        const auto blades = double(meadow().blades.size());
        const ResidentField whole(context(), field::viewOf(meadow()));
        const double perBlade = 16.0 + budget.instances * (8.0 + (budget.keepsMotion ? 4.0 : 0.0) +
                                                           16.0 * budget.views);
        // Copies take a few pages for each frame in flight.
        const double tree = double(whole.deviceBytes()) - 16.0 * blades;
        budget.bytes = static_cast<std::uint64_t>(1.3 * tree + 300'000 + share * perBlade * blades);
        budget.waitsForDisk = true;
        return budget;
    }

    static std::vector<Geometry> geometries()
    {
        if (context().features.bufferInt64Atomics)
            return {Geometry::tessellation, Geometry::raster};
        return {Geometry::tessellation};
    }

    /// Draws frames of the same views until nothing changes; returns their number.
    int settle(Grass& grass, std::span<const HostView> views,
               std::span<const HostPicture* const> pictures)
    {
        for (int frame = 1; frame <= 200; ++frame) {
            draw(grass, views, pictures);
            if (grass.streamingStats().isSettled)
                return frame;
        }
        ADD_FAILURE() << "streaming does not come to rest";
        return 0;
    }

    void draw(Grass& grass, std::span<const HostView> views,
              std::span<const HostPicture* const> pictures)
    {
        rasters_ = views[0].geometry == Geometry::raster;
        drawFrame(grass, time_, views, pictures);
        expectCountsAddUp(grass, static_cast<std::uint32_t>(views.size()));
    }

    static void expectCountsAddUp(const Grass& grass, std::uint32_t views)
    {
        for (std::uint32_t view = 0; view < views; ++view) {
            const FrameStats s = grass.stats(view, 0);
            EXPECT_EQ(s.total, s.resident + s.streamedOut);
            EXPECT_EQ(s.resident, s.drawn + s.lod + s.culledPatch + s.culledOrientation +
                                      s.culledFrustum + s.culledDistance + s.culledOcclusion);
        }
        const StreamingStats stats = grass.streamingStats();
        EXPECT_LE(stats.residentPages, stats.places);
        EXPECT_LE(stats.missingPages, stats.wantedPages);
    }

    /// The picture of one view by a field of which all blades are resident.
    std::vector<std::byte> expected(const HostView& view, std::span<const Placement> places)
    {
        if (!whole_)
            whole_ = uploaded({});
        Grass grass(context(), oneSlot_);
        for (const Placement& place : places)
            grass.add({whole_, place});
        const HostPicture picture(context(), {});
        const HostPicture* const pictures[]{&picture};
        draw(grass, {&view, 1}, pictures);
        return picture.pixels();
    }

    static constexpr Placement here{};
    std::shared_ptr<ResidentField> whole_;
    double time_ = 3.0;
};

TEST_F(GrassStreamingTest, DrawsWhatTheWholeFieldDrawsOnceAllThatIsSeenIsThere)
{
    for (const Geometry geometry : geometries()) {
        SCOPED_TRACE(int(geometry));
        const HostView view = atCorner(geometry);
        const auto whole = expected(view, {&here, 1});
        const auto lawn = uploaded(budgetFor(0.25));
        ASSERT_TRUE(lawn->isStreamed());
        Grass grass(context(), oneSlot_);
        grass.add({lawn, here});
        const HostPicture picture(context(), {});
        const HostPicture* const pictures[]{&picture};
        draw(grass, {&view, 1}, pictures);
        EXPECT_GT(test::pixelsApart(picture.pixels(), whole, 0), 100u)
            << "the first picture cannot be whole";
        EXPECT_GT(grass.streamingStats().copiedBytes, 0u);
        EXPECT_GT(settle(grass, {&view, 1}, pictures), 2);
        EXPECT_EQ(test::pixelsApart(picture.pixels(), whole, 0), 0u);
        const StreamingStats stats = grass.streamingStats();
        EXPECT_GT(stats.wantedPages, 0u);
        EXPECT_EQ(stats.missingPages, 0u);
        EXPECT_EQ(stats.copiedBytes, 0u);
        EXPECT_FLOAT_EQ(stats.thinning, 1.0f);
        EXPECT_GT(grass.stats(0, 0).streamedOut, meadow().blades.size() / 2);
    }
}

TEST_F(GrassStreamingTest, FollowsTheCameraAndComesBack)
{
    for (const Geometry geometry : geometries()) {
        SCOPED_TRACE(int(geometry));
        const HostView home = atCorner(geometry);
        const HostView away = atOtherCorner(geometry);
        const auto lawn = uploaded(budgetFor(0.2));
        Grass grass(context(), oneSlot_);
        grass.add({lawn, here});
        const HostPicture picture(context(), {});
        const HostPicture* const pictures[]{&picture};
        for (int i = 0; i < 12; ++i) {
            const double way = i / 11.0;
            const HostView flying =
                viewFrom({-27.0 + 54.0 * way, 2.0, -27.0 + 54.0 * way},
                         {-31.0 + 62.0 * way, 0.0, -20.0 + 51.0 * way}, geometry);
            draw(grass, {&flying, 1}, pictures);
        }
        for (const HostView& view : {away, home, away}) {
            settle(grass, {&view, 1}, pictures);
            EXPECT_EQ(test::pixelsApart(picture.pixels(), expected(view, {&here, 1}), 0), 0u);
        }
    }
}

TEST_F(GrassStreamingTest, HoldsWhatAnyViewSeesOfAnyInstance)
{
    const Placement places[]{{},
                             {.position = {3.0, 0.4, -2.0},
                              .rotation = glm::angleAxis(0.7, glm::dvec3(0.0, 1.0, 0.0)),
                              .scale = 0.8}};
    for (const Geometry geometry : geometries()) {
        SCOPED_TRACE(int(geometry));
        const HostView views[]{atCorner(geometry), atOtherCorner(geometry)};
        const auto lawn = uploaded(budgetFor(0.5, {.instances = 2, .views = 2}));
        ASSERT_TRUE(lawn->isStreamed());
        Grass grass(context(), oneSlot_);
        for (const Placement& place : places)
            grass.add({lawn, place});
        const HostPicture first(context(), {});
        const HostPicture second(context(), {});
        const HostPicture* const pictures[]{&first, &second};
        settle(grass, views, pictures);
        EXPECT_EQ(grass.streamingStats().missingPages, 0u);
        for (const std::size_t view : {0u, 1u})
            EXPECT_EQ(test::pixelsApart(pictures[view]->pixels(), expected(views[view], places), 0),
                      0u)
                << view;
    }
}

TEST_F(GrassStreamingTest, ThinsOutWhatDoesNotFitAndKeepsTheNearest)
{
    settings_.lodThreshold = 0.05f;
    const HostView view = along(geometries().back());
    const auto whole = expected(view, {&here, 1});
    const auto lawn = uploaded(budgetFor(0.25));
    Grass grass(context(), oneSlot_);
    grass.add({lawn, here});
    const HostPicture picture(context(), {});
    const HostPicture* const pictures[]{&picture};
    settle(grass, {&view, 1}, pictures);
    const StreamingStats stats = grass.streamingStats();
    EXPECT_GT(stats.thinning, 1.0f);
    EXPECT_GT(stats.missingPages, 0u);
    EXPECT_GT(stats.residentPages, stats.places / 2);
    EXPECT_GT(grass.stats(0, 0).drawn, 1000u);

    // The nearest ground, at the bottom of the picture, is unchanged; the field covers as much.
    const std::size_t near =
        std::size_t(test::hostSize.x) * 4 * (test::hostSize.y - test::hostSize.y / 8);
    const std::vector<std::byte> pixels = picture.pixels();
    EXPECT_EQ(test::pixelsApart({pixels.begin() + near, pixels.end()},
                                {whole.begin() + near, whole.end()}, 0),
              0u);
    std::size_t covered = 0;
    for (std::size_t i = 3; i < whole.size(); i += 4)
        covered += whole[i] != std::byte{0} ? 1u : 0u;
    EXPECT_NEAR(double(picture.covered()), double(covered), 0.05 * double(test::hostPixels));
}

TEST_F(GrassStreamingTest, KeepsToItsBudgetAndUsesIt)
{
    const Grass::Settings settings{.framesInFlight = 1, .maxViews = 2, .keepsMotion = true};
    const HostView views[]{along(), atCorner()};
    for (const double share : {0.2, 0.5, 2.0}) {
        const FieldBudget budget = budgetFor(
            share, {.instances = 2, .views = 2, .keepsMotion = true, .framesInFlight = 1});
        const auto lawn = uploaded(budget);
        EXPECT_EQ(lawn->isStreamed(), share < 1.0) << share;
        Grass grass(context(), settings);
        grass.add({lawn, here});
        const InstanceId other = grass.add({lawn, {.position = {0.0, 0.0, 40.0}}});
        const HostPicture pictures[]{{context(), {}}, {context(), {}}};
        const HostPicture* const drawn[]{&pictures[0], &pictures[1]};
        for (int frame = 0; frame < 3; ++frame)
            draw(grass, views, drawn);
        const VkDeviceSize held = lawn->deviceBytes() + grass.deviceBytes();
        EXPECT_LE(held, budget.bytes) << share;
        if (lawn->isStreamed()) {
            EXPECT_GT(double(held), 0.8 * double(budget.bytes)) << share;
        }
        // What is removed gives back its states and lists.
        const VkDeviceSize before = grass.deviceBytes();
        grass.remove(other);
        draw(grass, views, drawn);
        EXPECT_LT(grass.deviceBytes(), before / 2 + 100'000);
    }
}

TEST_F(GrassStreamingTest, SurvivesInstancesThatGoAndCome)
{
    const HostView view = atCorner();
    const auto whole = expected(view, {&here, 1});
    const auto lawn = uploaded(budgetFor(0.25));
    auto grass = std::make_unique<Grass>(context(), oneSlot_);
    const HostPicture picture(context(), {});
    const HostPicture* const pictures[]{&picture};
    InstanceId id = grass->add({lawn, here});
    draw(*grass, {&view, 1}, pictures);

    // A frame that is begun and not recorded, one that has lost its instance, and one without any.
    grass->begin(0, {.time = time_, .views = {&view, 1}, .settings = settings_});
    grass->begin(0, {.time = time_, .views = {&view, 1}, .settings = settings_});
    grass->remove(id);
    gpu::submitAndWait(context(), [&](VkCommandBuffer commands) { grass->recordUpdate(commands); });
    draw(*grass, {&view, 1}, pictures);
    EXPECT_EQ(picture.covered(), 0u);

    id = grass->add({lawn, here});
    settle(*grass, {&view, 1}, pictures);
    EXPECT_EQ(test::pixelsApart(picture.pixels(), whole, 0), 0u);
    EXPECT_THROW(Grass(context(), oneSlot_).add({lawn, here}), Error) << "two draw it";

    // Other grass takes it over.
    grass = std::make_unique<Grass>(context(), oneSlot_);
    grass->add({lawn, here});
    settle(*grass, {&view, 1}, pictures);
    EXPECT_EQ(test::pixelsApart(picture.pixels(), whole, 0), 0u);
}

TEST_F(GrassStreamingTest, TellsOfTheMotionThatTheWholeFieldHas)
{
    std::vector<glm::vec2> motions[2];
    for (const Geometry geometry : geometries()) {
        SCOPED_TRACE(int(geometry));
        const HostView view = atCorner(geometry);
        int frames = 0;
        for (const bool isStreamed : {true, false}) {
            const auto lawn =
                uploaded(isStreamed ? budgetFor(0.25, {.keepsMotion = true, .framesInFlight = 1})
                                    : FieldBudget{});
            Grass grass(context(), {.framesInFlight = 1, .keepsMotion = true});
            grass.add({lawn, here});
            const HostPicture picture(context(), {.hasMotion = true});
            const HostPicture* const pictures[]{&picture};
            time_ = 3.0;
            // As many frames for both: far patches move in every third one.
            if (isStreamed)
                frames = settle(grass, {&view, 1}, pictures);
            else
                for (int frame = 0; frame < frames; ++frame)
                    draw(grass, {&view, 1}, pictures);
            time_ = 3.05;
            draw(grass, {&view, 1}, pictures);
            motions[isStreamed ? 1 : 0] = picture.motion();
        }
        std::size_t moved = 0;
        std::size_t apart = 0;
        for (std::size_t i = 0; i < motions[0].size(); ++i) {
            moved += glm::length(motions[0][i]) > 1e-4f ? 1u : 0u;
            apart += glm::length(motions[0][i] - motions[1][i]) > 1e-4f ? 1u : 0u;
        }
        EXPECT_GT(moved, test::hostPixels / 50);
        EXPECT_LE(apart, moved / 100);
    }
}

TEST_F(GrassStreamingTest, FliesWithSeveralFramesInFlight)
{
    constexpr std::uint32_t slots = 3;
    const auto lawn = uploaded(budgetFor(0.2, {.framesInFlight = slots}));
    Grass grass(context(), {.framesInFlight = slots});
    grass.add({lawn, here});
    const HostPicture picture(context(), {});
    gpu::FrameRing ring(context(), slots);
    std::uint64_t copied = 0;
    for (int i = 0; i < 30; ++i) {
        const double way = i / 29.0;
        const HostView view =
            viewFrom({-30.0 + 50.0 * way, 2.0, -30.0 + 20.0 * way},
                     {-10.0 + 40.0 * way, 0.0, 30.0 - 60.0 * way}, geometries().back());
        const gpu::FrameRing::Frame frame = ring.begin();
        grass.begin(frame.slot, {.time = 0.05 * i, .views = {&view, 1}, .settings = settings_});
        grass.recordUpdate(frame.commands);
        grass.recordCull(frame.commands, 0);
        grass.recordRaster(frame.commands, 0);
        picture.record(frame.commands, grass, 0);
        ring.submit(frame);
        copied += grass.streamingStats().copiedBytes;
        EXPECT_LE(grass.streamingStats().residentPages, grass.streamingStats().places);
    }
    ring.finish();
    EXPECT_GT(picture.covered(), test::hostPixels / 10);
    EXPECT_GT(copied, meadow().blades.size() * 16 / 4) << "more than fits has come";
    expectCountsAddUp(grass, 1);
}

TEST_F(GrassStreamingTest, KeepsTheFileItStreamsFrom)
{
    const auto path = std::filesystem::path(testing::TempDir()) / "sward-host-streamed.sward";
    field::writeField(meadow(), path, true);
    std::weak_ptr<const field::MappedField> file;
    {
        auto mapped = std::make_shared<const field::MappedField>(field::readField(path));
        file = mapped;
        const ResidentField whole(context(), mapped);
        EXPECT_FALSE(whole.isStreamed());
        mapped.reset();
        EXPECT_TRUE(file.expired()) << "what is resident as a whole keeps no file";
    }
    {
        auto mapped = std::make_shared<const field::MappedField>(field::readField(path));
        file = mapped;
        const ResidentField part(context(), std::move(mapped), budgetFor(0.25));
        EXPECT_TRUE(part.isStreamed());
        EXPECT_FALSE(file.expired());
    }
    EXPECT_TRUE(file.expired());

    // The line of docs/engine.md, within a budget.
    const auto lawn =
        std::make_shared<ResidentField>(context(), field::readField(path), budgetFor(0.25));
    gpu::submitAndWait(context(), [&](VkCommandBuffer commands) { lawn->recordUpload(commands); });
    lawn->releaseStaging();
    Grass grass(context(), oneSlot_);
    grass.add({lawn, here});
    const HostPicture picture(context(), {});
    const HostView view = atCorner();
    const HostPicture* const pictures[]{&picture};
    settle(grass, {&view, 1}, pictures);
    EXPECT_GT(picture.covered(), test::hostPixels / 10);
}

TEST_F(GrassStreamingTest, SaysWhatItNeeds)
{
    const auto messageWith = [&](std::uint64_t bytes) -> std::string {
        try {
            const ResidentField lawn(context(), ownedMeadow(), {.bytes = bytes});
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::runtime);
            return error.what();
        }
        return "";
    };
    EXPECT_NE(messageWith(100'000).find("at least"), std::string::npos);
    const auto lawn = uploaded(budgetFor(0.25));
    Grass grass(context(), {.framesInFlight = 3});
    EXPECT_THROW(grass.add({lawn, here}), Error) << "the budget is for two frames in flight";
}

/// In a flight the frames that bring pages begin with few: no frame takes much longer than those
/// before. After a cut a frame brings all that it may.
TEST_F(GrassStreamingTest, BringsPagesOfAFlightLittleByLittle)
{
    const HostPicture picture(context(), {});
    const HostPicture* const pictures[]{&picture};
    settings_.winds.clear();
    // An eighth of the pages that fit may come in a frame: a few.
    const auto lawn = uploaded(budgetFor(0.4, {.framesInFlight = 1}));
    Grass grass(context(), oneSlot_);
    grass.add({lawn, {}});
    const auto at = [](double along) {
        const glm::dvec3 eye(-27.0 + along, 1.6, -27.0 + along);
        return viewFrom(eye, eye + glm::dvec3(12.0, -4.0, 12.0));
    };
    const auto pagesOf = [&](const HostView& view) {
        draw(grass, {&view, 1}, pictures);
        return static_cast<int>(grass.streamingStats().copiedBytes / (16 * 1024));
    };
    const HostView start = at(0.0);
    settle(grass, {&start, 1}, pictures);
    int before = 0;
    int sum = 0;
    for (int step = 1; step <= 60; ++step) {
        const int pages = pagesOf(at(0.6 * step));
        EXPECT_LE(pages, before + 1) << "step " << step;
        before = pages;
        sum += pages;
    }
    EXPECT_GT(sum, 3) << "other pages are seen";
    EXPECT_GT(pagesOf(atOtherCorner()), 1) << "after a cut";
}

/// The visibility history is by resident id: it has room for all blades of the field, not only for
/// those in memory.
TEST_F(GrassStreamingTest, TwoPassesHaveAHistoryOfAllBlades)
{
    if (!context().features.bufferInt64Atomics)
        GTEST_SKIP() << "the device has no 64-bit atomics";
    const HostPicture pictures[]{HostPicture(context(), {}), HostPicture(context(), {})};
    const HostView view = atCorner(Geometry::raster);
    settings_.winds.clear();
    rasters_ = true;
    VkDeviceSize bytes[2]{};
    for (const int passes : {1, 2}) {
        settings_.cullMask =
            passes == 2 ? settings_.cullMask | cullOcclusion : settings_.cullMask & ~cullOcclusion;
        Grass grass(context(), {.framesInFlight = 1, .rastersForCpu = false});
        grass.add({uploaded(budgetFor(0.4, {.framesInFlight = 1})), {}});
        const HostPicture* const shown[]{&pictures[passes - 1]};
        settle(grass, {&view, 1}, shown);
        draw(grass, {&view, 1}, shown);
        bytes[passes - 1] = grass.deviceBytes();
    }
    EXPECT_EQ(test::pixelsApart(pictures[0].pixels(), pictures[1].pixels(), 1), 0u);
    // Four bits a blade, and the shading cache. The depth pyramid adds its cells.
    const VkDeviceSize expected =
        meadow().blades.size() / 2 +
        (shared::cachePlaceCount + 12 * shared::maxCachedBlades) * sizeof(std::uint32_t);
    EXPECT_GE(bytes[1] - bytes[0], expected);
    EXPECT_LT(bytes[1] - bytes[0], expected + 8 * test::hostPixels);
}

} // namespace
} // namespace sward::render
