#pragma once

#include "apps/sward_view/interface/style.h"
#include "gpu/device.h"
#include "gpu/handle.h"
#include "gpu/instance.h"
#include "gpu/swapchain.h"

#include <vulkan/vulkan.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

struct GLFWwindow;

namespace sward::view {

/// Dear ImGui in a Window. One at a time; draw controls only between begin() and end().
class Interface {
public:
    /// Create it after the window's own callbacks, which are still called.
    Interface(const gpu::Instance& instance, const gpu::Device& device,
              const gpu::Swapchain& swapchain, GLFWwindow* window);
    Interface(const Interface&) = delete;
    Interface& operator=(const Interface&) = delete;
    ~Interface();

    void begin();
    void end();

    /// After end(): whether its output differs from the last that was recorded.
    bool hasChanged() const;

    /// Between begin() and end(): whether a control uses the mouse, or the keys.
    bool takesMouse() const;
    bool takesKeys() const;

    const Style& style() const { return *style_; }

    /// Draws the output of end() over an image in ImageUse::colorTarget and keeps that use.
    void record(VkCommandBuffer commands, const gpu::Swapchain::Target& target);

private:
    using RenderPass = gpu::Unique<VkRenderPass, vkDestroyRenderPass>;
    using Framebuffer = gpu::Unique<VkFramebuffer, vkDestroyFramebuffer>;
    using DescriptorPool = gpu::Unique<VkDescriptorPool, vkDestroyDescriptorPool>;

    /// ImGui's global context.
    struct Context {
        Context();
        Context(const Context&) = delete;
        Context& operator=(const Context&) = delete;
        ~Context();
    };
    /// ImGui's window and device backends.
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
    std::uint64_t generation_ = 0;          ///< generation of their images
    std::size_t recorded_ = 0;              ///< hash of the last output that was recorded
};

} // namespace sward::view
