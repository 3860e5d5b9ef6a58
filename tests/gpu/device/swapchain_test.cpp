#include "gpu/presentation/swapchain.h"

#include <array>
#include <cstdlib>
#include <memory>
#include <optional>
#include <stdexcept>

#define GLFW_INCLUDE_VULKAN
#include "gpu/device/device.h"
#include "gpu/memory/image_use.h"
#include "gpu/recording/frame_ring.h"
#include "gpu/recording/rendering.h"
#include "virtual_display.h"

#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

namespace sward::gpu {
namespace {

struct CloseWindow {
    void operator()(GLFWwindow* window) const { glfwDestroyWindow(window); }
};

// A window on its own X server. Members are destroyed in reverse order.
class Stage {
public:
    Stage()
    {
        setenv("DISPLAY", display_.name().c_str(), 1);
        if (glfwInit() != GLFW_TRUE)
            throw std::runtime_error("GLFW did not start");
        glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
        window_.reset(glfwCreateWindow(320, 200, "swapchain test", nullptr, nullptr));

        std::uint32_t count = 0;
        const char** names = glfwGetRequiredInstanceExtensions(&count);
        instance_ = std::make_unique<Instance>(
            InstanceSettings{.validation = true, .extensions = {names, names + count}});
        VkSurfaceKHR surface = VK_NULL_HANDLE;
        if (glfwCreateWindowSurface(instance_->get(), window_.get(), nullptr, &surface) !=
            VK_SUCCESS)
            throw std::runtime_error("there is no surface");
        surface_ = {instance_->get(), surface};
        device_ = std::make_unique<Device>(*instance_, DeviceSettings{.surface = surface});
    }

    ~Stage()
    {
        device_.reset();
        surface_ = {};
        window_.reset();
        glfwTerminate();
    }

    GLFWwindow* window() const { return window_.get(); }
    VkSurfaceKHR surface() const { return surface_.get(); }
    const DeviceContext& context() const { return device_->context(); }
    ValidationLog& validationLog() const { return instance_->validationLog(); }

private:
    test::VirtualDisplay display_;
    std::unique_ptr<GLFWwindow, CloseWindow> window_;
    std::unique_ptr<Instance> instance_;
    Surface surface_;
    std::unique_ptr<Device> device_;
};

// Clears and presents the next image; returns whether there was one.
bool showFrame(FrameRing& ring, Swapchain& swapchain)
{
    const std::optional<Swapchain::Target> target = swapchain.acquire();
    if (!target)
        return false;
    const FrameRing::Frame frame = ring.begin();
    transition(frame.commands, target->image, VK_IMAGE_ASPECT_COLOR_BIT, ImageUse::undefined,
               ImageUse::colorTarget);
    {
        const ColorAttachment color{.view = target->view,
                                    .clear = std::array{0.1f, 0.4f, 0.1f, 1.0f}};
        const RenderingScope rendering(frame.commands, swapchain.extent(), {&color, 1});
    }
    transition(frame.commands, target->image, VK_IMAGE_ASPECT_COLOR_BIT, ImageUse::colorTarget,
               ImageUse::present);

    VkSemaphoreSubmitInfo wait{};
    wait.sType = VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO;
    wait.semaphore = target->available;
    wait.stageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
    VkSemaphoreSubmitInfo signal = wait;
    signal.semaphore = target->finished;
    ring.submit(frame, {&wait, 1}, {&signal, 1});
    swapchain.present(*target);
    return true;
}

TEST(Swapchain, SurvivesResizingAndMinimising)
{
    const Stage stage;
    {
        FrameRing ring(stage.context());
        Swapchain swapchain(stage.context(), stage.surface(), {320, 200});
        EXPECT_EQ(swapchain.extent().width, 320U);
        EXPECT_GE(swapchain.imageCount(), 2U);
        for (int i = 0; i < 12; ++i)
            EXPECT_TRUE(showFrame(ring, swapchain)) << "frame " << i;

        for (int i = 1; i <= 10; ++i) {
            const VkExtent2D size{static_cast<std::uint32_t>(200 + 37 * i),
                                  static_cast<std::uint32_t>(400 - 23 * i)};
            const std::uint64_t generation = swapchain.generation();
            glfwSetWindowSize(stage.window(), static_cast<int>(size.width),
                              static_cast<int>(size.height));
            glfwPollEvents();
            swapchain.resize(size);
            // The X server may answer a frame late.
            for (int frame = 0; frame < 20 && swapchain.extent().width != size.width; ++frame) {
                showFrame(ring, swapchain);
                glfwPollEvents();
            }
            EXPECT_TRUE(showFrame(ring, swapchain));
            EXPECT_EQ(swapchain.extent().width, size.width);
            EXPECT_EQ(swapchain.extent().height, size.height);
            EXPECT_GT(swapchain.generation(), generation);
        }

        // Without pixels there are no images; with pixels there are again.
        swapchain.resize({0, 0});
        EXPECT_FALSE(showFrame(ring, swapchain));
        EXPECT_FALSE(showFrame(ring, swapchain));
        EXPECT_EQ(swapchain.imageCount(), 0U);
        EXPECT_EQ(swapchain.extent().width, 0U);
        swapchain.resize({570, 170});
        EXPECT_TRUE(showFrame(ring, swapchain));
        EXPECT_EQ(swapchain.extent().width, 570U);
    }
    EXPECT_EQ(stage.validationLog().count(), 0U) << stage.validationLog().text();
}

} // namespace
} // namespace sward::gpu
