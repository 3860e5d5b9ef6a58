// The list of devices of a real instance, and the one that is made.

#include "core/error.h"
#include "gpu/device/device_choice.h"
#include "support/gpu/gpu_fixture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sward::gpu {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

using DeviceList = test::GpuTest;

TEST_F(DeviceList, DescribesTheDeviceOfTheTestsAndAcceptsIt)
{
    const std::vector<DeviceReport> devices = listDevices(instance());
    ASSERT_FALSE(devices.empty());
    for (std::size_t i = 0; i < devices.size(); ++i)
        EXPECT_EQ(devices[i].index, i);
    const DeviceReport& chosen = device().report();
    EXPECT_THAT(rejections(chosen), IsEmpty());
    EXPECT_FALSE(chosen.driver.empty());
    EXPECT_GT(chosen.memoryBytes, 0U);
    EXPECT_THAT(describe(devices), HasSubstr(chosen.name));
}

TEST_F(DeviceList, MakesTheSelectedDeviceAndNoOther)
{
    const Device second(instance(), {.selection = device().report().name});
    EXPECT_EQ(second.report().name, device().report().name);
    try {
        const Device third(instance(), {.selection = "1000"});
        FAIL() << "there are not a thousand devices";
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::usage);
        EXPECT_THAT(error.what(), HasSubstr(device().report().name));
    }
}

} // namespace
} // namespace sward::gpu
