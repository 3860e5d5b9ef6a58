// Edits of a host's fields: Grass::edit().

#include "core/error.h"
#include "gpu/recording/commands.h"
#include "gpu/recording/frame_ring.h"
#include "host_picture.h"
#include "support/fields/edited_meadow.h"

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace sward::render {
namespace {

using test::EditedMeadow;
using test::HostPicture;
using testing::HasSubstr;

constexpr EditedMeadow::Cell middle{0, 0, 0};

/// Over the cell in the middle and its neighbours.
HostView overMeadow(Geometry geometry)
{
    return {.worldToClip =
                test::perspective(true) *
                glm::lookAt(glm::dvec3(-6.0, 7.0, -8.0), {14.0, 0.0, 16.0}, {0.0, 1.0, 0.0}),
            .size = test::hostSize,
            .geometry = geometry};
}

/// The other way, from above.
HostView fromAbove(Geometry geometry)
{
    HostView view = overMeadow(geometry);
    view.worldToClip = test::perspective(true) * glm::lookAt(glm::dvec3(10.0, 30.0, 40.0),
                                                             {12.0, 0.0, 10.0}, {0.0, 1.0, 0.0});
    return view;
}

std::uint64_t sumOf(const FrameStats& s)
{
    return s.drawn + s.lod + s.culledPatch + s.culledOrientation + s.culledFrustum +
           s.culledDistance + s.culledOcclusion;
}

class GrassEditTest : public test::GrassTest, public testing::WithParamInterface<Geometry> {
protected:
    GrassEditTest()
    {
        meadow_.changes();
        // Nothing depends on the field as a whole.
        settings_ = FrameSettings::of(field::viewOf(test::emptyField()));
        winds_ = settings_.winds;
        settings_.winds.clear();
        settings_.levelOfDetail = false;
        settings_.thatch = 0.0f;
        settings_.updateRate = {.everyFrame = 1e6f, .everyThird = 1e6f};
        rasters_ = GetParam() == Geometry::raster;
    }

    static std::shared_ptr<ResidentField> editable(const field::Field& field,
                                                   const FieldBudget& budget = {.isEditable = true})
    {
        auto lawn = std::make_shared<ResidentField>(context(), field::Field(field), budget);
        gpu::submitAndWait(context(),
                           [&](VkCommandBuffer commands) { lawn->recordUpload(commands); });
        lawn->releaseStaging();
        return lawn;
    }

    /// The meadow with so many blades in its middle.
    std::shared_ptr<ResidentField> sown(std::size_t blades)
    {
        meadow_.sow(middle, blades);
        meadow_.changes();
        return editable(meadow_.whole());
    }

    /// The meadow as it is, drawn by grass that has never been edited.
    std::vector<std::byte> drawnAnew(std::span<const Placement> placements, const HostView& view,
                                     std::initializer_list<double> times) const
    {
        const field::Field whole = meadow_.whole();
        const auto lawn = upload(whole);
        Grass grass(context(), oneSlot_);
        for (const Placement& placement : placements)
            grass.add({lawn, placement});
        const HostPicture picture(context(), {});
        const HostPicture* const pictures[]{&picture};
        for (const double time : times)
            drawFrame(grass, time, {&view, 1}, pictures);
        return picture.pixels();
    }

    EditedMeadow meadow_{200.0f};
    decltype(FrameSettings::winds) winds_;
    const HostView view_ = overMeadow(GetParam());
    const HostPicture picture_{context(), {}};
    const std::array<const HostPicture*, 1> pictures_{&picture_};
};

// Two instances of one field, seen by two views.
TEST_P(GrassEditTest, DrawsTheFieldJoinedAnewInEveryInstance)
{
    meadow_.sow(middle, 2000);
    meadow_.sow({-1, 0, 0}, 500);
    meadow_.changes();
    const auto lawn = editable(meadow_.whole());
    const std::array<Placement, 2> placements{
        Placement{},
        {.position = {6.0, 0.0, 40.0},
         .rotation = glm::angleAxis(0.7, glm::dvec3(0.0, 1.0, 0.0)),
         .scale = 0.5}};
    Grass grass(context(), oneSlot_);
    for (const Placement& placement : placements)
        grass.add({lawn, placement});
    const std::array<HostView, 2> views{view_, fromAbove(GetParam())};
    const HostPicture second(context(), {});
    const std::array<const HostPicture*, 2> pictures{&picture_, &second};
    double time = 10.0;
    drawFrame(grass, time, views, pictures);
    auto before = picture_.pixels();
    auto secondBefore = second.pixels();
    int seen = 0;
    for (std::uint64_t step = 0; step < 4; ++step) {
        SCOPED_TRACE("step " + std::to_string(step));
        meadow_.sowSome(step);
        grass.edit(*lawn, meadow_.changes());
        // Two edits between frames, now and then.
        if (step % 3 == 0) {
            meadow_.sowSome(step + 100);
            grass.edit(*lawn, meadow_.changes());
        }
        time += 0.1;
        drawFrame(grass, time, views, pictures);
        const std::size_t changed = test::pixelsApart(picture_.pixels(), before, 2) +
                                    test::pixelsApart(second.pixels(), secondBefore, 2);
        seen += changed > 200 ? 1 : 0;
        // Both come to rest.
        time += 60.0;
        drawFrame(grass, time, views, pictures);
        before = picture_.pixels();
        secondBefore = second.pixels();
        EXPECT_LE(
            test::pixelsApart(before, drawnAnew(placements, views[0], {time - 60.0, time}), 2),
            20u);
        EXPECT_LE(test::pixelsApart(secondBefore,
                                    drawnAnew(placements, views[1], {time - 60.0, time}), 2),
                  20u);
        for (std::uint32_t view = 0; view < 2; ++view) {
            EXPECT_EQ(grass.stats(view, 0).total, 2 * meadow_.bladeCount());
            EXPECT_EQ(sumOf(grass.stats(view, 0)), 2 * meadow_.bladeCount());
        }
    }
    EXPECT_GT(seen, 1);
}

// No time passes between both pictures. Every blade has another place in memory afterwards.
TEST_P(GrassEditTest, KeepsTheStatesOfUnchangedBlades)
{
    const auto lawn = sown(8000);
    Grass grass(context(), oneSlot_);
    grass.add({lawn, {}});
    settings_.winds = winds_;
    double time = 1.0;
    for (int i = 0; i < 20; ++i, time += 0.05)
        drawFrame(grass, time, {&view_, 1}, pictures_);
    const auto before = picture_.pixels();
    time -= 0.05;
    meadow_.sow(middle, 8000);
    meadow_.sow({-3, 0, 40}, 700);
    grass.edit(*lawn, meadow_.changes());
    drawFrame(grass, time, {&view_, 1}, pictures_);
    EXPECT_LE(test::pixelsApart(picture_.pixels(), before, 2), 20u);
    EXPECT_EQ(grass.stats(0, 0).total, 8700u);
    // Blades without their states would stand otherwise.
    EXPECT_GT(test::pixelsApart(drawnAnew({{Placement{}}}, view_, {time}), before, 2), 200u);
}

TEST_P(GrassEditTest, BecomesBareAndGrowsAgain)
{
    const auto lawn = editable(meadow_.whole());
    Grass grass(context(), oneSlot_);
    grass.add({lawn, {}});
    drawFrame(grass, 0.0, {&view_, 1}, pictures_);
    EXPECT_EQ(picture_.covered(), 0u);
    for (int round = 1; round < 4; ++round) {
        meadow_.sow(middle, 3000);
        grass.edit(*lawn, meadow_.changes());
        drawFrame(grass, round, {&view_, 1}, pictures_);
        EXPECT_EQ(grass.stats(0, 0).total, 3000u);
        EXPECT_GT(grass.stats(0, 0).drawn, 300u);
        EXPECT_GT(picture_.covered(), 600u);
        meadow_.sow(middle, 0);
        grass.edit(*lawn, meadow_.changes());
        drawFrame(grass, round + 0.5, {&view_, 1}, pictures_);
        EXPECT_EQ(grass.stats(0, 0).total, 0u);
        EXPECT_EQ(picture_.covered(), 0u);
    }
}

// New blades rise in no time, which is no motion.
TEST_P(GrassEditTest, GivesNewBladesNoMotion)
{
    const auto lawn = sown(1500);
    Grass grass(context(), {.framesInFlight = 1, .keepsMotion = true});
    grass.add({lawn, {}});
    const HostPicture picture(context(), {.hasMotion = true});
    const std::array<const HostPicture*, 1> pictures{&picture};
    for (const double time : {0.0, 30.0, 60.0})
        drawFrame(grass, time, {&view_, 1}, pictures);
    const std::size_t before = picture.covered();
    meadow_.sow(middle, 6000);
    grass.edit(*lawn, meadow_.changes());
    drawFrame(grass, 60.02, {&view_, 1}, pictures);
    EXPECT_GT(picture.covered(), 2 * before);
    float most = 0.0f;
    for (const glm::vec2 motion : picture.motion())
        most = std::max(most, glm::length(motion));
    EXPECT_LT(most, 1e-3f);
}

// An edit between begin() and the end of a frame's recording belongs to the next one.
TEST_P(GrassEditTest, LeavesTheFrameThatIsRecordedAlone)
{
    const auto lawn = sown(1500);
    Grass grass(context(), oneSlot_);
    grass.add({lawn, {}});
    drawFrame(grass, 1.0, {&view_, 1}, pictures_);
    const auto before = picture_.pixels();
    const auto record = [&](const std::function<void()>& between) {
        grass.begin(0, {.time = 1.0, .views = {&view_, 1}, .settings = settings_});
        gpu::submitAndWait(context(), [&](VkCommandBuffer commands) {
            grass.recordUpdate(commands);
            between();
            grass.recordCull(commands, 0);
            if (rasters_)
                grass.recordRaster(commands, 0);
            picture_.record(commands, grass, 0);
        });
    };
    meadow_.sow(middle, 1500, 0.3);
    meadow_.sow({1, 0, 1}, 9000);
    const field::Delta delta = meadow_.changes();
    record([&] { grass.edit(*lawn, delta); });
    EXPECT_EQ(test::pixelsApart(picture_.pixels(), before, 0), 0u);
    EXPECT_EQ(grass.stats(0, 0).total, 1500u);
    record([] {});
    EXPECT_GT(test::pixelsApart(picture_.pixels(), before, 2), 200u);
    EXPECT_EQ(grass.stats(0, 0).total, meadow_.bladeCount());
}

// Edits wait for the upload, and for an instance.
TEST_P(GrassEditTest, WaitsUntilTheFieldIsDrawn)
{
    meadow_.sow(middle, 1500);
    meadow_.changes();
    const auto lawn = std::make_shared<ResidentField>(context(), meadow_.whole(),
                                                      FieldBudget{.isEditable = true});
    Grass grass(context(), oneSlot_);
    meadow_.sow(middle, 4000);
    grass.edit(*lawn, meadow_.changes());
    drawFrame(grass, 1.0, {&view_, 1}, pictures_);
    const InstanceId id = grass.add({lawn, {}});
    drawFrame(grass, 2.0, {&view_, 1}, pictures_);
    EXPECT_EQ(picture_.covered(), 0u);
    gpu::submitAndWait(context(), [&](VkCommandBuffer commands) { lawn->recordUpload(commands); });
    lawn->releaseStaging();
    drawFrame(grass, 3.0, {&view_, 1}, pictures_);
    EXPECT_LE(test::pixelsApart(picture_.pixels(), drawnAnew({{Placement{}}}, view_, {3.0}), 2),
              20u);
    grass.remove(id);
    meadow_.sow(middle, 2000, 0.7);
    grass.edit(*lawn, meadow_.changes());
    drawFrame(grass, 4.0, {&view_, 1}, pictures_);
    EXPECT_EQ(picture_.covered(), 0u);
    grass.add({lawn, {}});
    drawFrame(grass, 5.0, {&view_, 1}, pictures_);
    EXPECT_LE(test::pixelsApart(picture_.pixels(), drawnAnew({{Placement{}}}, view_, {5.0}), 2),
              20u);
}

// Buffers grow, frames are begun and not recorded, instances come and go.
TEST_P(GrassEditTest, GoesOnWithSeveralFramesInFlight)
{
    meadow_.sow(middle, 1000);
    meadow_.changes();
    constexpr std::uint32_t slots = 3;
    const auto lawn = editable(meadow_.whole(), {.framesInFlight = slots, .isEditable = true});
    Grass grass(context(), {.framesInFlight = slots});
    const InstanceId first = grass.add({lawn, {}});
    InstanceId second{};
    gpu::FrameRing ring(context(), slots);
    for (std::uint64_t i = 0; i < 40; ++i) {
        const gpu::FrameRing::Frame frame = ring.begin();
        if (i >= slots && i != 12 + slots) {
            const FrameStats stats = grass.stats(0, frame.slot);
            EXPECT_LE(sumOf(stats), stats.total) << "frame " << i;
        }
        if (i % 2 == 0) {
            meadow_.sowSome(i);
            if (i == 20)
                meadow_.sow({1, 0, 1}, 20'000);
            grass.edit(*lawn, meadow_.changes());
        }
        if (i == 8)
            second = grass.add({lawn, {.position = {0.0, 0.0, 30.0}}});
        grass.begin(frame.slot,
                    {.time = 0.02 * double(i), .views = {&view_, 1}, .settings = settings_});
        if (i == 20)
            grass.remove(second);
        if (i != 12) {
            grass.recordUpdate(frame.commands);
            grass.recordCull(frame.commands, 0);
            if (rasters_)
                grass.recordRaster(frame.commands, 0);
            picture_.record(frame.commands, grass, 0);
        }
        ring.submit(frame);
    }
    ring.finish();
    drawFrame(grass, 100.0, {&view_, 1}, pictures_);
    EXPECT_LE(
        test::pixelsApart(picture_.pixels(), drawnAnew({{Placement{}}}, view_, {40.0, 100.0}), 2),
        20u);
    grass.remove(first);
}

TEST_P(GrassEditTest, ListsNoMoreBladesThanItMay)
{
    const auto lawn = sown(500);
    Grass grass(context(), {.framesInFlight = 1, .maxListed = 1000});
    grass.add({lawn, {}});
    const std::array<HostView, 1> views{fromAbove(GetParam())};
    drawFrame(grass, 1.0, views, pictures_);
    const std::size_t few = picture_.covered();
    for (int i = 0; i < 3; ++i) {
        meadow_.sow(middle, 12'000);
        meadow_.sow({0, 0, std::int64_t(i) + 1}, 9000);
        grass.edit(*lawn, meadow_.changes());
        drawFrame(grass, 2.0 + i, views, pictures_);
        EXPECT_GT(picture_.covered(), few);
        EXPECT_EQ(grass.stats(0, 0).total, meadow_.bladeCount());
    }
}

INSTANTIATE_TEST_SUITE_P(EitherWay, GrassEditTest,
                         testing::Values(Geometry::raster, Geometry::tessellation),
                         [](const testing::TestParamInfo<Geometry>& way) {
                             return std::string(way.param == Geometry::raster ? "raster"
                                                                              : "tessellation");
                         });

class GrassEditRefusalTest : public test::GrassTest {
protected:
    GrassEditRefusalTest()
    {
        meadow_.sow(middle, 2000);
        delta_ = meadow_.changes();
        field_ = meadow_.whole();
    }

    std::shared_ptr<ResidentField> made(const FieldBudget& budget) const
    {
        return std::make_shared<ResidentField>(context(), field::Field(field_), budget);
    }

    static void expectError(ErrorKind kind, const std::string& words,
                            const std::function<void()>& work)
    {
        try {
            work();
            ADD_FAILURE() << "no error about: " << words;
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), kind) << error.what();
            EXPECT_THAT(error.what(), HasSubstr(words));
        }
    }

    EditedMeadow meadow_{200.0f};
    field::Delta delta_;
};

TEST_F(GrassEditRefusalTest, NamesWhatCannotBeEdited)
{
    Grass grass(context(), oneSlot_);
    Grass other(context(), oneSlot_);
    const auto lawn = made({.isEditable = true});
    grass.add({lawn, {}});
    expectError(ErrorKind::usage, "isEditable", [&] { grass.edit(*made({}), delta_); });
    expectError(ErrorKind::usage, "other grass", [&] { other.edit(*lawn, delta_); });
    expectError(ErrorKind::usage, "other grass", [&] { other.add({lawn, {}}); });
    expectError(ErrorKind::usage, "1 frames in flight; the grass has 2", [&] {
        Grass(context(), {.framesInFlight = 2})
            .edit(*made({.framesInFlight = 1, .isEditable = true}), delta_);
    });
    field::Delta elsewhere = delta_;
    elsewhere.origin.y = 1.0;
    expectError(ErrorKind::input, "origin", [&] { grass.edit(*lawn, elsewhere); });
    expectError(ErrorKind::runtime, "cannot be edited",
                [&] { made({.bytes = 30'000, .isEditable = true}); });
    field_.keys.clear();
    expectError(ErrorKind::usage, "keys", [&] { made({.isEditable = true}); });
}

} // namespace
} // namespace sward::render
