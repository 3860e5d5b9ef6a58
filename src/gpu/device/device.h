#pragma once

#include "gpu/context/context.h"
#include "gpu/context/handle.h"
#include "gpu/device/device_report.h"
#include "gpu/device/instance.h"
#include "gpu/pipeline/shared_objects.h"

#include <vulkan/vulkan.h>

#include <string>

namespace sward::gpu {

struct DeviceSettings {
    /// Index, or part of the name in any case; empty selects the best (chooseDevice()).
    std::string selection{};

    /// A surface that the device must be able to present to, if any.
    VkSurfaceKHR surface = VK_NULL_HANDLE;

    bool wantsCopyQueue = false; ///< DeviceContext::copyQueue, if there is a family for copies
};

/// A device created by Sward, with one queue for graphics, compute and, given a surface,
/// presenting. Not movable, because objects made with it refer to its context.
class Device {
public:
    /// Throws Error{usage} or Error{unsupported} as chooseDevice() does.
    explicit Device(const Instance& instance, const DeviceSettings& settings = {});
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;
    ~Device();

    const DeviceContext& context() const { return context_; }
    const DeviceReport& report() const { return report_; }
    bool isCpu() const { return context_.isCpu(); }

    /// Throws Error{runtime} if the device was lost.
    void waitIdle() const;

private:
    DeviceReport report_;
    UniqueRoot<VkDevice, vkDestroyDevice> device_;
    DeviceContext context_;
    SharedObjects shared_{context_}; ///< so the next field of a window compiles no shader again
};

} // namespace sward::gpu
