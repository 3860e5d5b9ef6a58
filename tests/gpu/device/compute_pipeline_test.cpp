#include "core/error.h"
#include "core/random.h"
#include "gpu/memory/buffer.h"
#include "gpu/memory/readback.h"
#include "gpu/memory/upload.h"
#include "gpu/pipeline/compute_pipeline.h"
#include "gpu/recording/barrier.h"
#include "gpu/recording/commands.h"
#include "support/gpu/gpu_fixture.h"
#include "test_shaders.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sward::gpu {
namespace {

struct SquarePush {
    VkDeviceAddress source;
    VkDeviceAddress target;
    std::uint32_t count;
    std::uint32_t unused;
};

constexpr VkBufferUsageFlags listUsage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT |
                                         VK_BUFFER_USAGE_TRANSFER_SRC_BIT |
                                         VK_BUFFER_USAGE_TRANSFER_DST_BIT;
constexpr std::uint32_t groupSize = 64;

class ComputePipelineTest : public test::GpuTest {
protected:
    static ComputePipeline createSquare(std::vector<SpecializationConstant> constants)
    {
        return {context(),
                test::testShaders(),
                {.name = "square",
                 .shader = "square.comp",
                 .pushConstantBytes = sizeof(SquarePush),
                 .constants = std::move(constants)}};
    }

    // Runs the shader repeatedly, each round on the previous result.
    static std::vector<std::uint32_t> run(const ComputePipeline& pipeline,
                                          const std::vector<std::uint32_t>& numbers, int rounds)
    {
        const VkDeviceSize bytes = numbers.size() * sizeof(std::uint32_t);
        Buffer source(context(), {.name = "source", .bytes = bytes, .usage = listUsage});
        Buffer target(context(), {.name = "target", .bytes = bytes, .usage = listUsage});
        Uploader uploader(context());
        uploader.toBuffer(source, std::span(numbers));
        uploader.finish();

        submitAndWait(context(), [&](VkCommandBuffer commands) {
            pipeline.bind(commands);
            for (int round = 0; round < rounds; ++round) {
                if (round > 0)
                    std::swap(source, target);
                pipeline.push(commands, SquarePush{source.address(), target.address(),
                                                   static_cast<std::uint32_t>(numbers.size()), 0});
                const VkExtent2D grid = groupGrid(context(), groupsFor(numbers.size(), groupSize));
                vkCmdDispatch(commands, grid.width, grid.height, 1);
                computeToCompute(commands);
            }
        });
        return readBufferAs<std::uint32_t>(context(), target);
    }
};

std::vector<std::uint32_t> randomNumbers(std::size_t count)
{
    std::vector<std::uint32_t> numbers(count);
    for (std::size_t i = 0; i < count; ++i)
        numbers[i] = static_cast<std::uint32_t>(hashBits(99, i));
    return numbers;
}

std::vector<std::uint32_t> squares(std::vector<std::uint32_t> numbers, std::uint32_t addend)
{
    for (std::uint32_t& number : numbers)
        number = number * number + addend;
    return numbers;
}

TEST_F(ComputePipelineTest, ComputesThroughAddressesWhatTheCpuComputes)
{
    const std::vector<std::uint32_t> numbers = randomNumbers(100'001);
    EXPECT_EQ(run(createSquare({}), numbers, 1), squares(numbers, 0));
}

TEST_F(ComputePipelineTest, TakesSpecializationConstants)
{
    const std::vector<std::uint32_t> numbers = randomNumbers(1'000);
    EXPECT_EQ(run(createSquare({{.id = 7, .value = 12'345}}), numbers, 1),
              squares(numbers, 12'345));
}

TEST_F(ComputePipelineTest, SeesTheRoundBeforeAfterABarrier)
{
    const std::vector<std::uint32_t> numbers = randomNumbers(10'000);
    EXPECT_EQ(run(createSquare({{.id = 7, .value = 3}}), numbers, 3),
              squares(squares(squares(numbers, 3), 3), 3));
}

TEST_F(ComputePipelineTest, ReachesEveryElementBeyondOneDimensionOfGroups)
{
    // On lavapipe a dimension has at most 65 535 groups, that is 4.2 million elements.
    const std::vector<std::uint32_t> numbers = randomNumbers(4'500'000);
    EXPECT_TRUE(run(createSquare({}), numbers, 1) == squares(numbers, 0));
}

TEST_F(ComputePipelineTest, SpreadsWorkGroupsWithinTheBounds)
{
    const std::uint64_t most = context().limits.maxComputeWorkGroupCount[0];
    for (const std::uint64_t groups :
         {std::uint64_t(0), std::uint64_t(1), most - 1, most, most + 1, 3 * most, 3 * most + 1}) {
        const VkExtent2D grid = groupGrid(context(), groups);
        EXPECT_LE(grid.width, most);
        EXPECT_GE(std::uint64_t(grid.width) * grid.height, groups);
        EXPECT_LT(std::uint64_t(grid.width) * grid.height,
                  groups + std::max<std::uint64_t>(grid.width, 1));
    }
}

TEST_F(ComputePipelineTest, NamesAShaderThatIsNotThere)
{
    try {
        const ComputePipeline pipeline(context(), test::testShaders(),
                                       {.name = "cube", .shader = "cube.comp"});
        FAIL() << "a shader that does not exist was found";
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr("cube.comp"));
        EXPECT_THAT(error.what(), testing::HasSubstr("square.comp"));
    }
}

} // namespace
} // namespace sward::gpu
