// Grass in a host's frames: instances, their motion, adding and removing.

#include "gpu/recording/frame_ring.h"
#include "host_picture.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <memory>

namespace sward::render {
namespace {

using test::HostPicture;
using test::lookingFrom;

class GrassTest : public test::GrassTest {};

TEST_F(GrassTest, DrawsTheSameInEitherConventionOfDepth)
{
    Grass grass(context(), oneSlot_);
    grass.add({upload(field_), {}});
    const auto reversed = drawnAlone(grass, 1.0, lookingFrom({2.0, 2.5, 4.0}));
    const std::uint64_t drawn = grass.stats(0, 0).drawn;
    const auto forward = drawnAlone(grass, 1.0, lookingFrom({2.0, 2.5, 4.0}, false));
    EXPECT_EQ(grass.stats(0, 0).drawn, drawn);
    EXPECT_GT(drawn, 1000u);
    EXPECT_LT(test::pixelsApart(reversed, forward, 4), test::hostSize.x * test::hostSize.y / 100);
}

/// Only winds with strength count for the limit.
TEST_F(GrassTest, WindsWithoutStrengthDoNotBlow)
{
    const auto resident = upload(field_);
    const HostView view = lookingFrom({2.0, 2.5, 4.0});
    settings_.winds = {windSource(shared::windTurning)};
    Grass grass(context(), oneSlot_);
    grass.add({resident, {}});
    const auto expected = drawnAlone(grass, 1.0, view);
    WindSource still = windSource(shared::windWave);
    still.source.strength = 0.0f;
    settings_.winds.resize(1 + maxWindSources, still);
    Grass other(context(), oneSlot_);
    other.add({resident, {}});
    EXPECT_EQ(test::pixelsApart(drawnAlone(other, 1.0, view), expected, 1), 0u);
}

TEST_F(GrassTest, LooksTheSameWhereWorldAndCameraAreMovedTogether)
{
    // Rotating, moving and scaling a field, its camera and its world together does not change the
    // picture. Waves belong to the world and stay where they are, so the wind is the same
    // everywhere.
    settings_.winds = {windSource(shared::windTurning)};
    const auto resident = upload(field_);
    const Placement placement{.position = {3e4, -2e3, 5e4},
                              .rotation = glm::angleAxis(1.1, glm::normalize(glm::dvec3(1, 2, -1))),
                              .scale = 2.0};
    const HostView view = lookingFrom({2.0, 2.5, 4.0});
    HostView moved = view;
    moved.worldToClip = view.worldToClip * glm::inverse(placement.toWorld({}));
    FrameSettings movedSettings = settings_;
    const auto turn = [&](glm::vec3 v) { return glm::vec3(placement.rotation * glm::dvec3(v)); };
    movedSettings.sunDirection = turn(settings_.sunDirection);
    movedSettings.environment.gravityDirection = turn(settings_.environment.gravityDirection);
    movedSettings.environment.drawDistance *= 2.0f;
    for (WindSource& wind : movedSettings.winds) {
        wind.source.direction = turn(wind.source.direction);
        wind.source.size *= 2.0f;
        wind.source.speed *= 2.0f;
    }
    const HostCollider ball{.from = {0.3, 0.2, 0.5}, .to = {0.3, 0.2, 0.5}, .radius = 0.4};
    HostCollider movedBall = ball;
    movedBall.from = movedBall.to = glm::dvec3(placement.toWorld({}) * glm::dvec4(ball.from, 1.0));
    movedBall.radius *= 2.0;

    Grass here(context(), oneSlot_);
    Grass there(context(), oneSlot_);
    here.add({resident, {}});
    there.add({resident, placement});
    const HostPicture picture(context(), {});
    const HostPicture* const pictures[]{&picture};
    for (const double time : {1.0, 1.1, 1.2}) {
        drawFrame(here, time, {&view, 1}, pictures, {&ball, 1});
        const auto expected = picture.pixels();
        std::swap(settings_, movedSettings);
        drawFrame(there, time, {&moved, 1}, pictures, {&movedBall, 1});
        std::swap(settings_, movedSettings);
        // Rounding moves an edge by less than a pixel.
        EXPECT_LT(test::pixelsApart(expected, picture.pixels(), 4),
                  test::hostSize.x * test::hostSize.y / 20)
            << time;
        EXPECT_NEAR(double(here.stats(0, 0).drawn), double(there.stats(0, 0).drawn), 10.0);
    }
    EXPECT_GT(here.stats(0, 0).drawn, 1000u);
}

TEST_F(GrassTest, MovesEachBladeOnceForTwoViews)
{
    // Without level of detail, so that both views need the same blades of a patch.
    settings_.levelOfDetail = false;
    settings_.updateRate.everyFrame = 1e6f;
    const auto resident = upload(field_);
    // From either side and near, so that each view sees blades hidden from the other.
    const HostView views[]{lookingFrom({0.3, 0.8, 2.2}), lookingFrom({0.3, 0.8, -2.2})};
    Grass both(context(), oneSlot_);
    Grass first(context(), oneSlot_);
    Grass second(context(), oneSlot_);
    for (Grass* grass : {&both, &first, &second})
        grass->add({resident, {}});
    const HostPicture a(context(), {});
    const HostPicture b(context(), {});
    const HostPicture* const pictures[]{&a, &b};
    for (const double time : {1.0, 1.05, 1.1, 1.4}) {
        drawFrame(both, time, views, pictures);
        EXPECT_LT(test::pixelsApart(a.pixels(), drawnAlone(first, time, views[0]), 4), 10u) << time;
        EXPECT_LT(test::pixelsApart(b.pixels(), drawnAlone(second, time, views[1]), 4), 10u)
            << time;
        const std::uint64_t moved = both.stats(0, 0).simulated;
        EXPECT_LE(moved, field_.blades.size());
        EXPECT_GE(moved, std::max(first.stats(0, 0).simulated, second.stats(0, 0).simulated));
        EXPECT_LT(moved, first.stats(0, 0).simulated + second.stats(0, 0).simulated);
    }
    // At a standstill nothing moves.
    drawFrame(both, 1.4, views, pictures);
    EXPECT_EQ(both.stats(0, 0).simulated, 0u);
}

TEST_F(GrassTest, ComesAndGoesWhileFramesAreInFlight)
{
    // Sixteen instances; each frame removes one, adds one, moves one, and resizes the picture.
    constexpr std::uint32_t slots = 2;
    Grass grass(context(), {.framesInFlight = slots});
    const auto resident = std::make_shared<ResidentField>(context(), field::viewOf(field_));
    const auto placed = [&](int i) {
        return FieldInstance{
            resident, {.position = {(i % 4 - 1.5) * 2.0, 0.0, (i / 4 - 1.5) * 2.0}, .scale = 0.4}};
    };
    std::vector<InstanceId> ids;
    for (int i = 0; i < 16; ++i)
        ids.push_back(grass.add(placed(i)));

    gpu::FrameRing ring(context(), slots);
    std::array<std::unique_ptr<HostPicture>, slots> pictures;
    VkDeviceSize bytesOf16 = 0;
    for (int frame = 0; frame < 12; ++frame) {
        const gpu::FrameRing::Frame recorded = ring.begin();
        const glm::uvec2 extent(test::hostSize.x + 16u * unsigned(frame % 5), test::hostSize.y);
        pictures[recorded.slot] =
            std::make_unique<HostPicture>(context(), HostPicture::Settings{.size = extent});
        HostView view = lookingFrom({1.0, 4.0, 7.0});
        view.size = extent;
        // The first two frames upload the field; it is drawn from the second on.
        resident->recordUpload(recorded.commands, frame == 0   ? resident->stagingBytes() / 2
                                                  : frame == 1 ? VK_WHOLE_SIZE
                                                               : 0);
        EXPECT_EQ(resident->isUploaded(), frame >= 1);
        if (frame == 4)
            resident->releaseStaging();
        if (frame > 4) {
            grass.remove(ids[std::size_t(frame)]);
            ids[std::size_t(frame)] = grass.add(placed(frame));
            grass.move(ids[std::size_t(frame - 1)], placed(frame + 1).placement);
        }
        grass.begin(recorded.slot,
                    {.time = 0.1 * frame, .views = {&view, 1}, .settings = settings_});
        grass.recordUpdate(recorded.commands);
        grass.recordCull(recorded.commands, 0);
        pictures[recorded.slot]->record(recorded.commands, grass, 0);
        ring.submit(recorded);
        if (frame == 4)
            bytesOf16 = grass.deviceBytes();
    }
    ring.finish();
    EXPECT_EQ(grass.stats(0, 1).total, 16 * field_.blades.size());
    EXPECT_GT(pictures[1]->covered(), 1000u);

    // Removed instances are freed, except those of the last frames.
    EXPECT_LE(grass.deviceBytes(), bytesOf16 + slots * bytesOf16 / 16);
    EXPECT_EQ(resident->stagingBytes(), 0u);
    for (const InstanceId id : ids)
        grass.remove(id);
    EXPECT_GT(grass.deviceBytes(), bytesOf16);
    for (const std::uint32_t slot : {0u, 1u})
        grass.begin(slot, {.time = 2.0, .settings = settings_});
    EXPECT_EQ(grass.deviceBytes(), 0u);
}

TEST_F(GrassTest, ListsNoMoreThanItHasRoomFor)
{
    Grass grass(context(), {.framesInFlight = 1, .maxListed = 200});
    grass.add({upload(field_), {}});
    drawnAlone(grass, 1.0, lookingFrom({2.0, 2.5, 4.0}));
    EXPECT_GT(grass.stats(0, 0).drawn, 1000u);
}

} // namespace
} // namespace sward::render
