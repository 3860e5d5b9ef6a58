// The smallest host: Vulkan alone, no window, one picture of one field.
//   quick_start FIELD.sward OUT.ppm
// What concerns Sward stands at the numbers 1 to 6; all else is what any Vulkan program has.
#include <glm/ext/matrix_clip_space.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <sward/field/read.h>
#include <sward/gpu/host_device.h>
#include <sward/gpu/features.h>
#include <sward/render/grass.h>
#include <vulkan/vulkan.h>

#include <cstdio>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

using namespace sward;

constexpr VkExtent2D size{640, 360};
constexpr VkFormat colorFormat = VK_FORMAT_R8G8B8A8_SRGB, depthFormat = VK_FORMAT_D32_SFLOAT;

void check(VkResult result)
{
    if (result != VK_SUCCESS)
        throw std::runtime_error("Vulkan: error " + std::to_string(result));
}

/// The device, and what a program without a window needs of it. The end of the process frees it.
struct Vulkan {
    gpu::HostDevice host;
    VkCommandBuffer commands = VK_NULL_HANDLE;

    Vulkan()
    {
        VkApplicationInfo application{VK_STRUCTURE_TYPE_APPLICATION_INFO};
        application.apiVersion = VK_API_VERSION_1_3;
        VkInstanceCreateInfo instanceInfo{VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
        instanceInfo.pApplicationInfo = &application;
        check(vkCreateInstance(&instanceInfo, nullptr, &host.instance));
        std::uint32_t one = 1;
        if (vkEnumeratePhysicalDevices(host.instance, &one, &host.physical) < VK_SUCCESS || one == 0)
            throw std::runtime_error("there is no Vulkan device");

        // 1. The device gets the features that Sward needs; an Error names those that are missing.
        gpu::FeatureChain features;
        host.features = gpu::enableFeatures(host.physical, features);
        host.queueFamily = 0; // of most devices this one draws and computes; describeDevice() checks that
        const float priority = 1.0f;
        const VkDeviceQueueCreateInfo queues{
            VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO, nullptr, 0, host.queueFamily, 1, &priority};
        const VkDeviceCreateInfo info{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO, &features.core, 0, 1, &queues};
        check(vkCreateDevice(host.physical, &info, nullptr, &host.device));
        vkGetDeviceQueue(host.device, host.queueFamily, 0, &host.queue);

        VkCommandPoolCreateInfo poolInfo{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
        poolInfo.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
        VkCommandPool pool = VK_NULL_HANDLE;
        check(vkCreateCommandPool(host.device, &poolInfo, nullptr, &pool));
        const VkCommandBufferAllocateInfo buffers{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO, nullptr, pool,
                                                  VK_COMMAND_BUFFER_LEVEL_PRIMARY, 1};
        check(vkAllocateCommandBuffers(host.device, &buffers, &commands));
    }

    template <typename Record>
    void submitAndWait(const Record& record) const
    {
        const VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
        check(vkBeginCommandBuffer(commands, &begin));
        record();
        check(vkEndCommandBuffer(commands));
        VkSubmitInfo submit{VK_STRUCTURE_TYPE_SUBMIT_INFO};
        submit.commandBufferCount = 1;
        submit.pCommandBuffers = &commands;
        check(vkQueueSubmit(host.queue, 1, &submit, VK_NULL_HANDLE));
        check(vkQueueWaitIdle(host.queue));
    }

    VkDeviceMemory allocate(const VkMemoryRequirements& needs, VkMemoryPropertyFlags wanted) const
    {
        VkPhysicalDeviceMemoryProperties memory;
        vkGetPhysicalDeviceMemoryProperties(host.physical, &memory);
        std::uint32_t type = 0;
        while (type < memory.memoryTypeCount && ((needs.memoryTypeBits >> type & 1u) == 0 ||
                                                 (memory.memoryTypes[type].propertyFlags & wanted) != wanted))
            ++type;
        const VkMemoryAllocateInfo info{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, nullptr, needs.size, type};
        VkDeviceMemory allocated = VK_NULL_HANDLE;
        check(vkAllocateMemory(host.device, &info, nullptr, &allocated));
        return allocated;
    }
};

struct Picture {
    VkImage image = VK_NULL_HANDLE;
    VkImageView view = VK_NULL_HANDLE;
    VkImageSubresourceRange range;

    Picture(const Vulkan& vulkan, VkFormat format, VkImageUsageFlags usage, VkImageAspectFlags aspect)
        : range{aspect, 0, 1, 0, 1}
    {
        VkImageCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO, nullptr, 0, VK_IMAGE_TYPE_2D, format};
        info.extent = {size.width, size.height, 1};
        info.mipLevels = info.arrayLayers = 1;
        info.samples = VK_SAMPLE_COUNT_1_BIT;
        info.usage = usage;
        check(vkCreateImage(vulkan.host.device, &info, nullptr, &image));
        VkMemoryRequirements needs;
        vkGetImageMemoryRequirements(vulkan.host.device, image, &needs);
        check(vkBindImageMemory(vulkan.host.device, image, vulkan.allocate(needs, 0), 0));
        const VkImageViewCreateInfo viewInfo{
            VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO, nullptr, 0, image, VK_IMAGE_VIEW_TYPE_2D, format, {}, range};
        check(vkCreateImageView(vulkan.host.device, &viewInfo, nullptr, &view));
    }

    void transition(VkCommandBuffer commands, VkImageLayout from, VkImageLayout to) const
    {
        VkImageMemoryBarrier barrier{VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER};
        barrier.srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT;
        barrier.dstAccessMask = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT;
        barrier.oldLayout = from;
        barrier.newLayout = to;
        barrier.image = image;
        barrier.subresourceRange = range;
        constexpr VkPipelineStageFlags all = VK_PIPELINE_STAGE_ALL_COMMANDS_BIT;
        vkCmdPipelineBarrier(commands, all, all, 0, 0, nullptr, 0, nullptr, 1, &barrier);
    }
};

void draw(const Vulkan& vulkan, const char* fieldFile, const char* pictureFile)
{
    const VkCommandBuffer commands = vulkan.commands;
    const Picture color(vulkan, colorFormat, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
                        VK_IMAGE_ASPECT_COLOR_BIT);
    const Picture depth(vulkan, depthFormat, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT, VK_IMAGE_ASPECT_DEPTH_BIT);
    const VkBufferCreateInfo bufferInfo{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO, nullptr, 0, 4 * size.width * size.height,
                                        VK_BUFFER_USAGE_TRANSFER_DST_BIT};
    VkBuffer buffer = VK_NULL_HANDLE;
    check(vkCreateBuffer(vulkan.host.device, &bufferInfo, nullptr, &buffer));
    VkMemoryRequirements needs;
    vkGetBufferMemoryRequirements(vulkan.host.device, buffer, &needs);
    const VkDeviceMemory memory =
        vulkan.allocate(needs, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
    check(vkBindBufferMemory(vulkan.host.device, buffer, memory, 0));

    // 2. The context outlives all that is made with it. Without HostDevice::getInstanceProcAddr it
    // is described by the system's loader.
    const gpu::DeviceContext context = gpu::describeDevice(vulkan.host);

    // 3. The field is read from its file, and comes to the device by the host's own commands.
    field::MappedField mapped = field::readField(fieldFile);
    const render::FrameSettings settings = render::FrameSettings::of(mapped.view());
    const auto lawn = std::make_shared<render::ResidentField>(context, std::move(mapped));
    vulkan.submitAndWait([&] { lawn->recordUpload(commands); });
    lawn->releaseStaging();

    // 4. All grass of the world, with one lawn, and what it is drawn into.
    render::Grass grass(context, {.framesInFlight = 1});
    grass.add({lawn, {.position = {0.0, 0.0, 0.0}, .scale = 1.0}});
    const render::BladeTarget target(context, {.colorFormats = {colorFormat}, .depthFormat = depthFormat});

    // A camera in front of the lawn; reversed depth, so that near and far change places.
    const glm::dvec3 middle = lawn->origin() + glm::dvec3(lawn->content().centre());
    const double extent = double(lawn->content().size().x);
    const glm::dmat4 worldToClip =
        glm::scale(glm::dmat4(1.0), {1.0, -1.0, 1.0}) *
        glm::perspectiveRH_ZO(0.7, double(size.width) / size.height, 100.0 * extent, 0.001 * extent) *
        glm::lookAt(middle + extent * glm::dvec3(0.3, 0.3, 0.8), middle, glm::dvec3(0.0, 1.0, 0.0));
    const render::HostView view{.worldToClip = worldToClip, .size = {size.width, size.height}};

    // 5. A frame begins when the former commands of its slot have completed.
    grass.begin(0, {.time = 1.0, .views = {&view, 1}, .settings = settings});
    vulkan.submitAndWait([&] {
        grass.recordUpdate(commands);    // blades move, once for all views
        grass.recordCull(commands, 0);   // for each view
        grass.recordRaster(commands, 0); // likewise, for GPUs; may be left out

        color.transition(commands, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_ATTACHMENT_OPTIMAL);
        depth.transition(commands, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_ATTACHMENT_OPTIMAL);
        VkRenderingAttachmentInfo attachments[2]{{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO, nullptr, color.view},
                                                 {VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO, nullptr, depth.view}};
        for (VkRenderingAttachmentInfo& attachment : attachments) {
            attachment.imageLayout = VK_IMAGE_LAYOUT_ATTACHMENT_OPTIMAL;
            attachment.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
            attachment.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
        }
        attachments[0].clearValue.color = {{0.35f, 0.55f, 0.85f, 1.0f}};
        attachments[1].clearValue.depthStencil = {0.0f, 0}; // reversed depth: far is 0
        const VkRenderingInfo rendering{
            VK_STRUCTURE_TYPE_RENDERING_INFO, nullptr, 0, {{0, 0}, size}, 1, 0, 1, &attachments[0], &attachments[1]};
        const VkViewport viewport{0.0f, 0.0f, float(size.width), float(size.height), 0.0f, 1.0f};
        vkCmdBeginRendering(commands, &rendering);
        vkCmdSetViewport(commands, 0, 1, &viewport);
        vkCmdSetScissor(commands, 0, 1, &rendering.renderArea);
        // The host draws its ground and its other things here: the grass itself draws none.
        // 6. Blades, among them.
        grass.recordDraw(commands, 0, target);
        vkCmdEndRendering(commands);

        color.transition(commands, VK_IMAGE_LAYOUT_ATTACHMENT_OPTIMAL, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
        const VkBufferImageCopy copy{0, 0, 0, {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1}, {}, {size.width, size.height, 1}};
        vkCmdCopyImageToBuffer(commands, color.image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, buffer, 1, &copy);
    });

    void* mappedPixels = nullptr;
    check(vkMapMemory(vulkan.host.device, memory, 0, VK_WHOLE_SIZE, 0, &mappedPixels));
    const auto* const pixels = static_cast<const unsigned char*>(mappedPixels);
    std::FILE* const file = std::fopen(pictureFile, "wb");
    if (file == nullptr)
        throw std::runtime_error(std::string("cannot write ") + pictureFile);
    std::fprintf(file, "P6\n%u %u\n255\n", size.width, size.height);
    for (std::uint32_t i = 0; i < size.width * size.height; ++i)
        std::fwrite(pixels + 4 * i, 1, 3, file);
    std::fclose(file);
    std::printf("%s drew %llu blades\n", context.name.c_str(),
                static_cast<unsigned long long>(grass.stats(0, 0).drawn));
}

int main(int argc, char** argv)
try {
    if (argc != 3)
        throw std::runtime_error("usage: quick_start FIELD.sward OUT.ppm");
    const Vulkan vulkan;
    draw(vulkan, argv[1], argv[2]);
} catch (const std::exception& error) { // sward::Error as well
    std::fprintf(stderr, "quick_start: %s\n", error.what());
    return 1;
}
