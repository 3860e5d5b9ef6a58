#pragma once

#include <vulkan/vulkan.h>

#include <utility>
#include <vector>

namespace sward::godot {

/// What the layer adds to a host's VkDeviceCreateInfo: Sward's features, each where the host's
/// chain has a place for it, else in a struct of its own. The host's structs have their former
/// values again when this object is gone.
class DeviceRequest {
public:
    DeviceRequest(const VkDeviceCreateInfo& host, bool with64BitAtomics);
    ~DeviceRequest();
    DeviceRequest(const DeviceRequest&) = delete;
    DeviceRequest& operator=(const DeviceRequest&) = delete;

    /// Valid as long as this object and the host's structs.
    const VkDeviceCreateInfo& info() const { return info_; }

private:
    template <class Whole, class Single>
    void enable(VkStructureType whole, VkBool32 Whole::*inWhole, VkStructureType single,
                VkBool32 Single::*inSingle, Single& own);
    void set(VkBool32& member);
    VkPhysicalDeviceFeatures& coreFeatures();

    VkDeviceCreateInfo info_;
    const void* hostChain_;
    VkPhysicalDeviceFeatures core_{};
    VkPhysicalDeviceBufferDeviceAddressFeatures addresses_{};
    VkPhysicalDeviceScalarBlockLayoutFeatures scalar_{};
    VkPhysicalDeviceShaderAtomicInt64Features atomics_{};
    VkPhysicalDeviceDynamicRenderingFeatures rendering_{};
    VkPhysicalDeviceSynchronization2Features synchronization_{};
    VkPhysicalDeviceMaintenance4Features maintenance_{};
    std::vector<std::pair<VkBool32*, VkBool32>> changed_; // members of the host, and their values
};

} // namespace sward::godot
