#include "core/error.h"
#include "gpu/device/device_choice.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace sward::gpu {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

DeviceReport soundDevice(std::size_t index, const std::string& name, VkPhysicalDeviceType type)
{
    DeviceReport device;
    device.index = index;
    device.name = name;
    device.type = type;
    device.driver = "driver 1";
    device.apiVersion = VK_API_VERSION_1_3;
    device.hasQueue = true;
    device.hasSubgroups = true;
    return device;
}

std::vector<DeviceReport> threeDevices()
{
    return {soundDevice(0, "llvmpipe", VK_PHYSICAL_DEVICE_TYPE_CPU),
            soundDevice(1, "Radeon Graphics", VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU),
            soundDevice(2, "NVIDIA H200", VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU)};
}

// The error that a choice ends with.
Error errorOf(std::span<const DeviceReport> devices, std::string_view selection)
{
    try {
        chooseDevice(devices, selection);
    } catch (const Error& error) {
        return error;
    }
    ADD_FAILURE() << "'" << selection << "' was accepted";
    return {ErrorKind::runtime, ""};
}

TEST(DeviceChoice, PrefersDiscreteToIntegratedToVirtualToCpuInAnyOrder)
{
    // From the best to the worst.
    std::vector<VkPhysicalDeviceType> ranking = {
        VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU, VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU,
        VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU, VK_PHYSICAL_DEVICE_TYPE_CPU,
        VK_PHYSICAL_DEVICE_TYPE_OTHER};
    for (; !ranking.empty(); ranking.erase(ranking.begin())) {
        std::vector<VkPhysicalDeviceType> order = ranking;
        std::ranges::sort(order);
        do {
            std::vector<DeviceReport> devices;
            for (const VkPhysicalDeviceType type : order)
                devices.push_back(soundDevice(devices.size(), "device", type));
            EXPECT_EQ(devices[chooseDevice(devices, "")].type, ranking.front());
        } while (std::ranges::next_permutation(order).found);
    }
}

TEST(DeviceChoice, TakesTheFirstOfEquals)
{
    const std::vector<DeviceReport> devices = {
        soundDevice(0, "llvmpipe", VK_PHYSICAL_DEVICE_TYPE_CPU),
        soundDevice(1, "twin", VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU),
        soundDevice(2, "twin", VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU)};
    EXPECT_EQ(chooseDevice(devices, ""), 1U);
    EXPECT_EQ(chooseDevice(devices, "twin"), 1U);
}

TEST(DeviceChoice, FindsADeviceByIndexOrByPartOfItsNameInAnyCase)
{
    const std::vector<DeviceReport> devices = threeDevices();
    EXPECT_EQ(chooseDevice(devices, "0"), 0U);
    EXPECT_EQ(chooseDevice(devices, "1"), 1U);
    EXPECT_EQ(chooseDevice(devices, "LLVM"), 0U);
    EXPECT_EQ(chooseDevice(devices, "radeon"), 1U);
    EXPECT_EQ(chooseDevice(devices, "nvidia h"), 2U);
    // Digits are an index, also where a name contains them.
    EXPECT_EQ(errorOf(devices, "200").kind(), ErrorKind::usage);
}

TEST(DeviceChoice, ListsTheDevicesIfNoneFits)
{
    const std::vector<DeviceReport> devices = threeDevices();
    for (const char* selection : {"3", "99999999999999999999999", "voodoo"}) {
        const Error error = errorOf(devices, selection);
        EXPECT_EQ(error.kind(), ErrorKind::usage);
        EXPECT_THAT(error.what(), HasSubstr(selection));
        for (const DeviceReport& device : devices)
            EXPECT_THAT(error.what(), HasSubstr(device.name));
    }
}

TEST(DeviceChoice, PassesOverADeviceThatWillNotDo)
{
    std::vector<DeviceReport> devices = threeDevices();
    devices[2].missingFeatures = {"bufferDeviceAddress"};
    EXPECT_EQ(chooseDevice(devices, ""), 1U);
}

TEST(DeviceChoice, SaysWhyASelectedDeviceWillNotDoInsteadOfTakingAnother)
{
    std::vector<DeviceReport> devices = threeDevices();
    devices[2].missingFeatures = {"bufferDeviceAddress"};
    const Error error = errorOf(devices, "nvidia");
    EXPECT_EQ(error.kind(), ErrorKind::unsupported);
    EXPECT_THAT(error.what(), HasSubstr("bufferDeviceAddress"));
}

TEST(DeviceChoice, NamesThePackageOfASoftwareDeviceIfNoneWillDo)
{
    EXPECT_EQ(errorOf({}, "").kind(), ErrorKind::unsupported);
    EXPECT_THAT(errorOf({}, "").what(), HasSubstr("mesa-vulkan-drivers"));
    // Without any device the error is about the devices, not the selection.
    EXPECT_EQ(errorOf({}, "0").kind(), ErrorKind::unsupported);

    std::vector<DeviceReport> devices = threeDevices();
    for (DeviceReport& device : devices)
        device.apiVersion = VK_API_VERSION_1_2;
    const Error error = errorOf(devices, "");
    EXPECT_EQ(error.kind(), ErrorKind::unsupported);
    EXPECT_THAT(error.what(), HasSubstr("mesa-vulkan-drivers"));
    EXPECT_THAT(error.what(), HasSubstr("1.2"));
}

TEST(DeviceReport, HasOneReasonForEachThingThatIsAmiss)
{
    const DeviceReport sound = threeDevices()[2];
    EXPECT_THAT(rejections(sound), IsEmpty());

    DeviceReport old = sound;
    old.apiVersion = VK_MAKE_API_VERSION(0, 1, 1, 0);
    EXPECT_THAT(rejections(old), testing::ElementsAre(HasSubstr("1.1")));

    DeviceReport poor = sound;
    poor.missingFeatures = {"shaderInt64", "scalarBlockLayout"};
    poor.hasSubgroups = false;
    poor.presents = false;
    EXPECT_EQ(rejections(poor).size(), 4U);
    EXPECT_THAT(rejections(poor), Contains(HasSubstr("shaderInt64")));
    EXPECT_THAT(rejections(poor), Contains(HasSubstr("scalarBlockLayout")));
    EXPECT_THAT(rejections(poor), Contains(HasSubstr("subgroup")));
    EXPECT_THAT(rejections(poor), Contains(HasSubstr("present")));

    DeviceReport mute = sound;
    mute.hasQueue = false;
    EXPECT_THAT(rejections(mute), testing::ElementsAre(HasSubstr("queue")));
}

} // namespace
} // namespace sward::gpu
