#include "core/error.h"
#include "gpu/device/device.h"
#include "gpu/device/instance.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>

namespace sward::gpu {
namespace {

constexpr const char* noDriver = "/nonexistent/driver.json";

// Connects to Vulkan and leaves with the exit code of the error, its message on stderr.
[[noreturn]] void connectAndLeave(const InstanceSettings& settings)
{
    try {
        const Instance instance(settings);
        const Device device(instance);
    } catch (const Error& error) {
        std::fputs(error.what(), stderr);
        std::exit(error.exitCode());
    }
    std::exit(0);
}

[[noreturn]] void connectWithoutDriver(const InstanceSettings& settings)
{
    setenv("VK_ICD_FILENAMES", noDriver, 1);
    setenv("VK_DRIVER_FILES", noDriver, 1);
    connectAndLeave(settings);
}

constexpr int unsupported = static_cast<int>(ErrorKind::unsupported);

// Child processes are started afresh, because a loader that has seen a driver may remember it.
class InstanceDeathTest : public testing::Test {
protected:
    void SetUp() override { GTEST_FLAG_SET(death_test_style, "threadsafe"); }
};

TEST_F(InstanceDeathTest, ConnectsWhereThereIsADriver)
{
    EXPECT_EXIT(connectAndLeave({}), testing::ExitedWithCode(0), "");
}

TEST_F(InstanceDeathTest, NamesThePackageIfThereIsNoDriver)
{
    EXPECT_EXIT(connectWithoutDriver({}), testing::ExitedWithCode(unsupported),
                "mesa-vulkan-drivers");
}

TEST_F(InstanceDeathTest, NamesThePackageAlsoIfAWindowIsWanted)
{
    EXPECT_EXIT(connectWithoutDriver({.extensions = {"VK_KHR_surface", "VK_KHR_xcb_surface"}}),
                testing::ExitedWithCode(unsupported), "mesa-vulkan-drivers");
}

TEST_F(InstanceDeathTest, NamesAnExtensionThatIsMissing)
{
    EXPECT_EXIT(connectAndLeave({.extensions = {"VK_KHR_holodeck_surface"}}),
                testing::ExitedWithCode(unsupported), "VK_KHR_holodeck_surface");
}

TEST(Instance, DoesNotValidateUnlessAsked)
{
    EXPECT_FALSE(Instance().isValidating());
}

} // namespace
} // namespace sward::gpu
