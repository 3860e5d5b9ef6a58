#pragma once

#include "apps/sward_view/navigation/input.h"
#include "gpu/context/handle.h"

#include <glm/vec2.hpp>
#include <vulkan/vulkan.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

struct GLFWwindow;

namespace sward::view {

/// A window for Vulkan. One at a time; call everything from the thread of main().
class Window {
public:
    /// Hidden until show(). `fitsScreen`: multiplies `size` by the content scale, within the
    /// screen. Throws Error{runtime} if there is no display.
    Window(glm::uvec2 size, bool fitsScreen, const std::string& title);
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;
    ~Window();

    /// Instance extensions required for a surface.
    std::vector<std::string> instanceExtensions() const;

    gpu::Surface createSurface(VkInstance instance) const;

    void show();

    /// Whether the user has closed the window by its button, or close() was called.
    bool isClosed() const;
    void close();
    void keepOpen(); ///< takes the user's wish to close it back

    /// Width to height of the drawable area.
    float aspect() const;

    /// Size of the drawable area [pixels]; 0 while invisible.
    glm::uvec2 drawableSize() const;

    /// Size in the window's coordinates, which are the mouse's; 0 while invisible.
    glm::uvec2 size() const;

    /// Factor of texts and controls [pixels per pixel] that the desktop asks for.
    float contentScale() const;

    /// Upper bound of the screen's width and height [pixels].
    glm::uvec2 screenSize() const;

    /// Processes pending events without waiting.
    void poll();

    /// Waits for an event, at most `seconds`.
    void waitForEvents(double seconds);

    Input takeInput();
    void setTitle(const std::string& title);

    /// Handle for drawing controls.
    GLFWwindow* handle() const;

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

} // namespace sward::view
