// Draws a field on a device that is made as Godot makes it, through the extension's layer:
//   device LIBRARY FIELD [late|start]    late: the extension is reached when there is an instance
//   already; start: ends
//                                        where the field would be loaded
// Prints what the extension says if it refuses; else how many pixels have grass, frame by frame.
// Messages of the validation layer are lines of their own.
#include "gpu/godot/played_godot.h"

#include <vulkan/vulkan.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <stdexcept>
#include <string>
#include <vector>

using namespace sward::played;

namespace {

constexpr std::int64_t width = 160;
constexpr std::int64_t height = 90;

void require(VkResult result, const char* call)
{
    if (result != VK_SUCCESS)
        throw std::runtime_error(std::string(call) + ": " + std::to_string(result));
}

VKAPI_ATTR VkBool32 VKAPI_CALL report(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                      VkDebugUtilsMessageTypeFlagsEXT,
                                      const VkDebugUtilsMessengerCallbackDataEXT* data, void*)
{
    std::printf("validation %s\n", data->pMessage);
    return VK_FALSE;
}

struct Device {
    VkInstance instance = VK_NULL_HANDLE;
    VkPhysicalDevice physical = VK_NULL_HANDLE;
    VkDevice device = VK_NULL_HANDLE;
    VkQueue queue = VK_NULL_HANDLE;
    VkDebugUtilsMessengerEXT messenger = VK_NULL_HANDLE;
};

bool hasValidation()
{
    std::uint32_t count = 0;
    vkEnumerateInstanceLayerProperties(&count, nullptr);
    std::vector<VkLayerProperties> layers(count);
    vkEnumerateInstanceLayerProperties(&count, layers.data());
    for (const VkLayerProperties& layer : layers)
        if (std::strcmp(layer.layerName, "VK_LAYER_KHRONOS_validation") == 0)
            return true;
    return false;
}

void makeInstance(Device& made)
{
    VkApplicationInfo application{};
    application.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
    application.apiVersion = VK_API_VERSION_1_2;
    const char* const layer = "VK_LAYER_KHRONOS_validation";
    const char* const extension = VK_EXT_DEBUG_UTILS_EXTENSION_NAME;
    VkDebugUtilsMessengerCreateInfoEXT messenger{};
    messenger.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT;
    messenger.messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT |
                                VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT;
    messenger.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT;
    messenger.pfnUserCallback = report;
    VkInstanceCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
    info.pApplicationInfo = &application;
    const bool isValidated = hasValidation();
    if (isValidated) {
        info.enabledLayerCount = 1;
        info.ppEnabledLayerNames = &layer;
        info.enabledExtensionCount = 1;
        info.ppEnabledExtensionNames = &extension;
    }
    require(vkCreateInstance(&info, nullptr, &made.instance), "vkCreateInstance");
    if (isValidated) {
        const auto create = reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(
            vkGetInstanceProcAddr(made.instance, "vkCreateDebugUtilsMessengerEXT"));
        require(create(made.instance, &messenger, nullptr, &made.messenger), "messenger");
    }
}

// With a few features, in structs as Godot 4.6 passes them.
void makeDevice(Device& made, bool hasWhole)
{
    std::uint32_t count = 1;
    vkEnumeratePhysicalDevices(made.instance, &count, &made.physical);
    const float priority = 1.0f;
    VkDeviceQueueCreateInfo queue{};
    queue.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
    queue.queueCount = 1;
    queue.pQueuePriorities = &priority;
    VkPhysicalDeviceFeatures features{};
    features.shaderInt64 = VK_TRUE;
    VkPhysicalDeviceVulkan11Features multiview{};
    multiview.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_FEATURES;
    multiview.multiview = VK_TRUE;
    VkPhysicalDeviceBufferDeviceAddressFeatures addresses{};
    addresses.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_BUFFER_DEVICE_ADDRESS_FEATURES;
    addresses.pNext = &multiview;
    VkDeviceCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
    info.pNext = &addresses;
    info.queueCreateInfoCount = 1;
    info.pQueueCreateInfos = &queue;
    info.pEnabledFeatures = &features;
    VkPhysicalDeviceVulkan13Features newest{};
    newest.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES;
    newest.pNext = &multiview;
    VkPhysicalDeviceVulkan12Features newer{};
    newer.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES;
    newer.pNext = &newest;
    VkPhysicalDeviceFeatures2 all{};
    all.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2;
    all.pNext = &newer;
    if (hasWhole) {
        info.pNext = &all;
        info.pEnabledFeatures = nullptr;
    }
    require(vkCreateDevice(made.physical, &info, nullptr, &made.device), "vkCreateDevice");
    if (addresses.bufferDeviceAddress == VK_TRUE || features.tessellationShader == VK_TRUE ||
        all.features.tessellationShader == VK_TRUE || newer.scalarBlockLayout == VK_TRUE ||
        newest.synchronization2 == VK_TRUE)
        std::printf("the host's structs have been changed\n");
    vkGetDeviceQueue(made.device, 0, 0, &made.queue);
}

void destroy(const Device& made)
{
    vkDestroyDevice(made.device, nullptr);
    if (made.messenger != VK_NULL_HANDLE)
        reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(
            vkGetInstanceProcAddr(made.instance, "vkDestroyDebugUtilsMessengerEXT"))(
            made.instance, made.messenger, nullptr);
    vkDestroyInstance(made.instance, nullptr);
}

// The depths of a picture of grass, in the layout in which Godot samples it.
std::vector<float> readDepth(const Device& at, VkImage image)
{
    VkBufferCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
    info.size = width * height * sizeof(float);
    info.usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    VkBuffer buffer = VK_NULL_HANDLE;
    require(vkCreateBuffer(at.device, &info, nullptr, &buffer), "vkCreateBuffer");
    VkMemoryRequirements needs;
    vkGetBufferMemoryRequirements(at.device, buffer, &needs);
    VkPhysicalDeviceMemoryProperties types;
    vkGetPhysicalDeviceMemoryProperties(at.physical, &types);
    VkMemoryAllocateInfo allocation{};
    allocation.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
    allocation.allocationSize = needs.size;
    constexpr VkMemoryPropertyFlags mapped =
        VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    while ((needs.memoryTypeBits >> allocation.memoryTypeIndex & 1U) == 0 ||
           (types.memoryTypes[allocation.memoryTypeIndex].propertyFlags & mapped) != mapped)
        ++allocation.memoryTypeIndex;
    VkDeviceMemory memory = VK_NULL_HANDLE;
    require(vkAllocateMemory(at.device, &allocation, nullptr, &memory), "vkAllocateMemory");
    require(vkBindBufferMemory(at.device, buffer, memory, 0), "vkBindBufferMemory");

    VkCommandPoolCreateInfo poolInfo{};
    poolInfo.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
    VkCommandPool pool = VK_NULL_HANDLE;
    require(vkCreateCommandPool(at.device, &poolInfo, nullptr, &pool), "vkCreateCommandPool");
    VkCommandBufferAllocateInfo wanted{};
    wanted.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
    wanted.commandPool = pool;
    wanted.commandBufferCount = 1;
    VkCommandBuffer commands = VK_NULL_HANDLE;
    require(vkAllocateCommandBuffers(at.device, &wanted, &commands), "vkAllocateCommandBuffers");
    VkCommandBufferBeginInfo begin{};
    begin.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
    vkBeginCommandBuffer(commands, &begin);
    VkImageMemoryBarrier barrier{};
    barrier.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER;
    barrier.oldLayout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    barrier.newLayout = VK_IMAGE_LAYOUT_GENERAL;
    barrier.dstAccessMask = VK_ACCESS_TRANSFER_READ_BIT;
    barrier.srcQueueFamilyIndex = barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.image = image;
    barrier.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT,
                         VK_PIPELINE_STAGE_TRANSFER_BIT, 0, 0, nullptr, 0, nullptr, 1, &barrier);
    VkBufferImageCopy copy{};
    copy.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    copy.imageExtent = {width, height, 1};
    vkCmdCopyImageToBuffer(commands, image, VK_IMAGE_LAYOUT_GENERAL, buffer, 1, &copy);
    require(vkEndCommandBuffer(commands), "vkEndCommandBuffer");
    VkSubmitInfo submit{};
    submit.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
    submit.commandBufferCount = 1;
    submit.pCommandBuffers = &commands;
    require(vkQueueSubmit(at.queue, 1, &submit, VK_NULL_HANDLE), "vkQueueSubmit");
    require(vkQueueWaitIdle(at.queue), "vkQueueWaitIdle");
    std::vector<float> depths(width * height);
    void* data = nullptr;
    require(vkMapMemory(at.device, memory, 0, VK_WHOLE_SIZE, 0, &data), "vkMapMemory");
    std::memcpy(depths.data(), data, depths.size() * sizeof(float));
    vkDestroyCommandPool(at.device, pool, nullptr);
    vkDestroyBuffer(at.device, buffer, nullptr);
    vkFreeMemory(at.device, memory, nullptr);
    return depths;
}

// From 8 m above the middle of the ground, looking down; depth is reversed.
Doubles viewFromAbove(std::int64_t number)
{
    constexpr double eye = 8.0;
    constexpr double nearest = 1.0;
    constexpr double scale = 2.0;
    // x right, z down the picture; distance = eye - y. Column after column.
    return {double(number),
            scale * 90.0 / 160.0,
            0.0,
            0.0,
            0.0,
            0.0,
            0.0,
            0.0,
            -1.0,
            0.0,
            scale,
            0.0,
            0.0,
            0.0,
            0.0,
            nearest,
            eye};
}

std::size_t covered(const Device& at, Object& grass, std::int64_t view)
{
    std::size_t count = 0;
    for (const float depth :
         readDepth(at, reinterpret_cast<VkImage>(grass.number("depth_image", {view}))))
        count += depth > 0.0f ? 1U : 0U;
    return count;
}

void say(const char* what, const std::string& wrong)
{
    if (!wrong.empty())
        std::printf("%s refused %s\n", what, wrong.c_str());
}

void drawField(const Device& at, const std::string& field, bool starts)
{
    const auto number = [](auto handle) { return reinterpret_cast<std::int64_t>(handle); };
    Object grass("SwardNative");
    const std::string wrong =
        grass.text("start", {number(at.instance), number(at.physical), number(at.device),
                             number(at.queue), std::int64_t(0)});
    if (!wrong.empty()) {
        say("start", wrong);
        return;
    }
    if (starts) {
        std::printf("started\n");
        return;
    }
    say("missing", grass.text("load", {std::string("missing.sward"), std::int64_t(0)}));
    say("load", grass.text("load", {field, std::int64_t(0)}));
    say("settings", grass.text("apply", {std::string(R"({"windd": []})")}));
    say("apply", grass.text("apply", {std::string(R"({"wind": []})")}));
    say("place", grass.text("place", {Doubles{0, 0, 0, 0, 0, 0, 1, 1}}));
    say("size", grass.text("resize", {std::int64_t(4), width, height}));
    say("resize", grass.text("resize", {std::int64_t(0), width, height}));
    say("unknown", grass.text("draw", {0.0, viewFromAbove(1), Doubles{}}));
    for (int frame = 0; frame < 6; ++frame)
        say("draw", grass.text("draw", {0.1 * frame, viewFromAbove(0), Doubles{}}));
    std::printf("covered %zu\n", covered(at, grass, 0));
    std::printf("blades %lld\n", static_cast<long long>(grass.number("drawn_blades")));

    // A large ball presses the grass down until it is seen from above.
    const Doubles ball{0, 1.0, 0, 0, 1.0, 0, 3.0, 0, 0, 0};
    for (int frame = 6; frame < 12; ++frame)
        say("ball", grass.text("draw", {0.1 * frame, viewFromAbove(0), ball}));
    std::printf("pressed %zu\n", covered(at, grass, 0));

    // Two views, one of which changes its size while frames are in flight.
    say("second", grass.text("resize", {std::int64_t(1), width, height}));
    Doubles both = viewFromAbove(0);
    const Doubles other = viewFromAbove(1);
    both.insert(both.end(), other.begin(), other.end());
    for (int frame = 12; frame < 24; ++frame) {
        if (frame % 4 == 0)
            say("again", grass.text("resize", {std::int64_t(0), width, height}));
        say("both", grass.text("draw", {0.1 * frame, both, Doubles{}}));
    }
    std::printf("views %zu %zu\n", covered(at, grass, 0), covered(at, grass, 1));

    // Another field, and elsewhere.
    say("reload", grass.text("load", {field, std::int64_t(0)}));
    say("moved", grass.text("place", {Doubles{0, -1000, 0, 0, 0, 0, 1, 1}}));
    say("draw", grass.text("draw", {3.0, viewFromAbove(0), Doubles{}}));
    std::printf("moved %zu\n", covered(at, grass, 0));
    grass.call("unload", {}, true);
    say("empty", grass.text("draw", {3.1, viewFromAbove(0), Doubles{}}));
}

} // namespace

int main(int argc, char** argv)
{
    try {
        const std::string mode = argc == 4 ? argv[3] : "";
        Extension extension(argv[1], "sward_native_entry");
        const std::string before = std::getenv("VK_INSTANCE_LAYERS") != nullptr
                                       ? std::getenv("VK_INSTANCE_LAYERS")
                                       : "none";
        if (mode != "late")
            extension.reach(GodotLevel::core);
        Device device;
        makeInstance(device);
        makeDevice(device, mode == "whole");
        extension.reach(GodotLevel::scene);
        const char* const after = std::getenv("VK_INSTANCE_LAYERS");
        std::printf("environment %s\n",
                    before == (after != nullptr ? after : "none") ? "restored" : "changed");
        drawField(device, argv[2], mode == "start" || mode == "whole");
        extension.leave(GodotLevel::scene);
        destroy(device);
        for (const std::string& error : errors())
            std::printf("error %s\n", error.c_str());
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
