#include "gpu/device/validation_log.h"
#include "gpu/memory/buffer.h"
#include "gpu/recording/barrier.h"
#include "gpu/recording/commands.h"
#include "support/gpu/gpu_fixture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <thread>
#include <vector>

namespace sward::gpu {
namespace {

using testing::ContainsRegex;
using testing::HasSubstr;

// Shows that the validation log detects errors: each misuse is recorded, found in the log, and
// never submitted.
class ValidationTest : public test::GpuTest {
protected:
    static Buffer createBuffer(const std::string& name,
                               VkBufferUsageFlags usage = VK_BUFFER_USAGE_TRANSFER_SRC_BIT |
                                                          VK_BUFFER_USAGE_TRANSFER_DST_BIT)
    {
        return {context(), {.name = name, .bytes = 1'024, .usage = usage}};
    }

    CommandPool pool_{context()};
    VkCommandBuffer commands_ = pool_.allocate("misuse");
};

TEST_F(ValidationTest, HearsAnInvalidCallAndNamesTheThing)
{
    const Buffer buffer = createBuffer("not for filling", VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
    begin(commands_);
    vkCmdFillBuffer(commands_, buffer.get(), 0, 16, 0);
    EXPECT_GE(validationLog().count(), 1U);
    EXPECT_THAT(validationLog().text(), HasSubstr("VUID-vkCmdFillBuffer-dstBuffer"));
    EXPECT_THAT(validationLog().text(), HasSubstr("not for filling"));
    validationLog().clear();
}

TEST_F(ValidationTest, HearsAMissingBarrier)
{
    const Buffer source = createBuffer("source");
    const Buffer target = createBuffer("target");
    const VkBufferCopy region{0, 0, 1'024};
    begin(commands_);
    vkCmdFillBuffer(commands_, source.get(), 0, VK_WHOLE_SIZE, 0);
    vkCmdCopyBuffer(commands_, source.get(), target.get(), 1, &region);
    EXPECT_GE(validationLog().count(), 1U);
    // Newer layers write READ_AFTER_WRITE.
    EXPECT_THAT(validationLog().text(), ContainsRegex("READ[-_]AFTER[-_]WRITE"));
    validationLog().clear();
}

TEST_F(ValidationTest, IsSilentAboutTheSameWithTheBarrier)
{
    const Buffer source = createBuffer("source");
    const Buffer target = createBuffer("target");
    const VkBufferCopy region{0, 0, 1'024};
    begin(commands_);
    vkCmdFillBuffer(commands_, source.get(), 0, VK_WHOLE_SIZE, 0);
    anythingToTransfer(commands_);
    vkCmdCopyBuffer(commands_, source.get(), target.get(), 1, &region);
    EXPECT_EQ(validationLog().count(), 0U) << validationLog().text();
}

TEST(ValidationLog, CountsMessagesFromAllThreadsAndKeepsTheFirstHundred)
{
    ValidationLog log;
    std::vector<std::thread> threads;
    for (int i = 0; i < 4; ++i)
        threads.emplace_back([&log] {
            for (int j = 0; j < 1'000; ++j)
                log.add("message");
        });
    for (std::thread& thread : threads)
        thread.join();
    EXPECT_EQ(log.count(), 4'000U);
    EXPECT_EQ(log.text().size(), 100 * std::string("message\n").size());

    log.clear();
    EXPECT_EQ(log.count(), 0U);
    EXPECT_TRUE(log.text().empty());
}

} // namespace
} // namespace sward::gpu
