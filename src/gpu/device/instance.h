#pragma once

#include "gpu/context/handle.h"
#include "gpu/device/validation_log.h"

#include <vulkan/vulkan.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace sward::gpu {

/// Vulkan version that this library requires.
constexpr std::uint32_t requiredApiVersion = VK_API_VERSION_1_3;

/// Settings of an instance.
struct InstanceSettings {
    std::string application = "sward"; ///< name reported to drivers

    /// Enables the validation layer, with synchronisation validation, if installed.
    bool validation = false;

    /// Instance extensions of the window system; empty without a window.
    std::vector<std::string> extensions{};
};

/// vkDestroyDebugUtilsMessengerEXT, which the loader does not export.
void destroyMessenger(VkInstance instance, VkDebugUtilsMessengerEXT messenger,
                      const VkAllocationCallbacks* allocator);

/// The connection to Vulkan. Independent of window systems: the caller names the extensions that a
/// surface needs.
class Instance {
public:
    /// Throws Error{unsupported} if there is no Vulkan driver, the loader is older than 1.3, or an
    /// extension is missing.
    explicit Instance(const InstanceSettings& settings = {});

    VkInstance get() const { return instance_.get(); } ///< the handle

    /// Whether the validation layer is active. False if not requested or not installed.
    bool isValidating() const { return isValidating_; }

    /// Whether objects may be named and command buffers labelled.
    bool hasDebugUtils() const { return hasDebugUtils_; }

    ValidationLog& validationLog() const { return *log_; } ///< messages of the layer

private:
    std::unique_ptr<ValidationLog> log_;
    UniqueRoot<VkInstance, vkDestroyInstance> instance_;
    Unique<VkDebugUtilsMessengerEXT, destroyMessenger, VkInstance> messenger_;
    bool isValidating_ = false;
    bool hasDebugUtils_ = false;
};

} // namespace sward::gpu
