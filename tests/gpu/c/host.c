/* A host in C: reads a field, draws its grass into a picture of its own, and checks what comes of
 * it. Usage: host FIELD.sward DAMAGED.sward CHANGE.swdelta. Prints what is wrong and ends with 1. */
#include "c/sward.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { width = 160, height = 90 };

#define REQUIRE(condition)                                                                         \
    do {                                                                                           \
        if (!(condition)) {                                                                        \
            fprintf(stderr, "line %d: %s: %s\n", __LINE__, #condition, sward_last_error());        \
            exit(1);                                                                               \
        }                                                                                          \
    } while (0)

/* The message of the last call has these words, and no name of the C++ library. */
static void require_words(const char* words)
{
    REQUIRE(strstr(sward_last_error(), words) != NULL);
    const char* const foreign[] = {"Grass", "Host", "Budget", "Field", "Picture", "gpu::"};
    for (unsigned i = 0; i < sizeof foreign / sizeof *foreign; ++i)
        REQUIRE(strstr(sward_last_error(), foreign[i]) == NULL);
    for (const char* c = sward_last_error(); c[0] != '\0' && c[1] != '\0'; ++c)
        REQUIRE(!(islower((unsigned char)c[0]) && isupper((unsigned char)c[1])));
}

static sward_field* read_field(const char* path, const char* damaged)
{
    sward_field* field = NULL;
    REQUIRE(sward_field_open("/does/not/exist.sward", &field) == SWARD_ERROR_IO);
    REQUIRE(field == NULL && strstr(sward_last_error(), "exist.sward") != NULL);
    REQUIRE(sward_field_open(damaged, &field) == SWARD_ERROR_INPUT);
    REQUIRE(field == NULL && strstr(sward_last_error(), damaged) != NULL);
    REQUIRE(sward_field_open(NULL, &field) == SWARD_ERROR_USAGE);
    REQUIRE(strcmp(sward_last_error(), "path is null") == 0);
    REQUIRE(sward_field_open(path, &field) == SWARD_OK);
    REQUIRE(strcmp(sward_last_error(), "") == 0);

    sward_field_info info;
    REQUIRE(sward_field_get_info(field, &info) == SWARD_OK);
    REQUIRE(info.blade_count > 100 && info.patch_count > 0);
    REQUIRE(sward_field_species_name(field, 0) != NULL);
    REQUIRE(sward_field_species_name(field, info.species_count) == NULL);
    sward_blade* blades = malloc(sizeof *blades * (size_t)info.blade_count);
    REQUIRE(blades != NULL);
    REQUIRE(sward_field_read_blades(field, 0, info.blade_count, blades) == SWARD_OK);
    for (uint64_t i = 0; i < info.blade_count; ++i) {
        const sward_blade* blade = blades + i;
        float square = 0.0f;
        for (int axis = 0; axis < 3; ++axis) {
            square += blade->up[axis] * blade->up[axis];
            REQUIRE(blade->root[axis] >= info.origin[axis] + (double)info.low[axis] - 1e-3);
            REQUIRE(blade->root[axis] <= info.origin[axis] + (double)info.high[axis] + 1e-3);
        }
        REQUIRE(fabsf(square - 1.0f) < 1e-4f);
        REQUIRE(blade->height > 0.0f && blade->species < info.species_count);
        REQUIRE(blade->exposure >= 0.0f && blade->exposure <= 1.0f && blade->ribbon < 64);
        REQUIRE(blade->clump < 256 && blade->group < info.patch_count);
    }
    /* A part is the same as that part of all. */
    sward_blade part[10];
    REQUIRE(sward_field_read_blades(field, 50, 10, part) == SWARD_OK);
    for (int i = 0; i < 10; ++i)
        REQUIRE(part[i].id == blades[50 + i].id && part[i].height == blades[50 + i].height);
    REQUIRE(sward_field_read_blades(field, info.blade_count, 1, part) == SWARD_ERROR_USAGE);
    REQUIRE(sward_field_read_blades(field, UINT64_MAX, 2, part) == SWARD_ERROR_USAGE);
    free(blades);
    return field;
}

/* The host's device. */
static VkInstance instance;
static VkPhysicalDevice physical;
static VkDevice device;
static VkQueue queue;
static uint32_t family;
static VkCommandPool pool;

static sward_features* make_device(void)
{
    const VkApplicationInfo application = {.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO,
                                           .apiVersion = VK_API_VERSION_1_3};
    const VkInstanceCreateInfo instance_info = {.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO,
                                                .pApplicationInfo = &application};
    REQUIRE(vkCreateInstance(&instance_info, NULL, &instance) == VK_SUCCESS);
    VkPhysicalDevice found[16];
    uint32_t count = 16;
    REQUIRE(vkEnumeratePhysicalDevices(instance, &count, found) >= VK_SUCCESS);
    sward_features* features = NULL;
    for (uint32_t i = 0; i < count && features == NULL; ++i)
        if (sward_features_create(found[i], &features) == SWARD_OK)
            physical = found[i];
    REQUIRE(features != NULL);

    VkQueueFamilyProperties families[16];
    count = 16;
    vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, families);
    const VkQueueFlags needed = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
    while (family < count && (families[family].queueFlags & needed) != needed)
        ++family;
    REQUIRE(family < count);
    const float priority = 1.0f;
    const VkDeviceQueueCreateInfo queue_info = {.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO,
                                                .queueFamilyIndex = family,
                                                .queueCount = 1,
                                                .pQueuePriorities = &priority};
    const VkDeviceCreateInfo info = {.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
                                     .pNext = sward_features_chain(features),
                                     .queueCreateInfoCount = 1,
                                     .pQueueCreateInfos = &queue_info};
    REQUIRE(vkCreateDevice(physical, &info, NULL, &device) == VK_SUCCESS);
    vkGetDeviceQueue(device, family, 0, &queue);
    const VkCommandPoolCreateInfo pool_info = {.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
                                               .queueFamilyIndex = family};
    REQUIRE(vkCreateCommandPool(device, &pool_info, NULL, &pool) == VK_SUCCESS);
    return features;
}

static uint32_t memory_type(uint32_t allowed, VkMemoryPropertyFlags wanted)
{
    VkPhysicalDeviceMemoryProperties memory;
    vkGetPhysicalDeviceMemoryProperties(physical, &memory);
    uint32_t type = 0;
    while (type < memory.memoryTypeCount &&
           ((allowed >> type & 1u) == 0 ||
            (memory.memoryTypes[type].propertyFlags & wanted) != wanted))
        ++type;
    REQUIRE(type < memory.memoryTypeCount);
    return type;
}

struct picture {
    VkImage image;
    VkDeviceMemory memory;
    VkImageView view;
};

static struct picture make_picture(VkFormat format, VkImageUsageFlags usage,
                                   VkImageAspectFlags aspect)
{
    struct picture made;
    const VkImageCreateInfo info = {.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
                                    .imageType = VK_IMAGE_TYPE_2D,
                                    .format = format,
                                    .extent = {width, height, 1},
                                    .mipLevels = 1,
                                    .arrayLayers = 1,
                                    .samples = VK_SAMPLE_COUNT_1_BIT,
                                    .usage = usage};
    REQUIRE(vkCreateImage(device, &info, NULL, &made.image) == VK_SUCCESS);
    VkMemoryRequirements needs;
    vkGetImageMemoryRequirements(device, made.image, &needs);
    const VkMemoryAllocateInfo allocation = {.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO,
                                             .allocationSize = needs.size,
                                             .memoryTypeIndex =
                                                 memory_type(needs.memoryTypeBits, 0)};
    REQUIRE(vkAllocateMemory(device, &allocation, NULL, &made.memory) == VK_SUCCESS);
    REQUIRE(vkBindImageMemory(device, made.image, made.memory, 0) == VK_SUCCESS);
    const VkImageViewCreateInfo view = {.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
                                        .image = made.image,
                                        .viewType = VK_IMAGE_VIEW_TYPE_2D,
                                        .format = format,
                                        .subresourceRange = {aspect, 0, 1, 0, 1}};
    REQUIRE(vkCreateImageView(device, &view, NULL, &made.view) == VK_SUCCESS);
    return made;
}

static void destroy_picture(struct picture picture)
{
    vkDestroyImageView(device, picture.view, NULL);
    vkDestroyImage(device, picture.image, NULL);
    vkFreeMemory(device, picture.memory, NULL);
}

static VkCommandBuffer begin_commands(void)
{
    VkCommandBuffer commands = VK_NULL_HANDLE;
    const VkCommandBufferAllocateInfo info = {
        .sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
        .commandPool = pool,
        .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
        .commandBufferCount = 1};
    REQUIRE(vkAllocateCommandBuffers(device, &info, &commands) == VK_SUCCESS);
    const VkCommandBufferBeginInfo begin = {.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
    REQUIRE(vkBeginCommandBuffer(commands, &begin) == VK_SUCCESS);
    return commands;
}

static void submit_and_wait(VkCommandBuffer commands)
{
    REQUIRE(vkEndCommandBuffer(commands) == VK_SUCCESS);
    const VkSubmitInfo submit = {.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO,
                                 .commandBufferCount = 1,
                                 .pCommandBuffers = &commands};
    REQUIRE(vkQueueSubmit(queue, 1, &submit, VK_NULL_HANDLE) == VK_SUCCESS);
    REQUIRE(vkQueueWaitIdle(queue) == VK_SUCCESS);
    vkFreeCommandBuffers(device, pool, 1, &commands);
}

static void to_layout(VkCommandBuffer commands, VkImage image, VkImageAspectFlags aspect,
                      VkImageLayout from, VkImageLayout to)
{
    const VkImageMemoryBarrier barrier = {
        .sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER,
        .srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT,
        .dstAccessMask = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT,
        .oldLayout = from,
        .newLayout = to,
        .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
        .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
        .image = image,
        .subresourceRange = {aspect, 0, 1, 0, 1}};
    vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT,
                         VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, 0, 0, NULL, 0, NULL, 1, &barrier);
}

/* A view from 2 m above the middle of a box, straight down: reversed depth, 0.1 m to infinity. */
static sward_view view_from_above(const sward_field_info* info)
{
    sward_view view = {.width = width, .height = height, .samples = 1, .has_reversed_z = true};
    double eye[3];
    for (int i = 0; i < 3; ++i)
        eye[i] = info->origin[i] + 0.5 * (double)(info->low[i] + info->high[i]);
    eye[1] = info->origin[1] + (double)info->high[1] + 2.0;
    /* Right is +x, down in the picture is +z, forward is -y. */
    const double across = 1.0, down = 1.0 * width / height;
    const double rows[4][4] = {{across, 0, 0, -across * eye[0]},
                               {0, 0, down, -down * eye[2]},
                               {0, 0, 0, 0.1},
                               {0, -1, 0, eye[1]}};
    for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 4; ++column)
            view.world_to_clip[4 * column + row] = rows[row][column];
    return view;
}

/* Sum of the channels of the picture drawn last. */
static unsigned long brightness = 0;

/* Ends the commands of a picture in `layout`, and reads it: returns how many pixels are grass. */
static unsigned submit_and_count(VkCommandBuffer commands, VkImage image, VkImageLayout layout)
{
    const VkDeviceSize bytes = 4u * width * height;
    const VkBufferCreateInfo buffer_info = {.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO,
                                            .size = bytes,
                                            .usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT};
    VkBuffer buffer;
    REQUIRE(vkCreateBuffer(device, &buffer_info, NULL, &buffer) == VK_SUCCESS);
    VkMemoryRequirements needs;
    vkGetBufferMemoryRequirements(device, buffer, &needs);
    const VkMemoryAllocateInfo allocation = {
        .sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO,
        .allocationSize = needs.size,
        .memoryTypeIndex = memory_type(needs.memoryTypeBits,
                                       VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT |
                                           VK_MEMORY_PROPERTY_HOST_COHERENT_BIT)};
    VkDeviceMemory memory;
    REQUIRE(vkAllocateMemory(device, &allocation, NULL, &memory) == VK_SUCCESS);
    REQUIRE(vkBindBufferMemory(device, buffer, memory, 0) == VK_SUCCESS);

    const VkImageAspectFlags aspect = VK_IMAGE_ASPECT_COLOR_BIT;
    to_layout(commands, image, aspect, layout, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
    const VkBufferImageCopy copy = {.imageSubresource = {aspect, 0, 0, 1},
                                    .imageExtent = {width, height, 1}};
    vkCmdCopyImageToBuffer(commands, image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, buffer, 1, &copy);
    submit_and_wait(commands);

    void* mapped = NULL;
    REQUIRE(vkMapMemory(device, memory, 0, bytes, 0, &mapped) == VK_SUCCESS);
    unsigned covered = 0;
    brightness = 0;
    for (unsigned i = 0; i < width * height; ++i) {
        const unsigned char* pixel = (const unsigned char*)mapped + 4 * i;
        covered += pixel[0] + pixel[1] + pixel[2] > 0 ? 1u : 0u;
        brightness += (unsigned long)(pixel[0] + pixel[1] + pixel[2]);
    }
    vkDestroyBuffer(device, buffer, NULL);
    vkFreeMemory(device, memory, NULL);
    return covered;
}

/* Draws one frame; returns how many pixels are grass. */
static unsigned draw(sward_grass* grass, const sward_target* target, const sward_frame* frame)
{
    const VkImageAspectFlags color_aspect = VK_IMAGE_ASPECT_COLOR_BIT;
    const struct picture color = make_picture(
        VK_FORMAT_R8G8B8A8_SRGB,
        VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT, color_aspect);
    const struct picture depth =
        make_picture(VK_FORMAT_D32_SFLOAT, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT,
                     VK_IMAGE_ASPECT_DEPTH_BIT);
    REQUIRE(sward_grass_begin(grass, 0, frame) == SWARD_OK);
    VkCommandBuffer commands = begin_commands();
    REQUIRE(sward_grass_record_update(grass, commands) == SWARD_OK);
    REQUIRE(sward_grass_record_cull(grass, commands, 0) == SWARD_OK);
    REQUIRE(sward_grass_record_raster(grass, commands, 0) == SWARD_OK);
    to_layout(commands, color.image, color_aspect, VK_IMAGE_LAYOUT_UNDEFINED,
              VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);
    to_layout(commands, depth.image, VK_IMAGE_ASPECT_DEPTH_BIT, VK_IMAGE_LAYOUT_UNDEFINED,
              VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL);
    const VkRenderingAttachmentInfo color_attachment = {
        .sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
        .imageView = color.view,
        .imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
        .loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR,
        .storeOp = VK_ATTACHMENT_STORE_OP_STORE};
    const VkRenderingAttachmentInfo depth_attachment = {
        .sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
        .imageView = depth.view,
        .imageLayout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL,
        .loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR,
        .storeOp = VK_ATTACHMENT_STORE_OP_STORE};
    const VkRenderingInfo rendering = {.sType = VK_STRUCTURE_TYPE_RENDERING_INFO,
                                       .renderArea = {{0, 0}, {width, height}},
                                       .layerCount = 1,
                                       .colorAttachmentCount = 1,
                                       .pColorAttachments = &color_attachment,
                                       .pDepthAttachment = &depth_attachment};
    const VkViewport viewport = {0.0f, 0.0f, width, height, 0.0f, 1.0f};
    vkCmdBeginRendering(commands, &rendering);
    vkCmdSetViewport(commands, 0, 1, &viewport);
    vkCmdSetScissor(commands, 0, 1, &rendering.renderArea);
    REQUIRE(sward_grass_record_draw(grass, commands, 0, target) == SWARD_OK);
    vkCmdEndRendering(commands);
    const unsigned covered =
        submit_and_count(commands, color.image, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);
    destroy_picture(color);
    destroy_picture(depth);
    return covered;
}

/* Memory for layers, which the CPU reads. */
struct words {
    VkBuffer buffer;
    VkDeviceMemory memory;
    VkDeviceAddress address;
    void* mapped;
};

static struct words make_words(VkDeviceSize bytes)
{
    struct words made;
    const VkBufferCreateInfo info = {.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO,
                                     .size = bytes,
                                     .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT |
                                              VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT};
    REQUIRE(vkCreateBuffer(device, &info, NULL, &made.buffer) == VK_SUCCESS);
    VkMemoryRequirements needs;
    vkGetBufferMemoryRequirements(device, made.buffer, &needs);
    const VkMemoryAllocateFlagsInfo flags = {.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_FLAGS_INFO,
                                             .flags = VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT};
    const VkMemoryAllocateInfo allocation = {
        .sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO,
        .pNext = &flags,
        .allocationSize = needs.size,
        .memoryTypeIndex = memory_type(needs.memoryTypeBits,
                                       VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT |
                                           VK_MEMORY_PROPERTY_HOST_COHERENT_BIT)};
    REQUIRE(vkAllocateMemory(device, &allocation, NULL, &made.memory) == VK_SUCCESS);
    REQUIRE(vkBindBufferMemory(device, made.buffer, made.memory, 0) == VK_SUCCESS);
    const VkBufferDeviceAddressInfo asked = {.sType = VK_STRUCTURE_TYPE_BUFFER_DEVICE_ADDRESS_INFO,
                                             .buffer = made.buffer};
    made.address = vkGetBufferDeviceAddress(device, &asked);
    REQUIRE(vkMapMemory(device, made.memory, 0, bytes, 0, &made.mapped) == VK_SUCCESS);
    return made;
}

static void destroy_words(struct words words)
{
    vkDestroyBuffer(device, words.buffer, NULL);
    vkFreeMemory(device, words.memory, NULL);
}

/* The layers of a frame of the only instance say what its picture shows. */
static void require_layers(const sward_grass* grass, const sward_field* field, uint32_t layers,
                           const uint32_t* words, unsigned covered)
{
    static float depths[width * height];
    static uint64_t ids[width * height];
    sward_instance instance = 0;
    uint32_t count = 0;
    REQUIRE(sward_grass_get_layer_instances(grass, &instance, 1, &count) == SWARD_OK);
    REQUIRE(count == 1 && instance != 0);
    const sward_layer_instance named = {.field = field};
    REQUIRE(sward_layer_read(words, layers, width, height, SWARD_LAYER_DEPTH, NULL, 0, depths,
                             sizeof depths) == SWARD_OK);
    REQUIRE(sward_layer_read(words, layers, width, height, SWARD_LAYER_BLADE, &named, 1, ids,
                             sizeof ids) == SWARD_OK);
    REQUIRE(sward_layer_read(words, layers, width, height, SWARD_LAYER_BLADE, &named, 1, ids, 8) ==
            SWARD_ERROR_USAGE);
    REQUIRE(sward_layer_read(words, layers, width, height, SWARD_LAYER_SUN, NULL, 0, depths, 8) ==
            SWARD_ERROR_USAGE);
    unsigned seen = 0;
    for (unsigned i = 0; i < width * height; ++i) {
        REQUIRE((ids[i] != 0) == (depths[i] < 1e6f));
        REQUIRE(ids[i] == 0 || ids[i] >> 53 == 1);
        seen += ids[i] != 0 ? 1u : 0u;
    }
    REQUIRE(seen >= covered && seen - covered < width); /* some grass may be black */
}

/* Stores one frame over a black picture; returns how many pixels are grass. */
static unsigned store(sward_grass* grass, const sward_field* field, sward_frame frame)
{
    const VkImageAspectFlags aspect = VK_IMAGE_ASPECT_COLOR_BIT;
    const struct picture color = make_picture(VK_FORMAT_R8G8B8A8_UNORM,
                                              VK_IMAGE_USAGE_STORAGE_BIT |
                                                  VK_IMAGE_USAGE_TRANSFER_SRC_BIT |
                                                  VK_IMAGE_USAGE_TRANSFER_DST_BIT,
                                              aspect);
    sward_stored_picture stored = {.color = color.view,
                                   .format = VK_FORMAT_R8G8B8A8_UNORM,
                                   .is_srgb = true,
                                   .width = width,
                                   .height = height - 1};
    sward_view view = frame.views[0];
    view.stored = &stored;
    frame.views = &view;
    REQUIRE(sward_grass_begin(grass, 0, &frame) == SWARD_ERROR_USAGE); /* too low for the view */
    stored.height = height;
    stored.image_format = VK_FORMAT_R8G8B8A8_UNORM;
    stored.image_usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
    REQUIRE(sward_grass_begin(grass, 0, &frame) == SWARD_ERROR_USAGE);
    require_words("VK_IMAGE_USAGE_STORAGE_BIT");
    stored.image_usage = VK_IMAGE_USAGE_STORAGE_BIT;
    stored.is_bgr = true;
    REQUIRE(sward_grass_begin(grass, 0, &frame) == SWARD_ERROR_USAGE);
    require_words("is_bgr is true");
    stored.is_bgr = false;
    const uint32_t layers = SWARD_LAYER_DEPTH | SWARD_LAYER_BLADE;
    const struct words words = make_words(sward_layer_bytes(layers, width, height));
    view.layers = layers;
    REQUIRE(sward_grass_begin(grass, 0, &frame) == SWARD_ERROR_USAGE); /* no address */
    view.layer_words = words.address;
    REQUIRE(sward_grass_begin(grass, 0, &frame) == SWARD_OK);
    REQUIRE(sward_grass_why_not_stored(grass, 0) == NULL);
    REQUIRE(sward_grass_why_not_stored(grass, 1) != NULL);
    VkCommandBuffer commands = begin_commands();
    to_layout(commands, color.image, aspect, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_GENERAL);
    const VkClearColorValue black = {.float32 = {0.0f, 0.0f, 0.0f, 0.0f}};
    const VkImageSubresourceRange all = {aspect, 0, 1, 0, 1};
    vkCmdClearColorImage(commands, color.image, VK_IMAGE_LAYOUT_GENERAL, &black, 1, &all);
    REQUIRE(sward_grass_record_update(grass, commands) == SWARD_OK);
    REQUIRE(sward_grass_record_cull(grass, commands, 0) == SWARD_OK);
    REQUIRE(sward_grass_record_raster(grass, commands, 0) == SWARD_OK);
    const unsigned covered = submit_and_count(commands, color.image, VK_IMAGE_LAYOUT_GENERAL);
    require_layers(grass, field, layers, words.mapped, covered);
    destroy_words(words);
    destroy_picture(color);
    return covered;
}

/* A frame in the host's own light: darker without any around, brighter by a lamp. */
static void light_frame(sward_grass* grass, const sward_target* target, sward_frame frame,
                        const sward_field_info* info)
{
    draw(grass, target, &frame);
    const unsigned long plain = brightness;
    float ambient[27] = {0.0f};
    frame.ambient = ambient;
    draw(grass, target, &frame);
    const unsigned long unlit = brightness;
    REQUIRE(unlit < plain);
    sward_lamp lamps[17] = {{.range = 20.0f, .color = {4.0f, 4.0f, 4.0f}}};
    for (int i = 0; i < 3; ++i)
        lamps[0].position[i] = info->origin[i] + 0.5 * (double)(info->low[i] + info->high[i]);
    lamps[0].position[1] += 1.0;
    frame.lamps = lamps;
    frame.lamp_count = 1;
    draw(grass, target, &frame);
    REQUIRE(brightness > unlit);

    frame.lamp_count = 17;
    REQUIRE(sward_grass_begin(grass, 0, &frame) == SWARD_ERROR_USAGE);
    frame.lamp_count = 1;
    lamps[0].range = 0.0f;
    REQUIRE(sward_grass_begin(grass, 0, &frame) == SWARD_ERROR_USAGE);
    frame.lamp_count = 0;
    sward_view view = frame.views[0];
    const double matrix[16] = {[0] = 1.0, [5] = 1.0, [10] = 1.0, [15] = 1.0};
    const sward_shadow shadow = {.world_to_shadow = matrix, .cascade_count = 1};
    view.shadow = &shadow;
    frame.views = &view;
    REQUIRE(sward_grass_begin(grass, 0, &frame) == SWARD_ERROR_USAGE); /* no image */
}

/* Copies the whole field to the device, and waits. */
static void upload(sward_resident* resident)
{
    VkCommandBuffer commands = begin_commands();
    REQUIRE(sward_resident_record_upload(resident, NULL, 1) == SWARD_ERROR_USAGE);
    REQUIRE(sward_resident_record_upload(resident, commands, VK_WHOLE_SIZE) == SWARD_OK);
    submit_and_wait(commands);
}

/* Draws a field within the smallest budget that shows some of it; it keeps its file. */
static void stream_field(const sward_context* context, const char* path, sward_grass* grass,
                         const sward_target* target, const sward_frame* frame)
{
    sward_field* field = NULL;
    REQUIRE(sward_field_open(path, &field) == SWARD_OK);
    sward_budget budget = {.bytes = 1000, .instances = 1, .views = 1};
    sward_resident* resident = NULL;
    REQUIRE(sward_resident_create_within(context, field, &budget, &resident) ==
            SWARD_ERROR_USAGE); /* no frame in flight */
    require_words("sward_budget::frames_in_flight is 0");
    budget.frames_in_flight = 1;
    REQUIRE(sward_resident_create_within(context, field, &budget, &resident) ==
            SWARD_ERROR_RUNTIME);
    REQUIRE(strstr(sward_last_error(), "budget") != NULL);
    while (sward_resident_create_within(context, field, &budget, &resident) != SWARD_OK)
        budget.bytes += 1 << 15;
    sward_field_destroy(field);
    REQUIRE(sward_resident_is_streamed(resident));
    upload(resident);
    const sward_placement place = {.rotation = {0, 0, 0, 1}, .scale = 1.0};
    sward_instance one = 0;
    REQUIRE(sward_grass_add(grass, resident, &place, &one) == SWARD_OK);
    sward_streaming streaming = {.is_settled = false};
    for (int i = 0; i < 100 && !streaming.is_settled; ++i) {
        REQUIRE(draw(grass, target, frame) > 0);
        REQUIRE(sward_grass_get_streaming(grass, &streaming) == SWARD_OK);
    }
    REQUIRE(streaming.is_settled && streaming.places < streaming.pages);
    REQUIRE(streaming.resident_pages > 0 && streaming.resident_pages <= streaming.places);
    sward_resident_destroy(resident);
}

/* Draws a field with seeds: its stored blades alone, and what two budgets sow beside them. */
static void sow_field(const sward_context* context, const char* path, sward_grass* grass,
                      const sward_target* target, const sward_frame* frame)
{
    const sward_budget budgets[3] = {
        {.instances = 1, .views = 1, .frames_in_flight = 1, .sown_bytes = SWARD_SOWN_NONE},
        {.instances = 1, .views = 1, .frames_in_flight = 1, .waits_for_disk = true,
         .sown_bytes = 1 << 20, .sow_threads = SWARD_SOWN_IN_FRAMES},
        {.instances = 1, .views = 1, .frames_in_flight = 1, .waits_for_disk = true}};
    unsigned long long resident_blades[3];
    for (int i = 0; i < 3; ++i) {
        sward_field* field = NULL;
        REQUIRE(sward_field_open(path, &field) == SWARD_OK);
        sward_resident* resident = NULL;
        REQUIRE(sward_resident_create_within(context, field, &budgets[i], &resident) == SWARD_OK);
        sward_field_destroy(field);
        REQUIRE(sward_resident_is_sown(resident) == (i > 0));
        upload(resident);
        const sward_placement place = {.rotation = {0, 0, 0, 1}, .scale = 1.0};
        sward_instance one = 0;
        REQUIRE(sward_grass_add(grass, resident, &place, &one) == SWARD_OK);
        sward_streaming streaming = {.is_settled = false};
        for (int n = 0; n < 100 && !streaming.is_settled; ++n) {
            REQUIRE(draw(grass, target, frame) > 0);
            if (i == 0)
                break;
            REQUIRE(sward_grass_get_streaming(grass, &streaming) == SWARD_OK);
        }
        REQUIRE(draw(grass, target, frame) > 0); /* counts of a frame with all that is there */
        sward_stats stats;
        REQUIRE(sward_grass_get_stats(grass, 0, 0, &stats) == SWARD_OK);
        resident_blades[i] = stats.resident;
        REQUIRE(sward_grass_remove(grass, one) == SWARD_OK);
        sward_resident_destroy(resident);
    }
    printf("sown: %llu, %llu and %llu blades\n", resident_blades[0], resident_blades[1],
           resident_blades[2]);
    REQUIRE(resident_blades[0] < resident_blades[1] && resident_blades[1] < resident_blades[2]);
}

/* Draws the field before and after an edit that makes some of it bare. */
static void edit_field(const sward_context* context, const sward_field* field, sward_grass* grass,
                       const sward_target* target, const sward_frame* frame, const char* delta)
{
    const sward_budget budget = {
        .instances = 1, .views = 1, .frames_in_flight = 1, .is_editable = true};
    sward_resident* fixed = NULL;
    REQUIRE(sward_resident_create(context, field, &fixed) == SWARD_OK);
    REQUIRE(sward_grass_edit(grass, fixed, field, delta) == SWARD_ERROR_USAGE);
    require_words("sward_budget::is_editable");
    sward_resident_destroy(fixed);
    sward_resident* resident = NULL;
    REQUIRE(sward_resident_create_within(context, field, &budget, &resident) == SWARD_OK);
    upload(resident);
    const sward_placement place = {.rotation = {0, 0, 0, 1}, .scale = 1.0};
    sward_instance one = 0;
    REQUIRE(sward_grass_add(grass, resident, &place, &one) == SWARD_OK);
    const unsigned covered = draw(grass, target, frame);
    sward_stats before, after;
    REQUIRE(sward_grass_get_stats(grass, 0, 0, &before) == SWARD_OK);
    REQUIRE(sward_grass_edit(grass, resident, field, "/does/not/exist.swdelta") == SWARD_ERROR_IO);
    REQUIRE(sward_grass_edit(grass, resident, field, NULL) == SWARD_ERROR_USAGE);
    REQUIRE(sward_grass_edit(grass, resident, field, delta) == SWARD_OK);
    REQUIRE(draw(grass, target, frame) < covered);
    REQUIRE(sward_grass_get_stats(grass, 0, 0, &after) == SWARD_OK);
    REQUIRE(after.resident < before.resident && after.resident > 0);
    printf("edited: %llu of %llu blades\n", (unsigned long long)after.resident,
           (unsigned long long)before.resident);
    REQUIRE(sward_grass_remove(grass, one) == SWARD_OK);
    sward_resident_destroy(resident);
}

/* Calls that a host must not make: none aborts, and each leaves a message that names the fault. */
static void misuse(const sward_context* context, sward_grass* grass, const sward_target* target,
                   const sward_frame* frame)
{
    VkCommandBuffer commands = begin_commands();
    REQUIRE(sward_grass_record_update(grass, commands) == SWARD_ERROR_USAGE);
    require_words("sward_grass_begin()");
    REQUIRE(sward_grass_begin(grass, 0, frame) == SWARD_OK);
    REQUIRE(strcmp(sward_last_error(), "") == 0); /* a success leaves no message */
    REQUIRE(sward_grass_record_cull(grass, commands, 0) == SWARD_ERROR_USAGE);
    require_words("sward_grass_record_cull() needs sward_grass_record_update()");
    REQUIRE(sward_grass_record_update(grass, NULL) == SWARD_ERROR_USAGE);
    require_words("command buffer is null");
    REQUIRE(sward_grass_record_update(grass, commands) == SWARD_OK);
    REQUIRE(strcmp(sward_last_error(), "") == 0);
    REQUIRE(sward_grass_record_update(grass, commands) == SWARD_ERROR_USAGE);
    require_words("sward_grass_record_update() is called a second time");
    REQUIRE(sward_grass_record_raster(grass, commands, 0) == SWARD_ERROR_USAGE);
    require_words("sward_grass_record_raster() of view 0");
    REQUIRE(sward_grass_record_draw(grass, commands, 0, target) == SWARD_ERROR_USAGE);
    require_words("needs its sward_grass_record_cull() before it");
    REQUIRE(sward_grass_record_cull(grass, commands, 1) == SWARD_ERROR_USAGE);
    require_words("view 1 of a frame with 1 views");
    REQUIRE(sward_grass_record_draw(grass, commands, 0, NULL) == SWARD_ERROR_USAGE);
    require_words("target is null");
    REQUIRE(sward_grass_record_raster(NULL, commands, 0) == SWARD_ERROR_USAGE);
    require_words("grass is null");
    REQUIRE(sward_grass_record_cull(grass, commands, 0) == SWARD_OK);
    REQUIRE(sward_grass_record_depth(grass, commands, 0, target) == SWARD_ERROR_USAGE);
    require_words("sward_grass_record_depth()");
    submit_and_wait(commands);

    /* Two views with room for one. */
    const sward_view two[2] = {frame->views[0], frame->views[0]};
    sward_frame wrong = *frame;
    wrong.views = two;
    wrong.view_count = 2;
    REQUIRE(sward_grass_begin(grass, 0, &wrong) == SWARD_ERROR_USAGE);
    REQUIRE(strstr(sward_last_error(), "2 views") != NULL);
    require_words("sward_grass_info::max_views is 1");
    wrong = *frame;
    wrong.collider_count = UINT32_MAX;
    wrong.colliders = (const sward_collider*)two;
    REQUIRE(sward_grass_begin(grass, 0, &wrong) == SWARD_ERROR_USAGE);
    sward_view view = two[0];
    wrong = *frame;
    wrong.views = &view;
    view.samples = 3;
    REQUIRE(sward_grass_begin(grass, 0, &wrong) == SWARD_ERROR_USAGE);
    REQUIRE(strstr(sward_last_error(), "3 samples") != NULL);
    view = two[0];
    view.world_to_clip[5] = (double)NAN;
    REQUIRE(sward_grass_begin(grass, 0, &wrong) == SWARD_ERROR_USAGE);
    require_words("view 0: world_to_clip is not finite");

    view = two[0];
    view.has_reversed_z = false;
    REQUIRE(sward_grass_begin(grass, 0, &wrong) == SWARD_ERROR_USAGE);
    require_words("has_reversed_z is false, and depth falls with distance by world_to_clip");

    const sward_grass_info info = {.frames_in_flight = 17, .max_views = 1};
    sward_grass* none = NULL;
    REQUIRE(sward_grass_create(context, &info, &none) == SWARD_ERROR_USAGE && none == NULL);
    require_words("frames_in_flight is 17");
    const sward_target_info nothing = {.samples = 1};
    sward_target* no_target = NULL;
    REQUIRE(sward_target_create(context, &nothing, &no_target) == SWARD_ERROR_USAGE);
    require_words("sward_target_info: there is neither a colour nor a depth");
    const VkFormat integers = VK_FORMAT_R8G8B8A8_UINT;
    const sward_target_info whole = {.color_formats = &integers, .color_count = 1, .samples = 1};
    REQUIRE(sward_target_create(context, &whole, &no_target) == SWARD_ERROR_USAGE);
    require_words("sward_target_info::color_formats: format 41 of attachment 0 holds integers");
    sward_target_info odd = nothing;
    odd.depth_format = VK_FORMAT_D32_SFLOAT;
    odd.samples = 3;
    REQUIRE(sward_target_create(context, &odd, &no_target) == SWARD_ERROR_USAGE);
    require_words("sward_target_info::samples is 3");
}

static void draw_field(const sward_field* field, const char* path, const char* delta,
                       const char* seeded)
{
    sward_features* features = make_device();
    const sward_context_info context_info = {.instance = instance,
                                             .physical = physical,
                                             .device = device,
                                             .queue = queue,
                                             .queue_family = family,
                                             .features = features,
                                             .get_instance_proc_addr = vkGetInstanceProcAddr};
    sward_context* context = NULL;
    REQUIRE(sward_context_create(NULL, &context) == SWARD_ERROR_USAGE);
    sward_context_info systems_loader = context_info;
    systems_loader.get_instance_proc_addr = NULL;
    systems_loader.queue_family = 77;
    REQUIRE(sward_context_create(&systems_loader, &context) == SWARD_ERROR_USAGE);
    require_words("sward_context_info::queue_family is 77");
    systems_loader.queue_family = family;
    REQUIRE(sward_context_create(&systems_loader, &context) == SWARD_OK);
    sward_context_destroy(context);
    REQUIRE(sward_context_create(&context_info, &context) == SWARD_OK);

    sward_resident* resident = NULL;
    REQUIRE(sward_resident_create(context, field, &resident) == SWARD_OK);
    REQUIRE(!sward_resident_is_uploaded(resident));
    REQUIRE(sward_resident_release_staging(resident) == SWARD_ERROR_USAGE);
    require_words("sward_resident_release_staging() needs the whole sward_resident_record_upload()");
    upload(resident);
    REQUIRE(sward_resident_is_uploaded(resident));
    REQUIRE(sward_resident_release_staging(resident) == SWARD_OK);

    sward_settings* settings = NULL;
    const float sun[3] = {0.0f, 2.0f, 1.0f}, nowhere[3] = {0.0f, 0.0f, 0.0f};
    REQUIRE(sward_settings_create(field, &settings) == SWARD_OK);
    REQUIRE(sward_settings_read(settings, "{\"wind\": []}") == SWARD_OK);
    REQUIRE(sward_settings_read(settings, "{\"windd\": []}") == SWARD_ERROR_INPUT);
    REQUIRE(strstr(sward_last_error(), "wind") != NULL);
    REQUIRE(sward_settings_set_sun(settings, nowhere) == SWARD_ERROR_USAGE);
    REQUIRE(sward_settings_set_sun(settings, sun) == SWARD_OK);

    const VkFormat format = VK_FORMAT_R8G8B8A8_SRGB;
    const sward_target_info target_info = {.color_formats = &format,
                                           .color_count = 1,
                                           .depth_format = VK_FORMAT_D32_SFLOAT,
                                           .samples = 1,
                                           .has_reversed_z = true};
    sward_target* target = NULL;
    REQUIRE(sward_target_create(context, &target_info, &target) == SWARD_OK);

    const sward_grass_info grass_info = {.frames_in_flight = 1, .max_views = 1};
    sward_grass* grass = NULL;
    REQUIRE(sward_grass_create(context, &grass_info, &grass) == SWARD_OK);
    sward_placement place = {.rotation = {0, 0, 0, 1}, .scale = 0.0};
    sward_instance one = 0;
    REQUIRE(sward_grass_add(grass, resident, &place, &one) == SWARD_ERROR_USAGE);
    place.scale = 1.0;
    REQUIRE(sward_grass_add(grass, resident, &place, &one) == SWARD_OK);
    REQUIRE(sward_grass_move(grass, one + 1, &place) == SWARD_ERROR_USAGE);

    sward_field_info info;
    REQUIRE(sward_field_get_info(field, &info) == SWARD_OK);
    sward_view view = view_from_above(&info);
    sward_frame frame = {.time = 1.0, .views = &view, .view_count = 1, .settings = settings};
    REQUIRE(sward_grass_begin(grass, 1, &frame) == SWARD_ERROR_USAGE);
    misuse(context, grass, target, &frame);
    for (int geometry = SWARD_GEOMETRY_RASTER; geometry <= SWARD_GEOMETRY_TESSELLATION;
         ++geometry) {
        view.geometry = (sward_geometry)geometry;
        const unsigned covered = draw(grass, target, &frame);
        sward_stats stats;
        REQUIRE(sward_grass_get_stats(grass, 0, 0, &stats) == SWARD_OK);
        REQUIRE(stats.resident == info.blade_count && stats.drawn > 0);
        REQUIRE(covered > width * height / 50u);
        printf("%s: %u of %d pixels, %llu blades\n",
               sward_grass_why_tessellated(grass, 0, target) == NULL ? "rasterised" : "tessellated",
               covered, width * height, (unsigned long long)stats.drawn);
        if (sward_grass_why_tessellated(grass, 0, target) == NULL) {
            const unsigned long drawn = brightness;
            const unsigned stored = store(grass, field, frame);
            REQUIRE(stored + covered / 100 >= covered && stored <= covered + covered / 100);
            REQUIRE(labs((long)brightness - (long)drawn) < (long)(drawn / 50));
        }
    }
    REQUIRE(sward_grass_why_tessellated(grass, 0, target) != NULL);
    light_frame(grass, target, frame, &info);
    REQUIRE(sward_grass_remove(grass, one) == SWARD_OK);
    REQUIRE(sward_grass_remove(grass, one) == SWARD_ERROR_USAGE);
    REQUIRE(draw(grass, target, &frame) == 0);

    edit_field(context, field, grass, target, &frame, delta);
    stream_field(context, path, grass, target, &frame);
    sow_field(context, seeded, grass, target, &frame);

    sward_grass_destroy(grass);
    sward_target_destroy(target);
    sward_settings_destroy(settings);
    sward_resident_destroy(resident);
    sward_context_destroy(context);
    sward_features_destroy(features);
    vkDestroyCommandPool(device, pool, NULL);
    vkDestroyDevice(device, NULL);
    vkDestroyInstance(instance, NULL);
}

int main(int argc, char** argv)
{
    REQUIRE(argc == 5);
    REQUIRE(strcmp(sward_last_error(), "") == 0);
    sward_field* field = read_field(argv[1], argv[2]);
    draw_field(field, argv[1], argv[3], argv[4]);
    sward_field_destroy(field);
    sward_field_destroy(NULL);
    return 0;
}
