#include "gpu/memory/buffer.h"
#include "gpu/recording/barrier.h"
#include "gpu/recording/frame_ring.h"
#include "gpu/recording/timestamps.h"
#include "support/gpu/gpu_fixture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <numeric>

namespace sward::gpu {
namespace {

using testing::ElementsAre;

class TimestampsTest : public test::GpuTest {
protected:
    // Work that takes the device some time.
    static void work(VkCommandBuffer commands, const Buffer& buffer)
    {
        anythingToTransfer(commands);
        vkCmdFillBuffer(commands, buffer.get(), 0, VK_WHOLE_SIZE, 1);
    }

    Buffer buffer_{context(),
                   {.name = "filled",
                    .bytes = VkDeviceSize(16) << 20,
                    .usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT}};
};

TEST_F(TimestampsTest, MeasureNamedPartsThatFitIntoTheWhole)
{
    constexpr int frames = 6;
    const auto start = std::chrono::steady_clock::now();
    FrameRing ring(context(), 2);
    Timestamps timestamps(context(), {.slots = ring.slots()});
    for (int i = 0; i < frames; ++i) {
        const FrameRing::Frame frame = ring.begin();
        timestamps.beginFrame(frame.commands, frame.slot);
        {
            const TimedScope total(timestamps, context(), frame.commands, "total");
            {
                const TimedScope part(timestamps, context(), frame.commands, "first");
                work(frame.commands, buffer_);
            }
            const TimedScope part(timestamps, context(), frame.commands, "second");
            work(frame.commands, buffer_);
        }
        ring.submit(frame);
    }
    ring.finish();
    const std::chrono::duration<double, std::milli> wall = std::chrono::steady_clock::now() - start;
    timestamps.collect();

    EXPECT_THAT(timestamps.names(), ElementsAre("total", "first", "second"));
    const std::vector<double> total = timestamps.history("total");
    const std::vector<double> first = timestamps.history("first");
    const std::vector<double> second = timestamps.history("second");
    ASSERT_EQ(total.size(), std::size_t(frames));
    ASSERT_EQ(first.size(), std::size_t(frames));
    ASSERT_EQ(second.size(), std::size_t(frames));
    for (std::size_t i = 0; i < total.size(); ++i) {
        EXPECT_GT(first[i], 0.0);
        EXPECT_GT(second[i], 0.0);
        // The counters are whole ticks, so sums may be off by two of them.
        EXPECT_LE(first[i] + second[i], total[i] + 2e-6 * double(context().limits.timestampPeriod));
    }
    // The CPU waited for all of it; the clocks may differ by a thousandth.
    EXPECT_LE(std::accumulate(total.begin(), total.end(), 0.0), 1.001 * wall.count());
    EXPECT_EQ(timestamps.statistics("total").count, std::size_t(frames));
    EXPECT_TRUE(timestamps.history("third").empty());
}

TEST_F(TimestampsTest, AddUpThePartsOfAFrameThatHaveTheSameName)
{
    FrameRing ring(context(), 2);
    Timestamps timestamps(context());
    const FrameRing::Frame frame = ring.begin();
    timestamps.beginFrame(frame.commands, frame.slot);
    {
        const TimedScope all(timestamps, context(), frame.commands, "all");
        for (int i = 0; i < 2; ++i) {
            const TimedScope part(timestamps, context(), frame.commands, "cull");
            work(frame.commands, buffer_);
        }
    }
    ring.submit(frame);
    ring.finish();
    timestamps.collect();
    ASSERT_EQ(timestamps.history("cull").size(), 1U);
    EXPECT_LE(timestamps.history("cull")[0], timestamps.history("all")[0]);
    EXPECT_GT(timestamps.history("cull")[0], 0.5 * timestamps.history("all")[0]);
}

TEST_F(TimestampsTest, ForgetTheOldestAndLeaveOutWhatIsTooMuch)
{
    FrameRing ring(context(), 1);
    Timestamps timestamps(context(), {.slots = 1, .scopes = 2, .historyFrames = 4});
    for (int i = 0; i < 7; ++i) {
        const FrameRing::Frame frame = ring.begin();
        timestamps.beginFrame(frame.commands, frame.slot);
        for (const char* name : {"a", "b", "c"}) {
            const TimedScope part(timestamps, context(), frame.commands, name);
            work(frame.commands, buffer_);
        }
        ring.submit(frame);
    }
    ring.finish();
    timestamps.collect();
    EXPECT_THAT(timestamps.names(), ElementsAre("a", "b"));
    EXPECT_EQ(timestamps.history("a").size(), 4U);

    timestamps.clearHistory();
    EXPECT_TRUE(timestamps.history("a").empty());
}

} // namespace
} // namespace sward::gpu
