#include "gpu/device/instance.h"

#include "core/error.h"
#include "core/system/shared_library.h"
#include "gpu/context/check.h"

#include <cstring>
#include <string_view>

namespace sward::gpu {
namespace {

constexpr const char* validationLayer = "VK_LAYER_KHRONOS_validation";

// Appends a message to the log that was passed to the messenger.
VKAPI_ATTR VkBool32 VKAPI_CALL listen(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                      VkDebugUtilsMessageTypeFlagsEXT,
                                      const VkDebugUtilsMessengerCallbackDataEXT* message,
                                      void* log) noexcept
{
    std::string text;
    for (std::uint32_t i = 0; i < message->cmdBufLabelCount; ++i)
        text += std::string("[") + message->pCmdBufLabels[i].pLabelName + "] ";
    static_cast<ValidationLog*>(log)->add(text + message->pMessage);
    return VK_FALSE;
}

bool layerIsInstalled(const char* name)
{
    std::uint32_t count = 0;
    check(vkEnumerateInstanceLayerProperties(&count, nullptr),
          "vkEnumerateInstanceLayerProperties");
    std::vector<VkLayerProperties> layers(count);
    check(vkEnumerateInstanceLayerProperties(&count, layers.data()),
          "vkEnumerateInstanceLayerProperties");
    for (const VkLayerProperties& layer : layers)
        if (std::strcmp(layer.layerName, name) == 0)
            return true;
    return false;
}

bool extensionIsThere(const char* layer, std::string_view name)
{
    std::uint32_t count = 0;
    check(vkEnumerateInstanceExtensionProperties(layer, &count, nullptr),
          "vkEnumerateInstanceExtensionProperties");
    std::vector<VkExtensionProperties> extensions(count);
    check(vkEnumerateInstanceExtensionProperties(layer, &count, extensions.data()),
          "vkEnumerateInstanceExtensionProperties");
    for (const VkExtensionProperties& extension : extensions)
        if (name == extension.extensionName)
            return true;
    return false;
}

VkDebugUtilsMessengerCreateInfoEXT describeMessenger(ValidationLog& log)
{
    return {.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT,
            .pNext = nullptr,
            .flags = 0,
            .messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT |
                               VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT,
            // Not the general type: there the loader reports other programs' layers and drivers.
            .messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT |
                           VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT,
            .pfnUserCallback = listen,
            .pUserData = &log};
}

} // namespace

void destroyMessenger(VkInstance instance, VkDebugUtilsMessengerEXT messenger,
                      const VkAllocationCallbacks* allocator)
{
    const auto destroy = reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(
        vkGetInstanceProcAddr(instance, "vkDestroyDebugUtilsMessengerEXT"));
    destroy(instance, messenger, allocator);
}

Instance::Instance(const InstanceSettings& settings)
    : log_(std::make_unique<ValidationLog>())
{
    // On Windows the loader is opened at its first call, which would end the program without it.
    if (const std::string loader = libraryFile("vulkan", 1);
        functionOf(loader.c_str(), "vkGetInstanceProcAddr") == nullptr)
        fail(ErrorKind::unsupported,
             "{} cannot be opened; the graphics card's driver brings Vulkan's loader", loader);

    // Require a loader of 1.3 or later: device functions of 1.3 are called through it.
    std::uint32_t version = 0;
    check(vkEnumerateInstanceVersion(&version), "vkEnumerateInstanceVersion");
    if (version < requiredApiVersion)
        fail(ErrorKind::unsupported, "the Vulkan loader has version {}.{}, needed is 1.3",
             VK_API_VERSION_MAJOR(version), VK_API_VERSION_MINOR(version));

    // Use validation and debug names if they are installed.
    isValidating_ = settings.validation && layerIsInstalled(validationLayer);
    hasDebugUtils_ = isValidating_ || extensionIsThere(nullptr, VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    std::vector<const char*> layers;
    std::vector<const char*> extensions;
    if (isValidating_)
        layers.push_back(validationLayer);
    if (hasDebugUtils_)
        extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    for (const std::string& extension : settings.extensions)
        extensions.push_back(extension.c_str());

    // Collect messages from the first call on, including synchronisation validation.
    VkDebugUtilsMessengerCreateInfoEXT messenger = describeMessenger(*log_);
    constexpr VkValidationFeatureEnableEXT synchronization =
        VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;
    VkValidationFeaturesEXT validation{};
    validation.sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT;
    validation.enabledValidationFeatureCount = 1;
    validation.pEnabledValidationFeatures = &synchronization;
    if (isValidating_ &&
        extensionIsThere(validationLayer, VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME)) {
        extensions.push_back(VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME);
        messenger.pNext = &validation;
    }

    VkApplicationInfo application{};
    application.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
    application.pApplicationName = settings.application.c_str();
    application.pEngineName = "sward";
    application.apiVersion = requiredApiVersion;

    VkInstanceCreateInfo create{};
    create.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
    create.pNext = isValidating_ ? &messenger : nullptr;
    create.pApplicationInfo = &application;
    create.enabledLayerCount = static_cast<std::uint32_t>(layers.size());
    create.ppEnabledLayerNames = layers.data();
    create.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
    create.ppEnabledExtensionNames = extensions.data();

    VkInstance instance = VK_NULL_HANDLE;
    const VkResult result = vkCreateInstance(&create, nullptr, &instance);
    if (result == VK_ERROR_INCOMPATIBLE_DRIVER)
        fail(ErrorKind::unsupported,
             "no Vulkan driver was found; install the graphics card's, or Debian's "
             "mesa-vulkan-drivers, which also draws on the CPU");
    if (result == VK_ERROR_EXTENSION_NOT_PRESENT)
        for (const std::string& extension : settings.extensions)
            if (!extensionIsThere(nullptr, extension))
                fail(ErrorKind::unsupported,
                     "no Vulkan driver has the extension {} that the window needs; install the "
                     "graphics card's driver, or Debian's mesa-vulkan-drivers",
                     extension);
    check(result, "vkCreateInstance");
    instance_ = UniqueRoot<VkInstance, vkDestroyInstance>(instance);

    if (isValidating_) {
        messenger.pNext = nullptr;
        const auto createMessenger = reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(
            vkGetInstanceProcAddr(instance, "vkCreateDebugUtilsMessengerEXT"));
        VkDebugUtilsMessengerEXT handle = VK_NULL_HANDLE;
        check(createMessenger(instance, &messenger, nullptr, &handle),
              "vkCreateDebugUtilsMessengerEXT");
        messenger_ = {instance, handle};
    }
}

} // namespace sward::gpu
