// A host with a Vulkan of its own, without a window, draws a field of grass into its own picture:
//   embed FIELD.sward OUT.png
// What Sward asks for stands at the numbers 1 to 5; the rest is what any engine has already.
#include <png.h>
#include <sward/field/read.h>
#include <sward/gpu/features.h>
#include <sward/render/field_renderer.h>

#include <cstdio>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

using namespace sward;
constexpr VkFormat format = VK_FORMAT_R8G8B8A8_SRGB;
constexpr std::uint32_t width = 640, height = 360;
constexpr auto undefined = VK_IMAGE_LAYOUT_UNDEFINED, target = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
constexpr VkImageSubresourceRange wholeImage{VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};

void check(VkResult result, const char* call)
{
    if (result != VK_SUCCESS)
        throw std::runtime_error(std::string(call) + " failed");
}

struct Host {
    VkInstance instance = VK_NULL_HANDLE;
    VkPhysicalDevice physical = VK_NULL_HANDLE;
    VkDevice device = VK_NULL_HANDLE;
    VkQueue queue = VK_NULL_HANDLE; // of family 0, which draws and computes on every desktop
    VkCommandPool pool = VK_NULL_HANDLE;
    VkImage image = VK_NULL_HANDLE;
    VkDeviceMemory imageMemory = VK_NULL_HANDLE;
    VkImageView view = VK_NULL_HANDLE;
    gpu::OptionalFeatures features;

    Host()
    {
        const VkApplicationInfo application{
            VK_STRUCTURE_TYPE_APPLICATION_INFO, nullptr, "embed", 0, nullptr, 0, VK_API_VERSION_1_3};
        const VkInstanceCreateInfo instanceInfo{VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO, nullptr, 0, &application};
        check(vkCreateInstance(&instanceInfo, nullptr, &instance), "vkCreateInstance");
        std::uint32_t one = 1;
        if (vkEnumeratePhysicalDevices(instance, &one, &physical) < VK_SUCCESS || one == 0)
            throw std::runtime_error("there is no Vulkan device");

        // 1. Features: what must be there, and what is used where it is; the host adds its own.
        gpu::FeatureChain supported, wanted;
        vkGetPhysicalDeviceFeatures2(physical, &supported.core);
        for (const std::string& name : gpu::missingFeatures(supported))
            throw std::runtime_error("the device has no " + name);
        features = gpu::enableFeatures(supported, wanted);

        const float priority = 1.0f;
        const VkDeviceQueueCreateInfo queues{VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO, nullptr, 0, 0, 1, &priority};
        const VkDeviceCreateInfo deviceInfo{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO, &wanted.core, 0, 1, &queues};
        check(vkCreateDevice(physical, &deviceInfo, nullptr, &device), "vkCreateDevice");
        vkGetDeviceQueue(device, 0, 0, &queue);
        const VkCommandPoolCreateInfo poolInfo{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
        check(vkCreateCommandPool(device, &poolInfo, nullptr, &pool), "vkCreateCommandPool");

        // The picture. Sward asks for the first two usages.
        VkImageCreateInfo imageInfo{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO, nullptr, 0, VK_IMAGE_TYPE_2D, format};
        imageInfo.extent = {width, height, 1};
        imageInfo.mipLevels = imageInfo.arrayLayers = 1;
        imageInfo.samples = VK_SAMPLE_COUNT_1_BIT;
        imageInfo.usage =
            VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
        check(vkCreateImage(device, &imageInfo, nullptr, &image), "vkCreateImage");
        VkMemoryRequirements needs;
        vkGetImageMemoryRequirements(device, image, &needs);
        imageMemory = allocate(needs, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
        check(vkBindImageMemory(device, image, imageMemory, 0), "vkBindImageMemory");
        VkImageViewCreateInfo viewInfo{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO, nullptr, 0, image};
        viewInfo.viewType = VK_IMAGE_VIEW_TYPE_2D;
        viewInfo.format = format;
        viewInfo.subresourceRange = wholeImage;
        check(vkCreateImageView(device, &viewInfo, nullptr, &view), "vkCreateImageView");
    }

    ~Host()
    {
        vkDestroyImageView(device, view, nullptr);
        vkDestroyImage(device, image, nullptr);
        vkFreeMemory(device, imageMemory, nullptr);
        vkDestroyCommandPool(device, pool, nullptr);
        vkDestroyDevice(device, nullptr);
        vkDestroyInstance(instance, nullptr);
    }

    VkDeviceMemory allocate(const VkMemoryRequirements& needs, VkMemoryPropertyFlags flags) const
    {
        VkPhysicalDeviceMemoryProperties memory;
        vkGetPhysicalDeviceMemoryProperties(physical, &memory);
        VkMemoryAllocateInfo info{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, nullptr, needs.size, 0};
        while ((needs.memoryTypeBits >> info.memoryTypeIndex & 1u) == 0 ||
               (memory.memoryTypes[info.memoryTypeIndex].propertyFlags & flags) != flags)
            ++info.memoryTypeIndex;
        VkDeviceMemory result = VK_NULL_HANDLE;
        check(vkAllocateMemory(device, &info, nullptr, &result), "vkAllocateMemory");
        return result;
    }

    void turn(VkCommandBuffer commands, VkImageLayout from, VkImageLayout to) const
    {
        constexpr VkPipelineStageFlags all = VK_PIPELINE_STAGE_ALL_COMMANDS_BIT;
        constexpr VkAccessFlags any = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT;
        VkImageMemoryBarrier barrier{VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER, nullptr, any, any};
        barrier.oldLayout = from;
        barrier.newLayout = to;
        barrier.image = image;
        barrier.subresourceRange = wholeImage;
        vkCmdPipelineBarrier(commands, all, all, 0, 0, nullptr, 0, nullptr, 1, &barrier);
    }

    void submitAndWait(const std::function<void(VkCommandBuffer)>& record) const
    {
        const VkCommandBufferAllocateInfo info{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO, nullptr, pool,
                                               VK_COMMAND_BUFFER_LEVEL_PRIMARY, 1};
        VkCommandBuffer commands = VK_NULL_HANDLE;
        check(vkAllocateCommandBuffers(device, &info, &commands), "vkAllocateCommandBuffers");
        const VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
        check(vkBeginCommandBuffer(commands, &begin), "vkBeginCommandBuffer");
        record(commands);
        check(vkEndCommandBuffer(commands), "vkEndCommandBuffer");
        const VkSubmitInfo submission{VK_STRUCTURE_TYPE_SUBMIT_INFO, nullptr, 0, nullptr, nullptr, 1, &commands};
        check(vkQueueSubmit(queue, 1, &submission, VK_NULL_HANDLE), "vkQueueSubmit");
        check(vkQueueWaitIdle(queue), "vkQueueWaitIdle");
        vkFreeCommandBuffers(device, pool, 1, &commands);
    }

    void save(const char* path) const
    {
        const VkBufferCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO, nullptr, 0, 4 * width * height,
                                      VK_BUFFER_USAGE_TRANSFER_DST_BIT};
        VkBuffer buffer = VK_NULL_HANDLE;
        check(vkCreateBuffer(device, &info, nullptr, &buffer), "vkCreateBuffer");
        VkMemoryRequirements needs;
        vkGetBufferMemoryRequirements(device, buffer, &needs);
        const VkDeviceMemory memory =
            allocate(needs, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
        check(vkBindBufferMemory(device, buffer, memory, 0), "vkBindBufferMemory");
        submitAndWait([&](VkCommandBuffer commands) {
            constexpr VkImageLayout source = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;
            turn(commands, target, source);
            const VkBufferImageCopy region{0, 0, 0, {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1}, {}, {width, height, 1}};
            vkCmdCopyImageToBuffer(commands, image, source, buffer, 1, &region);
        });
        void* pixels = nullptr;
        check(vkMapMemory(device, memory, 0, VK_WHOLE_SIZE, 0, &pixels), "vkMapMemory");
        png_image png{nullptr, PNG_IMAGE_VERSION, width, height, PNG_FORMAT_RGBA, 0, 0, 0, {}};
        if (png_image_write_to_file(&png, path, 0, pixels, 0, nullptr) == 0)
            throw std::runtime_error(std::string(path) + ": " + png.message);
        vkDestroyBuffer(device, buffer, nullptr);
        vkFreeMemory(device, memory, nullptr);
    }
};

void draw(const Host& host, const char* fieldPath, const char* picturePath)
{
    // 2. A field needs no device.
    const field::MappedField mapped = field::readField(fieldPath);
    const field::FieldView field = mapped.view();

    // 3. The device's context, which outlives the renderer.
    const gpu::DeviceContext context =
        gpu::describeDevice(host.physical, host.device, 0, host.queue, host.features, false);
    render::FieldRenderer renderer(context, field, {.colorFormat = format});

    // 4. Camera, sun, and what rolls through the grass are the host's.
    const Aabb content = renderer.content();
    const glm::dvec3 middle = field.origin + glm::dvec3(content.centre());
    const double extent = static_cast<double>(content.high.x - content.low.x);
    const render::Camera camera{.eye = middle + extent * glm::dvec3(0.25, 0.22, 0.6), .target = middle};
    const std::vector<render::Collider::Waypoint> way{{0.0, {-0.3 * extent, 0, 0}}, {1.0, {0.1 * extent, 0, 0}}};
    render::FrameSettings settings = render::FrameSettings::of(field);
    settings.sunDirection = {-0.5f, 0.4f, 0.6f};
    settings.colliders = {{.from = middle, .to = middle, .radius = 0.05 * extent, .path = way}};

    // 5. Frames, into the host's command buffers.
    for (int frame = 0; frame <= 5; ++frame)
        host.submitAndWait([&](VkCommandBuffer commands) {
            if (frame == 0)
                host.turn(commands, undefined, target);
            renderer.record(commands, {host.image, host.view, {width, height}}, camera, settings, frame / 5.0);
        });
    host.save(picturePath);
    std::printf("%s drew %llu blades\n", context.name.c_str(), static_cast<unsigned long long>(renderer.stats().drawn));
}

int main(int argc, char** argv)
try {
    if (argc != 3)
        throw std::runtime_error("usage: embed FIELD.sward OUT.png");
    draw(Host(), argv[1], argv[2]);
} catch (const std::exception& error) {
    std::fprintf(stderr, "embed: %s\n", error.what());
    return 1;
}
