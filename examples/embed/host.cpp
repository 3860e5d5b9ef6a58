#include "host.h"

#include <box.frag.h>
#include <box.vert.h>
#include <png.h>

#include <cmath>
#include <stdexcept>
#include <string>

namespace gpu = sward::gpu;

namespace {

constexpr auto colorLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
constexpr auto depthLayout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
constexpr VkClearColorValue sky{{0.35f, 0.55f, 0.85f, 1.0f}};

struct BoxPush {
    glm::mat4 toClip;
    glm::vec4 color;
    glm::vec4 sun;
};

void check(VkResult result)
{
    if (result != VK_SUCCESS)
        throw std::runtime_error("Vulkan says " + std::to_string(result));
}

template <typename Info, typename Handle>
Handle make(VkResult (*create)(VkDevice, const Info*, const VkAllocationCallbacks*, Handle*), VkDevice device,
            const Info& info)
{
    Handle handle = VK_NULL_HANDLE;
    check(create(device, &info, nullptr, &handle));
    return handle;
}

/// All that came before is done and seen before what comes next.
void turn(VkCommandBuffer commands, VkImage image, VkImageAspectFlags aspect, VkImageLayout from, VkImageLayout to)
{
    constexpr VkPipelineStageFlags all = VK_PIPELINE_STAGE_ALL_COMMANDS_BIT;
    constexpr VkAccessFlags any = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT;
    VkImageMemoryBarrier barrier{VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER, nullptr, any, any};
    barrier.oldLayout = from;
    barrier.newLayout = to;
    barrier.image = image;
    barrier.subresourceRange = {aspect, 0, 1, 0, 1};
    vkCmdPipelineBarrier(commands, all, all, 0, 0, nullptr, 0, nullptr, 1, &barrier);
}

} // namespace

Host::Host(bool reversed, bool pass)
    : isReversed(reversed)
    , hasRenderPass(pass)
{
    VkApplicationInfo application{VK_STRUCTURE_TYPE_APPLICATION_INFO};
    application.apiVersion = VK_API_VERSION_1_3;
    VkInstanceCreateInfo instanceInfo{VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
    instanceInfo.pApplicationInfo = &application;
    check(vkCreateInstance(&instanceInfo, nullptr, &instance));
    std::uint32_t one = 1;
    if (vkEnumeratePhysicalDevices(instance, &one, &physical) < VK_SUCCESS || one == 0)
        throw std::runtime_error("there is no Vulkan device");

    // What Sward must have, and what it uses where it is; a host adds its own.
    gpu::FeatureChain supported, wanted;
    vkGetPhysicalDeviceFeatures2(physical, &supported.core);
    for (const std::string& name : gpu::missingFeatures(supported))
        throw std::runtime_error("the device has no " + name);
    features = gpu::enableFeatures(supported, wanted);

    const float priority = 1.0f;
    const VkDeviceQueueCreateInfo queues{VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO, nullptr, 0, 0, 1, &priority};
    const VkDeviceCreateInfo deviceInfo{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO, &wanted.core, 0, 1, &queues};
    check(vkCreateDevice(physical, &deviceInfo, nullptr, &device));
    vkGetDeviceQueue(device, 0, 0, &queue);
    const VkCommandPoolCreateInfo poolInfo{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
    pool_ = make(vkCreateCommandPool, device, poolInfo);
    color_ = picture(colorFormat, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
                     VK_IMAGE_ASPECT_COLOR_BIT);
    depth_ = picture(depthFormat, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT, VK_IMAGE_ASPECT_DEPTH_BIT);
    if (hasRenderPass)
        makeRenderPass();
    makeBoxes();
}

Host::~Host()
{
    vkDestroyPipeline(device, boxes_, nullptr);
    vkDestroyPipelineLayout(device, layout_, nullptr);
    vkDestroyFramebuffer(device, framebuffer_, nullptr);
    vkDestroyRenderPass(device, renderPass, nullptr);
    for (const Image& image : {color_, depth_}) {
        vkDestroyImageView(device, image.view, nullptr);
        vkDestroyImage(device, image.image, nullptr);
        vkFreeMemory(device, image.memory, nullptr);
    }
    vkDestroyCommandPool(device, pool_, nullptr);
    vkDestroyDevice(device, nullptr);
    vkDestroyInstance(instance, nullptr);
}

VkDeviceMemory Host::allocate(const VkMemoryRequirements& needs, VkMemoryPropertyFlags flags) const
{
    VkPhysicalDeviceMemoryProperties memory;
    vkGetPhysicalDeviceMemoryProperties(physical, &memory);
    VkMemoryAllocateInfo info{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, nullptr, needs.size, 0};
    while ((needs.memoryTypeBits >> info.memoryTypeIndex & 1u) == 0 ||
           (memory.memoryTypes[info.memoryTypeIndex].propertyFlags & flags) != flags)
        ++info.memoryTypeIndex;
    return make(vkAllocateMemory, device, info);
}

Image Host::picture(VkFormat format, VkImageUsageFlags usage, VkImageAspectFlags aspect) const
{
    VkImageCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO, nullptr, 0, VK_IMAGE_TYPE_2D, format};
    info.extent = {size.width, size.height, 1};
    info.mipLevels = info.arrayLayers = 1;
    info.samples = VK_SAMPLE_COUNT_1_BIT;
    info.usage = usage;
    Image result;
    result.image = make(vkCreateImage, device, info);
    VkMemoryRequirements needs;
    vkGetImageMemoryRequirements(device, result.image, &needs);
    result.memory = allocate(needs, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
    check(vkBindImageMemory(device, result.image, result.memory, 0));
    VkImageViewCreateInfo view{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO, nullptr, 0, result.image};
    view.viewType = VK_IMAGE_VIEW_TYPE_2D;
    view.format = format;
    view.subresourceRange = {aspect, 0, 1, 0, 1};
    result.view = make(vkCreateImageView, device, view);
    return result;
}

void Host::makeRenderPass()
{
    VkAttachmentDescription attachments[2]{};
    for (int i = 0; i < 2; ++i) {
        attachments[i].format = i == 0 ? colorFormat : depthFormat;
        attachments[i].samples = VK_SAMPLE_COUNT_1_BIT;
        attachments[i].loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
        attachments[i].storeOp = i == 0 ? VK_ATTACHMENT_STORE_OP_STORE : VK_ATTACHMENT_STORE_OP_DONT_CARE;
        attachments[i].stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
        attachments[i].stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
        attachments[i].initialLayout = i == 0 ? colorLayout : depthLayout;
        attachments[i].finalLayout = attachments[i].initialLayout;
    }
    const VkAttachmentReference colorReference{0, colorLayout}, depthReference{1, depthLayout};
    VkSubpassDescription subpass{};
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &colorReference;
    subpass.pDepthStencilAttachment = &depthReference;
    const VkRenderPassCreateInfo info{
        VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO, nullptr, 0, 2, attachments, 1, &subpass};
    renderPass = make(vkCreateRenderPass, device, info);
    const VkImageView views[]{color_.view, depth_.view};
    const VkFramebufferCreateInfo frame{
        VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO, nullptr, 0, renderPass, 2, views, size.width, size.height, 1};
    framebuffer_ = make(vkCreateFramebuffer, device, frame);
}

void Host::makeBoxes()
{
    const VkPushConstantRange range{VK_SHADER_STAGE_VERTEX_BIT, 0, sizeof(BoxPush)};
    VkPipelineLayoutCreateInfo layoutInfo{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
    layoutInfo.pushConstantRangeCount = 1;
    layoutInfo.pPushConstantRanges = &range;
    layout_ = make(vkCreatePipelineLayout, device, layoutInfo);
    VkPipelineShaderStageCreateInfo stages[2]{};
    for (int i = 0; i < 2; ++i) {
        const VkShaderModuleCreateInfo code{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO, nullptr, 0,
                                            i == 0 ? sizeof boxVert : sizeof boxFrag, i == 0 ? boxVert : boxFrag};
        stages[i] = {VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO};
        stages[i].stage = i == 0 ? VK_SHADER_STAGE_VERTEX_BIT : VK_SHADER_STAGE_FRAGMENT_BIT;
        stages[i].module = make(vkCreateShaderModule, device, code);
        stages[i].pName = "main";
    }
    const VkPipelineVertexInputStateCreateInfo none{VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO};
    VkPipelineInputAssemblyStateCreateInfo assembly{VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO};
    assembly.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
    const VkViewport viewport{0, 0, float(size.width), float(size.height), 0, 1};
    const VkRect2D all{{0, 0}, size};
    const VkPipelineViewportStateCreateInfo view{
        VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO, nullptr, 0, 1, &viewport, 1, &all};
    VkPipelineRasterizationStateCreateInfo raster{VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO};
    raster.lineWidth = 1.0f;
    const VkPipelineMultisampleStateCreateInfo samples{VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO,
                                                       nullptr, 0, VK_SAMPLE_COUNT_1_BIT};
    VkPipelineDepthStencilStateCreateInfo depth{VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO};
    depth.depthTestEnable = depth.depthWriteEnable = VK_TRUE;
    depth.depthCompareOp = isReversed ? VK_COMPARE_OP_GREATER : VK_COMPARE_OP_LESS;
    VkPipelineColorBlendAttachmentState written{};
    written.colorWriteMask = 15;
    VkPipelineColorBlendStateCreateInfo blend{VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO};
    blend.attachmentCount = 1;
    blend.pAttachments = &written;
    VkPipelineRenderingCreateInfo rendering{VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO};
    rendering.colorAttachmentCount = 1;
    rendering.pColorAttachmentFormats = &colorFormat;
    rendering.depthAttachmentFormat = depthFormat;
    VkGraphicsPipelineCreateInfo info{VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO};
    info.pNext = hasRenderPass ? nullptr : &rendering;
    info.renderPass = renderPass;
    info.stageCount = 2;
    info.pStages = stages;
    info.pVertexInputState = &none;
    info.pInputAssemblyState = &assembly;
    info.pViewportState = &view;
    info.pRasterizationState = &raster;
    info.pMultisampleState = &samples;
    info.pDepthStencilState = &depth;
    info.pColorBlendState = &blend;
    info.layout = layout_;
    check(vkCreateGraphicsPipelines(device, VK_NULL_HANDLE, 1, &info, nullptr, &boxes_));
    for (const VkPipelineShaderStageCreateInfo& stage : stages)
        vkDestroyShaderModule(device, stage.module, nullptr);
}

void Host::submitAndWait(const std::function<void(VkCommandBuffer)>& record) const
{
    const VkCommandBufferAllocateInfo info{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO, nullptr, pool_,
                                           VK_COMMAND_BUFFER_LEVEL_PRIMARY, 1};
    VkCommandBuffer commands = VK_NULL_HANDLE;
    check(vkAllocateCommandBuffers(device, &info, &commands));
    const VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
    check(vkBeginCommandBuffer(commands, &begin));
    record(commands);
    check(vkEndCommandBuffer(commands));
    const VkSubmitInfo submission{VK_STRUCTURE_TYPE_SUBMIT_INFO, nullptr, 0, nullptr, nullptr, 1, &commands};
    check(vkQueueSubmit(queue, 1, &submission, VK_NULL_HANDLE));
    check(vkQueueWaitIdle(queue));
    vkFreeCommandBuffers(device, pool_, 1, &commands);
}

void Host::beginPicture(VkCommandBuffer commands) const
{
    turn(commands, color_.image, VK_IMAGE_ASPECT_COLOR_BIT, VK_IMAGE_LAYOUT_UNDEFINED, colorLayout);
    turn(commands, depth_.image, VK_IMAGE_ASPECT_DEPTH_BIT, VK_IMAGE_LAYOUT_UNDEFINED, depthLayout);
    VkClearValue clear[2]{{sky}, {}};
    clear[1].depthStencil.depth = isReversed ? 0.0f : 1.0f;
    if (hasRenderPass) {
        const VkRenderPassBeginInfo pass{
            VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO, nullptr, renderPass, framebuffer_, {{0, 0}, size}, 2, clear};
        vkCmdBeginRenderPass(commands, &pass, VK_SUBPASS_CONTENTS_INLINE);
    } else {
        VkRenderingAttachmentInfo attachments[2]{};
        for (int i = 0; i < 2; ++i) {
            attachments[i] = {VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
            attachments[i].imageView = i == 0 ? color_.view : depth_.view;
            attachments[i].imageLayout = i == 0 ? colorLayout : depthLayout;
            attachments[i].loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
            attachments[i].clearValue = clear[i];
        }
        VkRenderingInfo info{VK_STRUCTURE_TYPE_RENDERING_INFO};
        info.renderArea.extent = size;
        info.layerCount = info.colorAttachmentCount = 1;
        info.pColorAttachments = &attachments[0];
        info.pDepthAttachment = &attachments[1];
        vkCmdBeginRendering(commands, &info);
    }
}

void Host::endPicture(VkCommandBuffer commands) const
{
    hasRenderPass ? vkCmdEndRenderPass(commands) : vkCmdEndRendering(commands);
}

void Host::draw(VkCommandBuffer commands, const std::vector<Box>& boxes, glm::dmat4 worldToClip, glm::vec3 sun) const
{
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, boxes_);
    for (const Box& box : boxes) {
        glm::vec3 turned;
        for (int i = 0; i < 3; ++i)
            turned[i] = glm::dot(glm::normalize(glm::vec3(box.toWorld[i])), glm::normalize(sun));
        const BoxPush push{glm::mat4(worldToClip * box.toWorld), glm::vec4(box.color, 1.0f), glm::vec4(turned, 0.0f)};
        vkCmdPushConstants(commands, layout_, VK_SHADER_STAGE_VERTEX_BIT, 0, sizeof push, &push);
        vkCmdDraw(commands, 36, 1, 0, 0);
    }
}

glm::dmat4 Host::projection(double fovY) const
{
    constexpr double near = 0.1, far = 100.0;
    const double focal = 1.0 / std::tan(0.5 * fovY);
    const double range = 1.0 / (far - near);
    glm::dmat4 matrix(0.0);
    matrix[0][0] = focal * size.height / size.width;
    matrix[1][1] = -focal;
    matrix[2][2] = isReversed ? near * range : -far * range;
    matrix[3][2] = (isReversed ? 1.0 : -1.0) * near * far * range;
    matrix[2][3] = -1.0;
    return matrix;
}

void Host::save(const char* path) const
{
    const VkBufferCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO, nullptr, 0, 4 * size.width * size.height,
                                  VK_BUFFER_USAGE_TRANSFER_DST_BIT};
    const VkBuffer buffer = make(vkCreateBuffer, device, info);
    VkMemoryRequirements needs;
    vkGetBufferMemoryRequirements(device, buffer, &needs);
    const VkDeviceMemory memory =
        allocate(needs, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
    check(vkBindBufferMemory(device, buffer, memory, 0));
    submitAndWait([&](VkCommandBuffer commands) {
        constexpr VkImageLayout source = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;
        turn(commands, color_.image, VK_IMAGE_ASPECT_COLOR_BIT, colorLayout, source);
        const VkBufferImageCopy region{0, 0, 0, {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1}, {}, {size.width, size.height, 1}};
        vkCmdCopyImageToBuffer(commands, color_.image, source, buffer, 1, &region);
    });
    void* pixels = nullptr;
    check(vkMapMemory(device, memory, 0, VK_WHOLE_SIZE, 0, &pixels));
    png_image png{nullptr, PNG_IMAGE_VERSION, size.width, size.height, PNG_FORMAT_RGBA, 0, 0, 0, {}};
    if (png_image_write_to_file(&png, path, 0, pixels, 0, nullptr) == 0)
        throw std::runtime_error(std::string(path) + ": " + png.message);
    vkDestroyBuffer(device, buffer, nullptr);
    vkFreeMemory(device, memory, nullptr);
}
