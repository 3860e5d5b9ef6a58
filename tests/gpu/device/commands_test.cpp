#include "gpu/memory/buffer.h"
#include "gpu/memory/readback.h"
#include "gpu/recording/barrier.h"
#include "gpu/recording/commands.h"
#include "gpu/recording/frame_ring.h"
#include "support/gpu/gpu_fixture.h"

#include <gtest/gtest.h>

namespace sward::gpu {
namespace {

using CommandsTest = test::GpuTest;

Buffer createWords(const DeviceContext& context, std::size_t count)
{
    return {context,
            {.name = "words",
             .bytes = count * sizeof(std::uint32_t),
             .usage = VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT}};
}

TEST_F(CommandsTest, AreDoneWhenSubmitAndWaitReturns)
{
    const Buffer readable(context(), {.name = "readable",
                                      .bytes = 4'096,
                                      .usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                                      .memory = MemoryUse::readback});
    submitAndWait(context(), [&](VkCommandBuffer commands) {
        vkCmdFillBuffer(commands, readable.get(), 0, VK_WHOLE_SIZE, 0xcafe);
        anythingToHost(commands);
    });
    for (const std::uint32_t word : readable.mappedAs<std::uint32_t>())
        ASSERT_EQ(word, 0xcafeU);
}

TEST_F(CommandsTest, OfFramesInFlightRunInOrderAndTakeTurnsInTheirSlots)
{
    // Each frame appends its number and increments the last one.
    constexpr std::uint32_t frames = 10;
    const Buffer numbers = createWords(context(), frames);
    FrameRing ring(context(), 3);
    for (std::uint32_t number = 0; number < frames; ++number) {
        const FrameRing::Frame frame = ring.begin();
        EXPECT_EQ(frame.slot, number % 3);
        anythingToTransfer(frame.commands);
        vkCmdFillBuffer(frame.commands, numbers.get(), number * sizeof(std::uint32_t),
                        (frames - number) * sizeof(std::uint32_t), number);
        ring.submit(frame);
    }
    ring.finish();

    const auto noted = readBufferAs<std::uint32_t>(context(), numbers);
    for (std::uint32_t number = 0; number < frames; ++number)
        EXPECT_EQ(noted[number], number);
}

TEST_F(CommandsTest, OfAFrameThatWasNeverSubmittedBlockNobody)
{
    FrameRing ring(context(), 2);
    const FrameRing::Frame given = ring.begin();
    const FrameRing::Frame again = ring.begin();
    EXPECT_EQ(again.slot, given.slot);
    ring.submit(again);
    ring.finish();
}

} // namespace
} // namespace sward::gpu
