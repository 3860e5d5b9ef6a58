#pragma once

#include "gpu/device/device_report.h"

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sward::gpu {

/// Reasons why the device is unsuitable; empty if it is suitable.
std::vector<std::string> rejections(const DeviceReport& device);

/// "discrete GPU", "CPU", …
std::string_view typeName(VkPhysicalDeviceType type);

/// One line per device: index, name, type, driver, API version, memory, and reasons for rejection.
std::string describe(std::span<const DeviceReport> devices);

/// Picks a device and returns its index in `devices`. `selection` is an index, a part of a name in
/// any case, or empty. Among matching devices the order is discrete, integrated, virtual, CPU, then
/// the lower index. Throws Error{usage} with the list of devices if none matches the selection;
/// Error{unsupported} with the reasons if the matching ones are unsuitable, or if there are none at
/// all.
std::size_t chooseDevice(std::span<const DeviceReport> devices, std::string_view selection);

} // namespace sward::gpu
