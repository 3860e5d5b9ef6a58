#include "gpu/context/device_functions.h"

#include "core/error.h"

namespace sward::gpu {
namespace {

template <typename Function>
Function load(VkDevice device, PFN_vkGetDeviceProcAddr getDeviceProcAddr, const char* name)
{
    const auto function = reinterpret_cast<Function>(getDeviceProcAddr(device, name));
    if (function == nullptr)
        fail(ErrorKind::unsupported, "the device has no {}", name);
    return function;
}

} // namespace

DeviceFunctions loadFunctions(VkDevice device, PFN_vkGetDeviceProcAddr getDeviceProcAddr)
{
    DeviceFunctions functions;
#define SWARD_LOAD(name) functions.name = load<PFN_vk##name>(device, getDeviceProcAddr, "vk" #name);
    SWARD_DEVICE_FUNCTIONS(SWARD_LOAD)
#undef SWARD_LOAD
    return functions;
}

} // namespace sward::gpu
