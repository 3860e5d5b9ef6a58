#pragma once

#include "apps/sward_view/interface/style.h"
#include "gpu/device.h"
#include "gpu/handle.h"
#include "gpu/instance.h"
#include "gpu/swapchain.h"

#include <vulkan/vulkan.h>

#include <cstdint>
#include <memory>
#include <vector>

struct GLFWwindow;

namespace sward::view {

/// Dear ImGui in a window of ours. One at a time; everything that draws controls does so between
/// begin() and end().
class Interface {
public:
    /// After the window has its own callbacks, which are called as before.
    Interface(const gpu::Instance& instance, const gpu::Device& device,
              const gpu::Swapchain& swapchain, GLFWwindow* window);
    Interface(const Interface&) = delete;
    Interface& operator=(const Interface&) = delete;
    ~Interface();

    void begin();
    void end();

    /// Between begin() and end(): whether the mouse, or the keys, are for a control.
    bool takesMouse() const;
    bool takesKeys() const;

    const Style& style() const { return *style_; }

    /// Draws what end() has left over an image in ImageUse::colorTarget, and leaves it in that.
    void record(VkCommandBuffer commands, const gpu::Swapchain::Target& target);

private:
    using RenderPass = gpu::Unique<VkRenderPass, vkDestroyRenderPass>;
    using Framebuffer = gpu::Unique<VkFramebuffer, vkDestroyFramebuffer>;
    using DescriptorPool = gpu::Unique<VkDescriptorPool, vkDestroyDescriptorPool>;

    /// ImGui's own state, which its functions find by themselves.
    struct Context {
        Context();
        Context(const Context&) = delete;
        Context& operator=(const Context&) = delete;
        ~Context();
    };
    /// Its connection to window and device.
    struct Backends {
        Backends() = default;
        Backends(const Backends&) = delete;
        Backends& operator=(const Backends&) = delete;
        ~Backends();
    };

    VkFramebuffer framebufferFor(const gpu::Swapchain::Target& target);

    const gpu::DeviceContext& device_;
    const gpu::Swapchain& swapchain_;
    Context context_;
    std::unique_ptr<Style> style_;
    RenderPass renderPass_;
    DescriptorPool descriptors_;
    std::unique_ptr<Backends> backends_;
    std::vector<Framebuffer> framebuffers_; ///< by the image's index
    std::uint64_t generation_ = 0;          ///< of the images they were made for
};

} // namespace sward::view
