#include "godot/native/device_request.h"

namespace sward::godot {
namespace {

// The struct of a type in a chain; null if it has none. Hosts own what they pass and keep it in
// writable memory.
template <class Struct>
Struct* find(const void* chain, VkStructureType type)
{
    // NOLINTNEXTLINE(*-const-cast): restored by ~DeviceRequest()
    auto* next = static_cast<VkBaseOutStructure*>(const_cast<void*>(chain));
    while (next != nullptr && next->sType != type)
        next = next->pNext;
    return reinterpret_cast<Struct*>(next);
}

} // namespace

DeviceRequest::DeviceRequest(const VkDeviceCreateInfo& host, bool with64BitAtomics)
    : info_(host)
    , hostChain_(host.pNext)
{
    VkPhysicalDeviceFeatures& core = coreFeatures();
    set(core.shaderInt64);
    set(core.tessellationShader);

    using V12 = VkPhysicalDeviceVulkan12Features;
    using V13 = VkPhysicalDeviceVulkan13Features;
    constexpr VkStructureType of12 = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES;
    constexpr VkStructureType of13 = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES;
    enable(of12, &V12::bufferDeviceAddress,
           VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_BUFFER_DEVICE_ADDRESS_FEATURES,
           &VkPhysicalDeviceBufferDeviceAddressFeatures::bufferDeviceAddress, addresses_);
    enable(of12, &V12::scalarBlockLayout,
           VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SCALAR_BLOCK_LAYOUT_FEATURES,
           &VkPhysicalDeviceScalarBlockLayoutFeatures::scalarBlockLayout, scalar_);
    if (with64BitAtomics)
        enable(of12, &V12::shaderBufferInt64Atomics,
               VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SHADER_ATOMIC_INT64_FEATURES,
               &VkPhysicalDeviceShaderAtomicInt64Features::shaderBufferInt64Atomics, atomics_);
    enable(of13, &V13::dynamicRendering,
           VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DYNAMIC_RENDERING_FEATURES,
           &VkPhysicalDeviceDynamicRenderingFeatures::dynamicRendering, rendering_);
    enable(of13, &V13::synchronization2,
           VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SYNCHRONIZATION_2_FEATURES,
           &VkPhysicalDeviceSynchronization2Features::synchronization2, synchronization_);
    enable(of13, &V13::maintenance4, VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_4_FEATURES,
           &VkPhysicalDeviceMaintenance4Features::maintenance4, maintenance_);
}

DeviceRequest::~DeviceRequest()
{
    for (const auto& [member, value] : changed_)
        *member = value;
}

void DeviceRequest::set(VkBool32& member)
{
    changed_.emplace_back(&member, member);
    member = VK_TRUE;
}

// The host has them in its chain, or beside it, or nowhere.
VkPhysicalDeviceFeatures& DeviceRequest::coreFeatures()
{
    if (auto* const all = find<VkPhysicalDeviceFeatures2>(
            hostChain_, VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2))
        return all->features;
    if (info_.pEnabledFeatures != nullptr)
        core_ = *info_.pEnabledFeatures;
    info_.pEnabledFeatures = &core_;
    return core_;
}

// A chain that has the struct of a whole version may not have those of its single features.
template <class Whole, class Single>
void DeviceRequest::enable(VkStructureType whole, VkBool32 Whole::*inWhole, VkStructureType single,
                           VkBool32 Single::*inSingle, Single& own)
{
    if (auto* const found = find<Whole>(hostChain_, whole)) {
        set(found->*inWhole);
    } else if (auto* const alone = find<Single>(hostChain_, single)) {
        set(alone->*inSingle);
    } else {
        own.sType = single;
        own.*inSingle = VK_TRUE;
        own.pNext = const_cast<void*>(info_.pNext); // NOLINT(*-const-cast): read alone
        info_.pNext = &own;
    }
}

} // namespace sward::godot
