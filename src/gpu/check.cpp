#include "gpu/check.h"

#include "core/error.h"

#include <vulkan/vk_enum_string_helper.h>

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

} // namespace

void check(VkResult result, const char* call, std::source_location where)
{
    if (result == VK_SUCCESS) [[likely]]
        return;

    // Name the file without its folders: those are the build machine's affair.
    std::string_view file = where.file_name();
    file.remove_prefix(file.find_last_of('/') + 1);
    if (result == VK_ERROR_DEVICE_LOST)
        fail(ErrorKind::runtime,
             "{} failed: VK_ERROR_DEVICE_LOST ({}:{}): the device was lost: the driver stopped "
             "this program or the device; the system log may contain the reason",
             call, file, where.line());
    fail(kindOf(result), "{} failed: {} ({}:{})", call, string_VkResult(result), file,
         where.line());
}

} // namespace sward::gpu
