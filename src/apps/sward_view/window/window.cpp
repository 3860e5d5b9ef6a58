#include "apps/sward_view/window/window.h"

#include "core/error.h"
#include "gpu/context/check.h"

// window.h includes Vulkan, so GLFW declares its Vulkan functions; omit OpenGL.
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <optional>
#include <string_view>
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

constexpr float clickSlack = 3.0f; ///< [pixels] a click may move without becoming a drag

struct KeyMeaning {
    int code;
    Key key;
};

constexpr std::array<KeyMeaning, 12> keyMeanings{{{GLFW_KEY_ESCAPE, Key::escape},
                                                  {GLFW_KEY_F, Key::frame},
                                                  {GLFW_KEY_HOME, Key::home},
                                                  {GLFW_KEY_SPACE, Key::pause},
                                                  {GLFW_KEY_PERIOD, Key::step},
                                                  {GLFW_KEY_H, Key::help},
                                                  {GLFW_KEY_TAB, Key::tab},
                                                  {GLFW_KEY_G, Key::walk},
                                                  {GLFW_KEY_C, Key::freeze},
                                                  {GLFW_KEY_P, Key::picture},
                                                  {GLFW_KEY_R, Key::record},
                                                  {GLFW_KEY_I, Key::species}}};

// Rows of a list that a key goes down.
int rowsOf(int key)
{
    constexpr int page = 10;
    switch (key) {
    case GLFW_KEY_DOWN:
        return 1;
    case GLFW_KEY_UP:
        return -1;
    case GLFW_KEY_PAGE_DOWN:
        return page;
    case GLFW_KEY_PAGE_UP:
        return -page;
    default:
        return 0;
    }
}

// Keys that mean something with Ctrl, by what is printed on them.
std::optional<Key> controlKeyOf(int key, int code, bool shift)
{
    const char* name = glfwGetKeyName(key, code);
    const std::string_view sign = name == nullptr ? "" : name;
    if (sign == "+" || sign == "=")
        return Key::larger;
    if (sign == "-")
        return Key::smaller;
    if (sign == "0")
        return Key::usualSize;
    if (sign == "h")
        return Key::hide;
    if (sign == "s")
        return Key::save;
    if (sign == "z")
        return shift ? Key::redo : Key::undo;
    return std::nullopt;
}

// Makes a window smaller that is larger than the main screen without its bars.
void shrinkToScreen(GLFWwindow* window)
{
    GLFWmonitor* screen = glfwGetPrimaryMonitor();
    if (screen == nullptr)
        return;
    int left = 0;
    int top = 0;
    int most = 0;
    int highest = 0;
    glfwGetMonitorWorkarea(screen, &left, &top, &most, &highest);
    int width = 0;
    int height = 0;
    glfwGetWindowSize(window, &width, &height);
    if (most > 0 && highest > 0 && (width > most || height > highest))
        glfwSetWindowSize(window, std::min(width, most), std::min(height, highest));
}

} // namespace

struct Window::Parts {
    /// Initialises and terminates GLFW.
    class Library {
    public:
        Library()
        {
#ifdef GLFW_PLATFORM
            // Without a compositor, GLFW 3.4 makes libwayland print an error: choose X11.
            if (std::getenv("WAYLAND_DISPLAY") == nullptr && std::getenv("DISPLAY") != nullptr)
                glfwInitHint(GLFW_PLATFORM, GLFW_PLATFORM_X11);
#endif
            if (glfwInit() != GLFW_TRUE)
                failWithoutDisplay();
        }
        Library(const Library&) = delete;
        Library& operator=(const Library&) = delete;
        ~Library()
        {
            glfwTerminate();
        }
    };

    struct DestroyWindow {
        void operator()(GLFWwindow* window) const { glfwDestroyWindow(window); }
    };

    Library library;
    std::unique_ptr<GLFWwindow, DestroyWindow> window;
    Input input;
    glm::dvec2 cursor{0.0};
    float contentScale = 1.0f;

    // Parts of a callback's window.
    static Parts& of(GLFWwindow* window)
    {
        return *static_cast<Parts*>(glfwGetWindowUserPointer(window));
    }

    bool isDown(int key) const
    {
        return glfwGetKey(window.get(), key) == GLFW_PRESS;
    }
    bool isHeld(int button) const
    {
        return glfwGetMouseButton(window.get(), button) == GLFW_PRESS;
    }
    bool shift() const
    {
        return isDown(GLFW_KEY_LEFT_SHIFT) || isDown(GLFW_KEY_RIGHT_SHIFT);
    }

    static void onCursor(GLFWwindow* window, double x, double y);
    static void onButton(GLFWwindow* window, int button, int action, int modifiers);
    static void onScroll(GLFWwindow* window, double x, double y);
    static void onKey(GLFWwindow* window, int key, int code, int action, int modifiers);
    static void onDrop(GLFWwindow* window, int count, const char** paths);
    static void onContentScale(GLFWwindow* window, float x, float y)
    {
        of(window).contentScale = std::max(x, y);
    }
    static void onRefresh(GLFWwindow* window)
    {
        of(window).input.exposed = true;
    }
};

void Window::Parts::onCursor(GLFWwindow* window, double x, double y)
{
    Parts& parts = of(window);
    const glm::vec2 moved(glm::dvec2(x, y) - parts.cursor);
    parts.cursor = {x, y};
    const bool left = parts.isHeld(GLFW_MOUSE_BUTTON_LEFT);
    if (parts.isHeld(GLFW_MOUSE_BUTTON_MIDDLE) || (left && parts.shift()))
        parts.input.pan += moved;
    else if (left)
        parts.input.rotate += moved;
    else if (parts.isHeld(GLFW_MOUSE_BUTTON_RIGHT))
        parts.input.look += moved;
}

void Window::Parts::onButton(GLFWwindow* window, int button, int action, int)
{
    if (button != GLFW_MOUSE_BUTTON_LEFT)
        return;
    Parts& parts = of(window);
    const glm::vec2 cursor(parts.cursor);
    if (action == GLFW_PRESS) {
        parts.input.leftPressed = true;
        parts.input.pressedAt = cursor;
        parts.input.clicked.reset();
    } else if (glm::length(cursor - parts.input.pressedAt) <= clickSlack) {
        parts.input.clicked = cursor;
    }
}

void Window::Parts::onScroll(GLFWwindow* window, double, double y)
{
    of(window).input.wheel += static_cast<float>(y);
}

void Window::Parts::onKey(GLFWwindow* window, int key, int code, int action, int modifiers)
{
    if (action == GLFW_RELEASE)
        return;
    of(window).input.steps += rowsOf(key);
    of(window).input.sides += (key == GLFW_KEY_RIGHT ? 1 : 0) - (key == GLFW_KEY_LEFT ? 1 : 0);
    if (action != GLFW_PRESS)
        return;
    if (key == GLFW_KEY_ENTER || key == GLFW_KEY_KP_ENTER)
        of(window).input.entered = true;
    KeyPress press{Key::bookmark, 0, (modifiers & GLFW_MOD_CONTROL) != 0,
                   (modifiers & GLFW_MOD_SHIFT) != 0};
    if (press.control)
        if (const std::optional<Key> found = controlKeyOf(key, code, press.shift)) {
            press.key = *found;
            of(window).input.keys.push_back(press);
            return;
        }
    if (key >= GLFW_KEY_1 && key <= GLFW_KEY_9) {
        press.number = key - GLFW_KEY_0;
    } else {
        const auto* const meaning =
            std::find_if(keyMeanings.begin(), keyMeanings.end(),
                         [key](const KeyMeaning& entry) { return entry.code == key; });
        if (meaning == keyMeanings.end())
            return;
        press.key = meaning->key;
    }
    of(window).input.keys.push_back(press);
}

void Window::Parts::onDrop(GLFWwindow* window, int count, const char** paths)
{
    Parts& parts = of(window);
    parts.input.dropped.assign(paths, paths + count);
    parts.input.dropsMore = parts.shift();
}

Window::Window(glm::uvec2 size, bool fitsScreen, const std::string& title)
    : parts_(std::make_unique<Parts>())
{
    if (glfwVulkanSupported() != GLFW_TRUE)
        fail(ErrorKind::unsupported,
             "no Vulkan driver is installed; on Debian it is in the package "
             "mesa-vulkan-drivers, or comes with the GPU's own driver");
    glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
    glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
    glfwWindowHint(GLFW_SCALE_TO_MONITOR, fitsScreen ? GLFW_TRUE : GLFW_FALSE);
    parts_->window.reset(glfwCreateWindow(static_cast<int>(size.x), static_cast<int>(size.y),
                                          title.c_str(), nullptr, nullptr));
    GLFWwindow* window = parts_->window.get();
    if (window == nullptr)
        failWithoutDisplay();
    glfwSetWindowUserPointer(window, parts_.get());
    glfwGetCursorPos(window, &parts_->cursor.x, &parts_->cursor.y);
    glfwSetCursorPosCallback(window, Parts::onCursor);
    glfwSetMouseButtonCallback(window, Parts::onButton);
    glfwSetScrollCallback(window, Parts::onScroll);
    glfwSetKeyCallback(window, Parts::onKey);
    glfwSetDropCallback(window, Parts::onDrop);
    glfwSetWindowRefreshCallback(window, Parts::onRefresh);
    glfwSetWindowContentScaleCallback(window, Parts::onContentScale);
    float x = 1.0f;
    float y = 1.0f;
    glfwGetWindowContentScale(window, &x, &y);
    Parts::onContentScale(window, x, y);
    if (fitsScreen)
        shrinkToScreen(window);
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

void Window::close()
{
    glfwSetWindowShouldClose(parts_->window.get(), GLFW_TRUE);
}

void Window::keepOpen()
{
    glfwSetWindowShouldClose(parts_->window.get(), GLFW_FALSE);
}

float Window::aspect() const
{
    const glm::uvec2 size = glm::max(drawableSize(), glm::uvec2(1));
    return static_cast<float>(size.x) / static_cast<float>(size.y);
}

GLFWwindow* Window::handle() const
{
    return parts_->window.get();
}

glm::uvec2 Window::drawableSize() const
{
    // On X11 a minimised window keeps its size, but is invisible.
    if (glfwGetWindowAttrib(parts_->window.get(), GLFW_ICONIFIED) == GLFW_TRUE)
        return glm::uvec2(0);
    int width = 0;
    int height = 0;
    glfwGetFramebufferSize(parts_->window.get(), &width, &height);
    return {width, height};
}

glm::uvec2 Window::size() const
{
    if (drawableSize() == glm::uvec2(0))
        return glm::uvec2(0);
    int width = 0;
    int height = 0;
    glfwGetWindowSize(parts_->window.get(), &width, &height);
    return {width, height};
}

float Window::contentScale() const
{
    return parts_->contentScale;
}

glm::uvec2 Window::screenSize() const
{
    glm::uvec2 size = drawableSize();
    int count = 0;
    GLFWmonitor** monitors = glfwGetMonitors(&count);
    for (int i = 0; i < count; ++i)
        if (const GLFWvidmode* mode = glfwGetVideoMode(monitors[i]))
            size = glm::max(size, glm::uvec2(static_cast<std::uint32_t>(mode->width),
                                             static_cast<std::uint32_t>(mode->height)));
    return size;
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
    Input next;
    next.pressedAt = parts_->input.pressedAt;
    Input input = std::exchange(parts_->input, next);

    // Poll held keys.
    const auto held = [this](int more, int less) {
        return (parts_->isDown(more) ? 1.0f : 0.0f) - (parts_->isDown(less) ? 1.0f : 0.0f);
    };
    input.cursor = glm::vec2(parts_->cursor);
    input.leftHeld = parts_->isHeld(GLFW_MOUSE_BUTTON_LEFT);
    input.rightHeld = parts_->isHeld(GLFW_MOUSE_BUTTON_RIGHT);
    input.hurry = parts_->shift();
    input.alt = parts_->isDown(GLFW_KEY_LEFT_ALT) || parts_->isDown(GLFW_KEY_RIGHT_ALT);
    input.walk = {held(GLFW_KEY_D, GLFW_KEY_A), held(GLFW_KEY_E, GLFW_KEY_Q),
                  held(GLFW_KEY_W, GLFW_KEY_S)};
    return input;
}

void Window::setTitle(const std::string& title)
{
    glfwSetWindowTitle(parts_->window.get(), title.c_str());
}

} // namespace sward::view
