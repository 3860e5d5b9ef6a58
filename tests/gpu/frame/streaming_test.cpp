// Fields larger than their memory budget: visible blades are loaded gradually.

#include "core/error.h"
#include "gpu/memory/image_use.h"
#include "gpu/memory/readback.h"
#include "gpu/recording/commands.h"
#include "gpu/recording/frame_ring.h"
#include "picture.h"
#include "support/fields/fields.h"
#include "support/gpu/gpu_fixture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <utility>

namespace sward::render {
namespace {

constexpr std::uint64_t streamingSeed = 26;
constexpr glm::uvec2 streamingSize(160, 100);
FieldRenderer::Settings rasterised()
{
    FieldRenderer::Settings settings;
    settings.samples = 1;
    settings.geometry = Geometry::raster;
    settings.rastersForCpu = false;
    settings.largestTarget = streamingSize;
    settings.waitsForDisk = true;
    return settings;
}

Camera lookingFrom(glm::dvec3 eye, glm::dvec3 target)
{
    Camera camera;
    camera.eye = eye;
    camera.target = target;
    camera.fovY = 40.0f;
    return camera;
}

/// Camera over a corner; a small part of the field is visible.
Camera lookingAtCorner()
{
    return lookingFrom({-27.0, 1.6, -27.0}, {-31.0, 0.3, -31.0});
}

/// Camera along the field; all of it is visible.
Camera lookingAlong()
{
    return lookingFrom({-31.0, 1.0, -31.0}, {20.0, -4.0, 20.0});
}

class StreamingTest : public test::GpuTest {
protected:
    static const field::Field& meadow()
    {
        static const field::Field field = test::makeField({.blades = 120'000,
                                                           .extent = 64.0f,
                                                           .widthLow = 0.03f,
                                                           .widthHigh = 0.05f,
                                                           .seed = streamingSeed});
        return field;
    }

    static FieldRenderer streamed(double share)
    {
        FieldRenderer::Settings wanted = rasterised();
        wanted.deviceBytes = budgetWith(share, wanted);
        return {device(), field::viewOf(meadow()), wanted};
    }

    static FrameSettings settings() { return FrameSettings::of(field::viewOf(meadow())); }

    /// A budget for a share of the blades: each takes 36 bytes if all are resident and none has met
    /// a collider, and 32 with its part of the upload buffers.
    static std::uint64_t budgetWith(double share, FieldRenderer::Settings wanted)
    {
        wanted.deviceBytes = std::uint64_t(1) << 40;
        const FieldRenderer whole(device(), field::viewOf(meadow()), wanted);
        const auto blades = static_cast<double>(meadow().blades.size());
        return whole.deviceBytes() + 100'000 -
               static_cast<std::uint64_t>((36.0 - 32.0 * share) * blades);
    }

    static void expectCountsAddUp(const FrameStats& stats)
    {
        EXPECT_EQ(stats.total, meadow().blades.size());
        EXPECT_EQ(stats.total, stats.resident + stats.streamedOut);
        EXPECT_EQ(test::sumOf(stats), stats.resident);
    }
};

TEST_F(StreamingTest, DrawsWhatTheWholeFieldDrawsOnceAllThatIsSeenIsThere)
{
    FieldRenderer whole(device(), field::viewOf(meadow()), rasterised());
    FieldRenderer part = streamed(0.33);
    test::Picture picture(context(), streamingSize);
    picture.draw(whole, lookingAtCorner(), settings(), 3.0);
    const auto expected = picture.pixels();

    std::uint64_t before = 0;
    std::size_t differing = 0;
    for (int frame = 0; frame < 60; ++frame) {
        picture.draw(part, lookingAtCorner(), settings(), 3.0);
        const FrameStats stats = part.stats();
        expectCountsAddUp(stats);
        EXPECT_GE(stats.resident, before) << "nothing leaves while there is room";
        before = stats.resident;
        if (frame == 0)
            differing = test::differingPixels(picture.pixels(), expected);
    }
    EXPECT_GT(differing, 100u) << "the first picture cannot be whole";
    EXPECT_GT(part.stats().streamedOut, meadow().blades.size() / 3);
    EXPECT_EQ(test::differingPixels(picture.pixels(), expected), 0u);
    EXPECT_EQ(part.stats().drawn, whole.stats().drawn);
}

TEST_F(StreamingTest, KeepsToItsBudgetAndUsesIt)
{
    for (const double share : {0.3, 0.5, 0.7, 2.0}) {
        FieldRenderer::Settings wanted = rasterised();
        wanted.deviceBytes = budgetWith(share, wanted);
        FieldRenderer renderer(device(), field::viewOf(meadow()), wanted);
        test::Picture picture(context(), streamingSize);
        picture.draw(renderer, lookingAlong(), settings(), 0.0);
        EXPECT_LE(renderer.deviceBytes(), wanted.deviceBytes) << share;
        EXPECT_EQ(renderer.isStreamed(), share < 1.0);
        if (renderer.isStreamed()) {
            EXPECT_GT(renderer.deviceBytes() + 400'000, wanted.deviceBytes) << share;
            EXPECT_GT(renderer.stats().streamedOut, 0u);
        } else {
            EXPECT_EQ(renderer.stats().streamedOut, 0u);
        }
        // A collider may bend blades that are resident, and casts its shadow within the budget.
        FrameSettings pressed = settings();
        pressed.colliders = {{.from = {}, .to = {}, .radius = 0.5, .path = {}}};
        if (renderer.isStreamed()) {
            picture.draw(renderer, lookingAlong(), pressed, 0.1);
            EXPECT_LE(renderer.deviceBytes(), wanted.deviceBytes) << share;
        }
    }
}

TEST_F(StreamingTest, ThinsOutWhatDoesNotFitAndKeepsTheNearest)
{
    FieldRenderer whole(device(), field::viewOf(meadow()), rasterised());
    FieldRenderer part = streamed(0.25);
    test::Picture picture(context(), streamingSize);
    FrameSettings fine = settings();
    fine.lodThreshold = 0.05f;
    picture.draw(whole, lookingAlong(), fine, 0.0);
    const auto expected = picture.pixels();
    const FrameStats all = whole.stats();
    ASSERT_GT(all.resident - all.culledPatch - all.lod, meadow().blades.size() / 3)
        << "more is seen than fits";

    gpu::FrameRing ring(context(), 1);
    bool settled = false;
    int frames = 0;
    for (; !settled && frames < 500; ++frames) {
        const gpu::FrameRing::Frame frame = ring.begin();
        settled = part.recordStreaming(frame.commands, streamingSize, lookingAlong(), fine, 0.0);
        ring.submit(frame);
        ring.finish();
    }
    EXPECT_TRUE(settled);
    EXPECT_GT(frames, 2);
    picture.draw(part, lookingAlong(), fine, 0.0);
    const auto first = picture.pixels();
    const FrameStats stats = part.stats();
    expectCountsAddUp(stats);
    EXPECT_GT(stats.drawn, 1000u);
    EXPECT_LT(stats.drawn, whole.stats().drawn);
    // The state is stable: nothing is loaded or evicted any more.
    for (int frame = 0; frame < 5; ++frame) {
        picture.draw(part, lookingAlong(), fine, 0.0);
        EXPECT_EQ(part.stats().resident, stats.resident);
    }
    EXPECT_EQ(test::differingPixels(picture.pixels(), first), 0u);

    // The nearest ground, at the bottom of the picture, is unchanged. The density is equal: the
    // mean of the picture stays.
    const std::size_t near =
        std::size_t(streamingSize.x) * 4 * (streamingSize.y - streamingSize.y / 8);
    const std::vector<std::byte> nearExpected(expected.begin() + near, expected.end());
    const std::vector<std::byte> nearPixels(first.begin() + near, first.end());
    EXPECT_EQ(test::differingPixels(nearPixels, nearExpected), 0u);
    double sum[2] = {0.0, 0.0};
    for (std::size_t i = 0; i < first.size(); ++i) {
        sum[0] += std::to_integer<int>(expected[i]);
        sum[1] += std::to_integer<int>(first[i]);
    }
    EXPECT_NEAR(sum[1] / sum[0], 1.0, 0.03);
}

/// Draws frames with some of them in flight; returns the last picture. `cameraAt` gets the share of
/// the path, `step` [s].
template <typename CameraAt>
std::vector<std::byte> play(const gpu::DeviceContext& context, FieldRenderer& renderer,
                            std::uint32_t framesInFlight, double step, const CameraAt& cameraAt)
{
    constexpr int frames = 40;
    const FrameSettings settings = FrameSettings::of(field::viewOf(test::emptyField()));
    gpu::FrameRing ring(context, framesInFlight);
    const gpu::Image target(context, {.name = "picture",
                                      .format = VK_FORMAT_R8G8B8A8_SRGB,
                                      .extent = {streamingSize.x, streamingSize.y},
                                      .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT |
                                               VK_IMAGE_USAGE_TRANSFER_SRC_BIT |
                                               VK_IMAGE_USAGE_TRANSFER_DST_BIT});
    for (int i = 0; i < frames; ++i) {
        const gpu::FrameRing::Frame frame = ring.begin();
        if (i >= static_cast<int>(framesInFlight)) {
            const FrameStats stats = renderer.stats(frame.slot);
            EXPECT_EQ(stats.total, stats.resident + stats.streamedOut) << "frame " << i;
            EXPECT_EQ(test::sumOf(stats), stats.resident) << "frame " << i;
        }
        gpu::transition(frame.commands, target, gpu::ImageUse::undefined,
                        gpu::ImageUse::colorTarget);
        renderer.record(frame.commands, {target.get(), target.view(), streamingSize},
                        cameraAt(static_cast<double>(i) / (frames - 1)), settings, step * i,
                        frame.slot);
        std::vector<VkSemaphoreSubmitInfo> waits;
        if (const auto copied = renderer.copied())
            waits.push_back(*copied);
        ring.submit(frame, waits);
    }
    ring.finish();
    return gpu::readImage(context, target, gpu::ImageUse::colorTarget);
}

/// Across the field, turning.
Camera flying(double way)
{
    return lookingFrom({-30.0 + 50.0 * way, 2.0, -30.0 + 20.0 * way},
                       {-10.0 + 40.0 * way, 0.0, 30.0 - 60.0 * way});
}

TEST_F(StreamingTest, FollowsTheCameraInTheSameWayEachTime)
{
    for (const std::uint32_t framesInFlight : {1u, 3u}) {
        FieldRenderer::Settings wanted = rasterised();
        wanted.framesInFlight = framesInFlight;
        wanted.deviceBytes = budgetWith(0.25, wanted);
        std::array<std::vector<std::byte>, 2> last;
        for (auto& pixels : last) {
            FieldRenderer renderer(device(), field::viewOf(meadow()), wanted);
            pixels = play(context(), renderer, framesInFlight, 0.1, flying);
            EXPECT_LE(renderer.deviceBytes(), wanted.deviceBytes);
        }
        EXPECT_EQ(test::differingPixels(last[0], last[1]), 0u);
    }
}

TEST_F(StreamingTest, DrawsWithTheTessellatorToo)
{
    FieldRenderer::Settings wanted = rasterised();
    wanted.geometry = Geometry::tessellation;
    wanted.deviceBytes = budgetWith(0.4, wanted);
    FieldRenderer renderer(device(), field::viewOf(meadow()), wanted);
    play(context(), renderer, 1, 0.1, flying);
    EXPECT_GT(renderer.stats().drawn, 1000u);
    EXPECT_GT(renderer.stats().streamedOut, 1000u);
}

TEST_F(StreamingTest, TakesAQueueForCopiesWhereThereIsOne)
{
    const gpu::Device own(instance(), {.wantsCopyQueue = true});
    gpu::DeviceContext both = own.context();
    if (both.copyQueue == VK_NULL_HANDLE) {
        // Without a second queue use the same one; no other thread uses it here.
        both.copyQueue = both.queue;
        both.copyQueueFamily = both.queueFamily;
    }
    FieldRenderer::Settings wanted = rasterised();
    wanted.framesInFlight = 2;
    wanted.deviceBytes = budgetWith(0.33, wanted);
    FieldRenderer part(both, field::viewOf(meadow()), wanted);
    play(both, part, 2, 0.0, flying);

    // The final picture is independent of earlier loads and evictions.
    const auto still = [](double) { return lookingAtCorner(); };
    FieldRenderer whole(both, field::viewOf(meadow()), rasterised());
    const auto expected = play(both, whole, 1, 0.0, still);
    play(both, part, 2, 0.0, still);
    EXPECT_EQ(test::differingPixels(play(both, part, 2, 0.0, still), expected), 0u);
    EXPECT_GT(part.stats().streamedOut, meadow().blades.size() / 3);
}

TEST_F(StreamingTest, SaysWhatItNeedsWhereThereIsTooLittle)
{
    FieldRenderer::Settings wanted = rasterised();
    const auto messageWith = [&](std::uint64_t bytes) -> std::string {
        wanted.deviceBytes = bytes;
        try {
            const FieldRenderer renderer(device(), field::viewOf(meadow()), wanted);
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::runtime);
            return error.what();
        }
        return "";
    };
    const std::string message = messageWith(std::uint64_t(1) << 20);
    EXPECT_NE(message.find("a budget of 1 MiB"), std::string::npos) << message;
    // The named minimum works, and a mebibyte less does not.
    const std::size_t at = message.find("at least ");
    ASSERT_NE(at, std::string::npos) << message;
    const std::uint64_t least = std::stoull(message.substr(at + 9));
    EXPECT_EQ(messageWith(least << 20), "");
    EXPECT_NE(messageWith((least - 1) << 20), "");

    // Cull results of all blades are unavailable.
    wanted.deviceBytes = budgetWith(0.5, wanted);
    const FieldRenderer part(device(), field::viewOf(meadow()), wanted);
    try {
        part.dumpBlades(field::viewOf(meadow()));
        ADD_FAILURE() << "blades are not there";
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::unsupported);
    }
}

TEST_F(StreamingTest, KeepsAFieldThatItOwnsAsLongAsItStreams)
{
    FieldRenderer::Settings wanted = rasterised();
    wanted.deviceBytes = budgetWith(0.33, wanted);
    auto owned = std::make_shared<const field::Field>(meadow());
    const std::weak_ptr<const field::Field> kept = owned;
    {
        FieldRenderer renderer(context(), field::OwnedField(std::move(owned)), wanted);
        ASSERT_TRUE(renderer.isStreamed());
        EXPECT_FALSE(kept.expired());
        play(context(), renderer, 1, 0.1, flying);
        EXPECT_GT(renderer.stats().drawn, 1000u);
    }
    EXPECT_TRUE(kept.expired());
}

TEST_F(StreamingTest, TellsOfAPatchThatIsThere)
{
    const field::FieldView field = field::viewOf(meadow());
    FieldRenderer whole(device(), field, rasterised());
    FieldRenderer part = streamed(0.33);
    test::Picture picture(context(), streamingSize);
    picture.draw(whole, lookingAtCorner(), settings(), 3.0);
    for (int frame = 0; frame < 60; ++frame)
        picture.draw(part, lookingAtCorner(), settings(), 3.0);
    std::size_t there = 0;
    std::size_t absent = 0;
    for (std::uint32_t p = 0; p < field.patches.size(); p += 7) {
        const auto records = part.dumpPatch(field, p);
        if (field.patches[p].bladeCount == 0)
            continue;
        if (records.empty()) {
            ++absent;
            continue;
        }
        ++there;
        ASSERT_EQ(records.size(), field.patches[p].bladeCount);
        EXPECT_EQ(records[0].id, whole.dumpPatch(field, p)[0].id);
        EXPECT_EQ(records[0].root, whole.dumpPatch(field, p)[0].root);
    }
    EXPECT_GT(there, 10u);
    EXPECT_GT(absent, 10u);
}

} // namespace
} // namespace sward::render
