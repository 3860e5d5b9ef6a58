#pragma once

#include "apps/sward_view/input.h"
#include "gpu/handle.h"

#include <glm/vec2.hpp>
#include <vulkan/vulkan.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

struct GLFWwindow;

namespace sward::view {

/// A window that Vulkan draws into. One at a time; all calls from the thread of main().
class Window {
public:
    /// Hidden until show(). Throws Error{runtime} if there is no display.
    Window(glm::uvec2 size, const std::string& title);
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;
    ~Window();

    /// Instance extensions without which there is no surface.
    std::vector<std::string> instanceExtensions() const;

    gpu::Surface createSurface(VkInstance instance) const;

    void show();

    /// Whether the user has closed the window by its button, or close() was called.
    bool isClosed() const;
    void close();

    /// Size of the drawable area [pixels]; 0 while there is nothing to draw into.
    glm::uvec2 drawableSize() const;

    /// Width and height that no screen exceeds [pixels].
    glm::uvec2 screenSize() const;

    /// Takes in what has happened, without waiting.
    void poll();

    /// Sleeps until something happens, at most so many seconds.
    void waitForEvents(double seconds);

    Input takeInput();
    void setTitle(const std::string& title);

    /// For whoever draws controls into it.
    GLFWwindow* handle() const;

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

} // namespace sward::view
