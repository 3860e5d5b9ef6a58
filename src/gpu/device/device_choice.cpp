#include "gpu/device/device_choice.h"

#include "core/error.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <optional>

namespace sward::gpu {
namespace {

// Greater is better.
int rank(VkPhysicalDeviceType type)
{
    switch (type) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
        return 4;
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
        return 3;
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
        return 2;
    case VK_PHYSICAL_DEVICE_TYPE_CPU:
        return 1;
    default:
        return 0;
    }
}

std::string lowerCase(std::string_view text)
{
    std::string lower(text);
    std::ranges::transform(lower, lower.begin(), [](unsigned char letter) {
        return static_cast<char>(std::tolower(letter));
    });
    return lower;
}

// The number in `text`, if it consists of digits only.
std::optional<std::size_t> indexIn(std::string_view text)
{
    if (text.empty() || !std::ranges::all_of(text, [](char c) { return c >= '0' && c <= '9'; }))
        return std::nullopt;
    std::size_t index = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), index);
    // A number that overflows matches no device.
    return error == std::errc{} ? index : static_cast<std::size_t>(-1);
}

bool fits(const DeviceReport& device, std::string_view selection)
{
    if (const std::optional<std::size_t> index = indexIn(selection))
        return device.index == *index;
    return lowerCase(device.name).find(lowerCase(selection)) != std::string::npos;
}

} // namespace

std::vector<std::string> rejections(const DeviceReport& device)
{
    std::vector<std::string> reasons;
    if (device.apiVersion < requiredApiVersion) {
        reasons.push_back(fmt::format("has Vulkan {}.{}, needed is 1.3",
                                      VK_API_VERSION_MAJOR(device.apiVersion),
                                      VK_API_VERSION_MINOR(device.apiVersion)));
        return reasons;
    }
    for (const std::string& feature : device.missingFeatures)
        reasons.push_back("lacks the feature " + feature);
    if (!device.hasSubgroups)
        reasons.emplace_back("lacks subgroup ballot and arithmetic in compute shaders");
    if (!device.hasQueue)
        reasons.emplace_back("has no queue for graphics and compute");
    else if (!device.presents)
        reasons.emplace_back("cannot present to this window");
    return reasons;
}

std::string_view typeName(VkPhysicalDeviceType type)
{
    switch (type) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
        return "discrete GPU";
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
        return "integrated GPU";
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
        return "virtual GPU";
    case VK_PHYSICAL_DEVICE_TYPE_CPU:
        return "CPU";
    default:
        return "other";
    }
}

std::string describe(std::span<const DeviceReport> devices)
{
    std::string text;
    for (const DeviceReport& device : devices) {
        text += fmt::format(
            "{}  {}  ({}, Vulkan {}.{}.{}, {:.1f} GiB{}{})", device.index, device.name,
            typeName(device.type), VK_API_VERSION_MAJOR(device.apiVersion),
            VK_API_VERSION_MINOR(device.apiVersion), VK_API_VERSION_PATCH(device.apiVersion),
            static_cast<double>(device.memoryBytes) / double(1 << 30),
            device.driver.empty() ? "" : ", ", device.driver);
        const std::vector<std::string> reasons = rejections(device);
        text += reasons.empty() ? "\n" : fmt::format(": {}\n", fmt::join(reasons, ", "));
    }
    return text;
}

std::size_t chooseDevice(std::span<const DeviceReport> devices, std::string_view selection)
{
    if (devices.empty())
        fail(ErrorKind::unsupported,
             "no Vulkan device was found; install the graphics card's driver, or Debian's "
             "mesa-vulkan-drivers, which also draws on the CPU");

    // Take the best of the devices that match and are suitable.
    std::optional<std::size_t> best;
    bool anyFits = false;
    for (std::size_t i = 0; i < devices.size(); ++i) {
        if (!fits(devices[i], selection))
            continue;
        anyFits = true;
        if (rejections(devices[i]).empty() &&
            (!best || rank(devices[i].type) > rank(devices[*best].type)))
            best = i;
    }
    if (best)
        return *best;

    if (!anyFits)
        fail(ErrorKind::usage, "no Vulkan device matches '{}'; these exist:\n{}", selection,
             describe(devices));
    if (selection.empty())
        fail(ErrorKind::unsupported,
             "no Vulkan device can be used; Debian's mesa-vulkan-drivers has one that draws on the "
             "CPU. These exist:\n{}",
             describe(devices));
    fail(ErrorKind::unsupported, "the Vulkan device '{}' cannot be used; these exist:\n{}",
         selection, describe(devices));
}

} // namespace sward::gpu
