#include "gpu/context/context.h"

#include "core/error.h"

#include <fmt/format.h>

#include <algorithm>

namespace sward::gpu {

void requireDevice(const DeviceContext& context)
{
    requireUsage(context.device != VK_NULL_HANDLE,
                 "the context describes no device; gpu::describeDevice() returns one that does");
}

std::string driverText(const VkPhysicalDeviceDriverProperties& driver)
{
    return fmt::format("{} {}", driver.driverName, driver.driverInfo);
}

std::uint64_t largestDeviceLocalHeap(const VkPhysicalDeviceMemoryProperties& memory)
{
    std::uint64_t largest = 0;
    for (std::uint32_t i = 0; i < memory.memoryHeapCount; ++i)
        if ((memory.memoryHeaps[i].flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT) != 0)
            largest = std::max<std::uint64_t>(largest, memory.memoryHeaps[i].size);
    return largest;
}

std::uint64_t DeviceContext::deviceLocalBytes() const
{
    return largestDeviceLocalHeap(memory);
}

} // namespace sward::gpu
