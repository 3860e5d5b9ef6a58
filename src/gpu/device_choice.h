#pragma once

#include "gpu/device_report.h"

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sward::gpu {

/// Why the device will not do, one reason each; empty if it will.
std::vector<std::string> rejections(const DeviceReport& device);

/// "discrete GPU", "CPU", …
std::string_view typeName(VkPhysicalDeviceType type);

/// One line per device: index, name, type, driver, API version, memory, and the reasons against it.
std::string describe(std::span<const DeviceReport> devices);

/// Picks a device and returns its place in `devices`. `selection` is an index, a part of a name in
/// any case, or empty. Among the devices that fit, discrete comes before integrated before virtual
/// before CPU, then the lower index. Throws Error{usage} with the list of devices if none fits the
/// selection; Error{unsupported} with the reasons if those that fit will not do, or if there are
/// none at all.
std::size_t chooseDevice(std::span<const DeviceReport> devices, std::string_view selection);

} // namespace sward::gpu
