#include "apps/sward_view/window.h"

#include "core/error.h"
#include "gpu/check.h"

// window.h has included Vulkan, so GLFW declares its Vulkan functions; it need not bring OpenGL.
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <utility>

namespace sward::view {
namespace {

std::string lastReason()
{
    const char* text = nullptr;
    glfwGetError(&text);
    return text == nullptr ? "no reason given" : text;
}

[[noreturn]] void failWithoutDisplay()
{
    fail(ErrorKind::runtime,
         "no window can be opened: {}. Without a display, 'sward-view render FILE -o frame.png' "
         "draws into a picture.",
         lastReason());
}

/// GLFW, running.
class Library {
public:
    Library()
    {
        if (glfwInit() != GLFW_TRUE)
            failWithoutDisplay();
    }
    Library(const Library&) = delete;
    Library& operator=(const Library&) = delete;
    ~Library() { glfwTerminate(); }
};

struct DestroyWindow {
    void operator()(GLFWwindow* window) const { glfwDestroyWindow(window); }
};

} // namespace

struct Window::Parts {
    Library library;
    std::unique_ptr<GLFWwindow, DestroyWindow> window;
    Input input;
    glm::dvec2 cursor{0.0};

    // Parts of the window that a callback belongs to.
    static Parts& of(GLFWwindow* window)
    {
        return *static_cast<Parts*>(glfwGetWindowUserPointer(window));
    }

    static void onCursor(GLFWwindow* window, double x, double y);
    static void onScroll(GLFWwindow* window, double x, double y);
    static void onKey(GLFWwindow* window, int key, int code, int action, int modifiers);
};

void Window::Parts::onCursor(GLFWwindow* window, double x, double y)
{
    Parts& parts = of(window);
    const glm::vec2 moved(glm::dvec2(x, y) - parts.cursor);
    parts.cursor = {x, y};
    const bool left = glfwGetMouseButton(window, GLFW_MOUSE_BUTTON_LEFT) == GLFW_PRESS;
    const bool middle = glfwGetMouseButton(window, GLFW_MOUSE_BUTTON_MIDDLE) == GLFW_PRESS;
    const bool shift = glfwGetKey(window, GLFW_KEY_LEFT_SHIFT) == GLFW_PRESS ||
                       glfwGetKey(window, GLFW_KEY_RIGHT_SHIFT) == GLFW_PRESS;
    if (middle || (left && shift))
        parts.input.pan += moved;
    else if (left)
        parts.input.rotate += moved;
}

void Window::Parts::onScroll(GLFWwindow* window, double, double y)
{
    of(window).input.wheel += static_cast<float>(y);
}

void Window::Parts::onKey(GLFWwindow* window, int key, int, int action, int)
{
    if (action != GLFW_PRESS)
        return;
    Input& input = of(window).input;
    switch (key) {
    case GLFW_KEY_ESCAPE:
        glfwSetWindowShouldClose(window, GLFW_TRUE);
        break;
    case GLFW_KEY_F:
        input.frame = true;
        break;
    case GLFW_KEY_HOME:
        input.home = true;
        break;
    case GLFW_KEY_SPACE:
        input.pause = !input.pause;
        break;
    default:
        break;
    }
}

Window::Window(glm::uvec2 size, const std::string& title)
    : parts_(std::make_unique<Parts>())
{
    if (glfwVulkanSupported() != GLFW_TRUE)
        fail(ErrorKind::unsupported,
             "no Vulkan driver is installed; on Debian it is in the package "
             "mesa-vulkan-drivers, or comes with the GPU's own driver");
    glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
    glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
    parts_->window.reset(glfwCreateWindow(static_cast<int>(size.x), static_cast<int>(size.y),
                                          title.c_str(), nullptr, nullptr));
    GLFWwindow* window = parts_->window.get();
    if (window == nullptr)
        failWithoutDisplay();
    glfwSetWindowUserPointer(window, parts_.get());
    glfwGetCursorPos(window, &parts_->cursor.x, &parts_->cursor.y);
    glfwSetCursorPosCallback(window, Parts::onCursor);
    glfwSetScrollCallback(window, Parts::onScroll);
    glfwSetKeyCallback(window, Parts::onKey);
}

Window::~Window() = default;

std::vector<std::string> Window::instanceExtensions() const
{
    std::uint32_t count = 0;
    const char** names = glfwGetRequiredInstanceExtensions(&count);
    if (names == nullptr)
        fail(ErrorKind::unsupported, "the Vulkan driver cannot draw into a window: {}",
             lastReason());
    return {names, names + count};
}

gpu::Surface Window::createSurface(VkInstance instance) const
{
    VkSurfaceKHR surface = VK_NULL_HANDLE;
    gpu::check(glfwCreateWindowSurface(instance, parts_->window.get(), nullptr, &surface),
               "glfwCreateWindowSurface");
    return {instance, surface};
}

void Window::show()
{
    glfwShowWindow(parts_->window.get());
}

bool Window::isClosed() const
{
    return glfwWindowShouldClose(parts_->window.get()) == GLFW_TRUE;
}

glm::uvec2 Window::drawableSize() const
{
    // On X11 a minimised window keeps its size, but nobody sees it.
    if (glfwGetWindowAttrib(parts_->window.get(), GLFW_ICONIFIED) == GLFW_TRUE)
        return glm::uvec2(0);
    int width = 0;
    int height = 0;
    glfwGetFramebufferSize(parts_->window.get(), &width, &height);
    return {width, height};
}

void Window::poll()
{
    glfwPollEvents();
}

void Window::waitForEvents(double seconds)
{
    glfwWaitEventsTimeout(seconds);
}

Input Window::takeInput()
{
    return std::exchange(parts_->input, Input());
}

void Window::setTitle(const std::string& title)
{
    glfwSetWindowTitle(parts_->window.get(), title.c_str());
}

} // namespace sward::view
