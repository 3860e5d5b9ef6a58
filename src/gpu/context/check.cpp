#include "gpu/context/check.h"

#include "core/error.h"

#include <fmt/format.h>

#include <array>
#include <string>
#include <string_view>

namespace sward::gpu {
namespace {

ErrorKind kindOf(VkResult result)
{
    switch (result) {
    case VK_ERROR_FEATURE_NOT_PRESENT:
    case VK_ERROR_EXTENSION_NOT_PRESENT:
    case VK_ERROR_LAYER_NOT_PRESENT:
    case VK_ERROR_FORMAT_NOT_SUPPORTED:
    case VK_ERROR_INCOMPATIBLE_DRIVER:
        return ErrorKind::unsupported;
    default:
        return ErrorKind::runtime;
    }
}

// The results of Vulkan 1.3 and of presentation. The header with Vulkan's own names belongs to
// different packages on different distributions.
struct NamedResult {
    VkResult result;
    const char* name;
};
constexpr std::array namedResults = {
    NamedResult{VK_NOT_READY, "VK_NOT_READY"},
    NamedResult{VK_TIMEOUT, "VK_TIMEOUT"},
    NamedResult{VK_EVENT_SET, "VK_EVENT_SET"},
    NamedResult{VK_EVENT_RESET, "VK_EVENT_RESET"},
    NamedResult{VK_INCOMPLETE, "VK_INCOMPLETE"},
    NamedResult{VK_ERROR_OUT_OF_HOST_MEMORY, "VK_ERROR_OUT_OF_HOST_MEMORY"},
    NamedResult{VK_ERROR_OUT_OF_DEVICE_MEMORY, "VK_ERROR_OUT_OF_DEVICE_MEMORY"},
    NamedResult{VK_ERROR_INITIALIZATION_FAILED, "VK_ERROR_INITIALIZATION_FAILED"},
    NamedResult{VK_ERROR_DEVICE_LOST, "VK_ERROR_DEVICE_LOST"},
    NamedResult{VK_ERROR_MEMORY_MAP_FAILED, "VK_ERROR_MEMORY_MAP_FAILED"},
    NamedResult{VK_ERROR_LAYER_NOT_PRESENT, "VK_ERROR_LAYER_NOT_PRESENT"},
    NamedResult{VK_ERROR_EXTENSION_NOT_PRESENT, "VK_ERROR_EXTENSION_NOT_PRESENT"},
    NamedResult{VK_ERROR_FEATURE_NOT_PRESENT, "VK_ERROR_FEATURE_NOT_PRESENT"},
    NamedResult{VK_ERROR_INCOMPATIBLE_DRIVER, "VK_ERROR_INCOMPATIBLE_DRIVER"},
    NamedResult{VK_ERROR_TOO_MANY_OBJECTS, "VK_ERROR_TOO_MANY_OBJECTS"},
    NamedResult{VK_ERROR_FORMAT_NOT_SUPPORTED, "VK_ERROR_FORMAT_NOT_SUPPORTED"},
    NamedResult{VK_ERROR_FRAGMENTED_POOL, "VK_ERROR_FRAGMENTED_POOL"},
    NamedResult{VK_ERROR_UNKNOWN, "VK_ERROR_UNKNOWN"},
    NamedResult{VK_ERROR_OUT_OF_POOL_MEMORY, "VK_ERROR_OUT_OF_POOL_MEMORY"},
    NamedResult{VK_ERROR_INVALID_EXTERNAL_HANDLE, "VK_ERROR_INVALID_EXTERNAL_HANDLE"},
    NamedResult{VK_ERROR_FRAGMENTATION, "VK_ERROR_FRAGMENTATION"},
    NamedResult{VK_ERROR_INVALID_OPAQUE_CAPTURE_ADDRESS, "VK_ERROR_INVALID_OPAQUE_CAPTURE_ADDRESS"},
    NamedResult{VK_PIPELINE_COMPILE_REQUIRED, "VK_PIPELINE_COMPILE_REQUIRED"},
    NamedResult{VK_ERROR_SURFACE_LOST_KHR, "VK_ERROR_SURFACE_LOST_KHR"},
    NamedResult{VK_ERROR_NATIVE_WINDOW_IN_USE_KHR, "VK_ERROR_NATIVE_WINDOW_IN_USE_KHR"},
    NamedResult{VK_SUBOPTIMAL_KHR, "VK_SUBOPTIMAL_KHR"},
    NamedResult{VK_ERROR_OUT_OF_DATE_KHR, "VK_ERROR_OUT_OF_DATE_KHR"},
};

std::string nameOf(VkResult result)
{
    for (const NamedResult& named : namedResults)
        if (named.result == result)
            return named.name;
    return fmt::format("VkResult {}", static_cast<int>(result));
}

} // namespace

void check(VkResult result, const char* call, std::source_location where)
{
    if (result == VK_SUCCESS) [[likely]]
        return;

    // Name the file without its folders, which depend on the build machine.
    std::string_view file = where.file_name();
    file.remove_prefix(file.find_last_of('/') + 1);
    if (result == VK_ERROR_DEVICE_LOST)
        fail(ErrorKind::runtime,
             "{} failed: VK_ERROR_DEVICE_LOST ({}:{}): the device was lost: the driver stopped "
             "this program or the device; the system log may contain the reason",
             call, file, where.line());
    fail(kindOf(result), "{} failed: {} ({}:{})", call, nameOf(result), file, where.line());
}

} // namespace sward::gpu
