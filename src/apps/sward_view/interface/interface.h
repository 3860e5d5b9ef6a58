#pragma once

#include "apps/sward_view/interface/style.h"
#include "gpu/context/handle.h"
#include "gpu/device/device.h"
#include "gpu/device/instance.h"
#include "gpu/presentation/swapchain.h"

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

    /// Scales text and controls; outside of begin() and end(). Waits for the device if it differs.
    void resize(const Style::Scale& scale);

    void begin();
    void end();

    /// After end(): whether its output differs from the last that was recorded.
    bool hasChanged() const;

    /// Between begin() and end(): closes the topmost drop-down or popup; whether there was one.
    bool closePopup();

    /// Between begin() and end(): ends typing, with what has been typed.
    void endTyping();

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
    /// ImGui's backend of the window.
    struct WindowBackend {
        explicit WindowBackend(GLFWwindow* window);
        WindowBackend(const WindowBackend&) = delete;
        WindowBackend& operator=(const WindowBackend&) = delete;
        ~WindowBackend();
    };
    /// ImGui's backend of the device, with the picture of the fonts.
    struct DeviceBackend {
        explicit DeviceBackend(const Interface& interface);
        DeviceBackend(const DeviceBackend&) = delete;
        DeviceBackend& operator=(const DeviceBackend&) = delete;
        ~DeviceBackend();
    };

    VkFramebuffer framebufferFor(const gpu::Swapchain::Target& target);

    VkInstance instance_;
    const gpu::DeviceContext& device_;
    const gpu::Swapchain& swapchain_;
    Context context_;
    const bool isLinear_; ///< the target converts linear colours to sRGB
    std::unique_ptr<Style> style_;
    RenderPass renderPass_;
    DescriptorPool descriptors_;
    WindowBackend windowBackend_;
    std::unique_ptr<DeviceBackend> deviceBackend_;
    std::vector<Framebuffer> framebuffers_; ///< by the image's index
    std::uint64_t generation_ = 0;          ///< generation of their images
    std::size_t recorded_ = 0;              ///< hash of the last output that was recorded
};

} // namespace sward::view
