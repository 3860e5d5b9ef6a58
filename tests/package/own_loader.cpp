// A host that loads Vulkan's loader at run time instead of linking it.
#include <dlfcn.h>
#include <glm/ext/matrix_transform.hpp>
#include <sward/field/read.h>
#include <sward/gpu/host_device.h>
#include <sward/gpu/features.h>
#include <sward/render/grass.h>

#include <cstdio>
#include <memory>

using namespace sward;

template <typename Function>
Function named(void* (*find)(void*, const char*), void* where, const char* name)
{
    return reinterpret_cast<Function>(find(where, name));
}

int main(int, char** argv)
{
    void* loader = dlopen("libvulkan.so.1", RTLD_NOW);
    const auto get = named<PFN_vkGetInstanceProcAddr>(dlsym, loader, "vkGetInstanceProcAddr");
#define LOAD(instance, name) const auto name = reinterpret_cast<PFN_##name>(get(instance, #name))
    LOAD(VK_NULL_HANDLE, vkCreateInstance);
    VkApplicationInfo application{VK_STRUCTURE_TYPE_APPLICATION_INFO};
    application.apiVersion = VK_API_VERSION_1_3;
    VkInstanceCreateInfo instanceInfo{VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
    instanceInfo.pApplicationInfo = &application;
    VkInstance instance = VK_NULL_HANDLE;
    if (vkCreateInstance(&instanceInfo, nullptr, &instance) != VK_SUCCESS)
        return 1;
    LOAD(instance, vkEnumeratePhysicalDevices);
    LOAD(instance, vkGetPhysicalDeviceFeatures2);
    LOAD(instance, vkCreateDevice);
    LOAD(instance, vkGetDeviceQueue);
    LOAD(instance, vkCreateCommandPool);
    LOAD(instance, vkAllocateCommandBuffers);
    LOAD(instance, vkBeginCommandBuffer);
    LOAD(instance, vkEndCommandBuffer);
    LOAD(instance, vkQueueSubmit);
    LOAD(instance, vkQueueWaitIdle);
    LOAD(instance, vkDestroyCommandPool);
    LOAD(instance, vkDestroyDevice);
    LOAD(instance, vkDestroyInstance);

    gpu::HostDevice host{.instance = instance};
#ifndef LEAVES_THE_LOADER_OUT
    host.getInstanceProcAddr = get;
#endif
    std::uint32_t one = 1;
    vkEnumeratePhysicalDevices(instance, &one, &host.physical);
    gpu::FeatureChain supported, wanted;
    vkGetPhysicalDeviceFeatures2(host.physical, &supported.core);
    host.features = gpu::enableFeatures(supported, wanted);
    const float priority = 1.0f;
    const VkDeviceQueueCreateInfo queues{
        VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO, nullptr, 0, 0, 1, &priority};
    const VkDeviceCreateInfo deviceInfo{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO, &wanted.core, 0, 1,
                                        &queues};
    if (vkCreateDevice(host.physical, &deviceInfo, nullptr, &host.device) != VK_SUCCESS)
        return 1;
    vkGetDeviceQueue(host.device, 0, 0, &host.queue);
    VkCommandPool pool = VK_NULL_HANDLE;
    const VkCommandPoolCreateInfo poolInfo{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
    vkCreateCommandPool(host.device, &poolInfo, nullptr, &pool);
    const VkCommandBufferAllocateInfo buffersInfo{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                                  nullptr, pool, VK_COMMAND_BUFFER_LEVEL_PRIMARY,
                                                  1};
    VkCommandBuffer commands = VK_NULL_HANDLE;
    vkAllocateCommandBuffers(host.device, &buffersInfo, &commands);
    {
        const gpu::DeviceContext context = gpu::describeDevice(host);
        const auto mapped =
            std::make_shared<const field::MappedField>(field::readField(argv[1]));
        const auto lawn = std::make_shared<render::ResidentField>(context, mapped);
        render::Grass grass(context, {.framesInFlight = 1});
        grass.add({lawn});
        const render::BladeTarget target(context, {.colorFormats = {VK_FORMAT_R8G8B8A8_SRGB}});
        render::HostView view{.size = {64, 64}};
        view.worldToClip[3][3] = 0.0;
        view.worldToClip[2][3] = -1.0;
        view.worldToClip[2][2] = 0.0;
        view.worldToClip[3][2] = 0.1;
        view.worldToClip *= glm::lookAt(glm::dvec3(0, 20, 20), glm::dvec3(0), glm::dvec3(0, 1, 0));
        const render::FrameSettings settings = render::FrameSettings::of(mapped->view());

        const VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
        vkBeginCommandBuffer(commands, &begin);
        lawn->recordUpload(commands);
        grass.begin(0, {.views = {&view, 1}, .settings = settings});
        grass.recordUpdate(commands);
        grass.recordCull(commands, 0);
        vkEndCommandBuffer(commands);
        const VkSubmitInfo submission{
            VK_STRUCTURE_TYPE_SUBMIT_INFO, nullptr, 0, nullptr, nullptr, 1, &commands};
        vkQueueSubmit(host.queue, 1, &submission, VK_NULL_HANDLE);
        vkQueueWaitIdle(host.queue);
        std::printf("%s lists %s\n", context.name.c_str(),
                    grass.stats(0, 0).drawn > 0 ? "blades" : "nothing");
    }
    vkDestroyCommandPool(host.device, pool, nullptr);
    vkDestroyDevice(host.device, nullptr);
    vkDestroyInstance(instance, nullptr);
}
